//! Memory files come back, and are read as Verilog reads them.

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use vectors::limits::MOST_NUMBERS;
use vectors::memory_file::{Header, LineProblem, MemoryError, Value, parse, read_words, write_header, write_word};
use vectors::packing::{WordField, WordLayout};

fn layout(width: u32) -> WordLayout {
    let format = "UQ1.0".parse().unwrap();
    let field = WordField { name: "word".to_owned(), format, msb: width - 1, lsb: 0 };
    WordLayout { width, fields: vec![field] }
}

fn written(words: &[u128], width: u32, command: &str) -> Vec<u8> {
    let (mut text, layout) = (Vec::new(), layout(width));
    let header = Header { title: "test", layout: &layout, words: words.len() as u64, command };
    write_header(&mut text, &header).unwrap();
    for word in words {
        write_word(&mut text, &layout, word).unwrap();
    }
    text
}

fn read(text: impl AsRef<[u8]>, width: u32, depth: usize) -> Result<Vec<u128>, MemoryError> {
    let file = tempfile::NamedTempFile::new().unwrap();
    fs::write(file.path(), text).unwrap();
    let words = read_words(file.path(), width, depth)?;
    Ok(words.into_iter().map(|word| u128::try_from(word).unwrap()).collect())
}

fn problem(text: &str, width: u32, depth: usize) -> (u64, LineProblem) {
    match read(text, width, depth).unwrap_err() {
        MemoryError::Line { line, problem, .. } => (line, problem),
        other => panic!("{other}"),
    }
}

proptest! {
    #[test]
    fn words_come_back(words in prop::collection::vec(any::<u128>(), 1..50), width in 1_u32..=128,
                       command in "\\PC*[\n\r]?[0-9a-f]*") {
        let words: Vec<u128> = words.iter().map(|word| word >> (128 - width)).collect();
        let text = written(&words, width, &command);
        prop_assert_eq!(read(&text, width, words.len()).unwrap(), words);
        prop_assert_eq!(text.last(), Some(&b'\n'));
    }

    #[test]
    fn a_cut_file_is_noticed(words in prop::collection::vec(any::<u64>(), 2..20), lost in 1_usize..2) {
        let words: Vec<u128> = words.into_iter().map(u128::from).collect();
        let text = written(&words[..words.len() - lost], 64, "c");
        match read(&text, 64, words.len()).unwrap_err() {
            MemoryError::Short { address, found, expected, .. } => {
                prop_assert_eq!(address, words.len() - lost);
                prop_assert_eq!((found, expected), (words.len() - lost, words.len()));
            }
            other => prop_assert!(false, "{}", other),
        }
    }
}

#[test]
fn the_header_says_what_a_word_is() {
    let text = String::from_utf8(written(&[5], 33, "blysk vectors --count 1\n@0 f")).unwrap();
    assert_eq!(
        text,
        "// Blysk test, for $readmemh: 1 words of 33 bits\n\
         // one word a line, 9 hex digits, two's complement where signed\n\
         //   [32:0] word UQ1.0\n\
         // made by: blysk vectors --count 1 @0 f\n\
         000000005\n"
    );
}

#[test]
fn numbers_are_read_as_verilog_reads_them() {
    let text = "// 1 2\n1_0 Ff /* 3 4\n5 */ 6 // 7\n@4 a\n@3/**/b\n@0 0\n";
    assert_eq!(read(text, 8, 5).unwrap(), [0, 0xff, 6, 0xb, 0xa]);
}

#[test]
fn an_unknown_value_is_not_a_number() {
    let entries = parse("0x\nzz\n1?", Path::new("dut.mem")).unwrap();
    let values: Vec<_> = entries.into_iter().map(|entry| entry.value).collect();
    assert_eq!(values, ["0x", "zz", "1?"].map(|text| Value::Unknown(text.to_owned())));
    assert_eq!(problem("00\nXx\n", 8, 2), (2, LineProblem::Unknown("Xx".to_owned())));
}

#[test]
fn wrong_lines_are_named() {
    let digit = |text: &str| LineProblem::Digit(text.to_owned());
    assert_eq!(problem("0\n1\n2g\n", 8, 3), (3, digit("2g")));
    assert_eq!(problem("_1", 8, 1), (1, digit("_1")));
    assert_eq!(problem("0\n-1", 8, 2), (2, digit("-1")));
    assert_eq!(problem("0\n@", 8, 2), (2, LineProblem::Address("@".to_owned())));
    assert_eq!(problem("@ 1", 8, 2), (1, LineProblem::Address("@".to_owned())));
    assert_eq!(problem("\n/* 0\n1", 8, 2), (2, LineProblem::OpenComment));
    let too_wide = LineProblem::TooWide { text: "80".to_owned(), width: 7 };
    assert_eq!(problem("7f\n80", 7, 2), (2, too_wide));
    assert_eq!(problem("0\n1\n2", 8, 2), (3, LineProblem::PastEnd { address: 2, depth: 2 }));
    assert_eq!(problem("@ff 0", 8, 2), (1, LineProblem::PastEnd { address: 255, depth: 2 }));
    // A line of them as well: what is kept of a file has a limit of its own.
    let many = "0 ".repeat(MOST_NUMBERS + 1);
    assert_eq!(problem(&many, 8, MOST_NUMBERS), (1, LineProblem::TooMany));
    assert!(matches!(read("0\n@2 1", 8, 3), Err(MemoryError::Short { address: 1, found: 2, .. })));
    let error = read_words(Path::new("no/such.mem"), 8, 1).unwrap_err().to_string();
    assert!(error.starts_with("cannot read the memory file no/such.mem: "), "{error}");
}
