//! Text from elsewhere: marks, encodings, line ends and limits, whatever the pieces in which it comes.

use std::fs;
use std::io::{self, Read};
use std::path::Path;

use proptest::prelude::*;
use vectors::text_file::{ANSWER_LOG, CONFIGURATION, MESH, TextKind, TextProblem, TextReader, read};

const SMALL: TextKind = TextKind { most_bytes: 100, most_line_bytes: 20, ..CONFIGURATION };

/// Gives a few bytes at a time, as a pipe may.
struct Pieces<'a>(&'a [u8], usize);

impl Read for Pieces<'_> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let count = self.1.min(self.0.len()).min(to.len());
        let (now, later) = self.0.split_at(count);
        to[..count].copy_from_slice(now);
        self.0 = later;
        Ok(count)
    }
}

fn in_pieces(bytes: &[u8], size: usize, kind: TextKind) -> Result<String, TextProblem> {
    let mut text = String::new();
    TextReader::new(Pieces(bytes, size), kind).read_to_string(&mut text)?;
    Ok(text)
}

fn text(bytes: impl AsRef<[u8]>, kind: TextKind) -> Result<String, String> {
    let of_size = |size| in_pieces(bytes.as_ref(), size, kind).map_err(|problem| problem.to_string());
    let whole = of_size(1 << 20);
    for size in [1, 2, 3, 7] {
        assert_eq!(of_size(size), whole, "{size} bytes at a time");
    }
    whole
}

#[test]
fn marks_and_line_ends_do_not_count() {
    for bytes in ["a\nb\n\nc", "\u{feff}a\nb\n\nc", "\u{feff}\u{feff}a\r\nb\r\n\r\nc", "a\rb\r\rc"] {
        assert_eq!(text(bytes, SMALL).unwrap(), "a\nb\n\nc", "{bytes:?}");
    }
    assert_eq!(text("\u{feff}", SMALL).unwrap(), "");
    assert_eq!(text("ä\u{feff}€\u{1f600}\r", SMALL).unwrap(), "ä\u{feff}€\u{1f600}\n");
}

fn utf16(text: &str, mark: bool, little: bool) -> Vec<u8> {
    let mark = mark.then_some(0xfeff);
    let units = mark.into_iter().chain(text.encode_utf16());
    units.flat_map(|unit| if little { unit.to_le_bytes() } else { unit.to_be_bytes() }).collect()
}

#[test]
fn other_encodings_are_named() {
    for json in ["{\"name\": \"a\"}", "{", "{\r\n  \"name\": \"łąka\"\r\n}", "# żółć\n{}"] {
        for mark in [true, false] {
            for (little, name) in [(true, "UTF-16LE"), (false, "UTF-16BE")] {
                let error = text(utf16(json, mark, little), SMALL).unwrap_err();
                assert!(error.contains(&format!("it is {name}")), "{json:?}: {error}");
                assert!(error.contains(&format!("iconv -f {name} -t UTF-8")), "{error}");
            }
        }
    }
    for (bytes, name) in [
        (&b"\xff\xfe\0\0{\0\0\0"[..], "UTF-32LE"),
        (b"\0\0\xfe\xff\0\0\0{", "UTF-32BE"),
        (b"{\0\0\0}\0\0\0", "UTF-32LE"),
        (b"\0\0\0{\0\0\0}", "UTF-32BE"),
    ] {
        let error = text(bytes, SMALL).unwrap_err();
        assert!(error.contains(&format!("it is {name}")), "{error}");
    }
}

#[test]
fn what_is_no_text_has_its_line() {
    for (bytes, said) in [
        (&b"a\nb\0c"[..], "line 2: there is a byte of 0"),
        (b"\0", "line 1: there is a byte of 0"),
        (b"ab\r\ncd\r\n\xe9f\n", "line 3: the line is not UTF-8: its byte 1 is 0xe9"),
        (b"a\rbc\xc3\xa4\xff", "line 2: the line is not UTF-8: its byte 5 is 0xff"),
        (b"a\nb\xe2\x82", "line 2: the line is not UTF-8: its byte 2 is 0xe2"),
        (b"12345678901234567890\n123456789012345678901\n", "line 2: the line has more than 20 bytes"),
    ] {
        let error = text(bytes, SMALL).unwrap_err();
        assert!(error.starts_with(said), "{error}");
    }
    assert_eq!(text("a\n".repeat(50), SMALL).unwrap().len(), 100);
    let error = text("a\n".repeat(51), SMALL).unwrap_err();
    assert_eq!(error, "it has more than the 100 bytes that are read of a configuration");
}

#[test]
fn names_in_latin_1_are_read_where_only_numbers_count() {
    assert_eq!(text(b"# M\xfcnchen \xe2\x82\r\nv 0", MESH).unwrap(), "# M?nchen ??\nv 0");
    assert_eq!(text(b"# \xe2\x82", MESH).unwrap(), "# ??");
}

/// Without end, and without much memory: refused at once.
#[test]
fn a_source_without_end_is_refused() {
    for (endless, said) in
        [(&b"\0"[..], "line 1: there is a byte of 0"), (b"x", "line 1: the line has more than 1048576 bytes")]
    {
        let source = endless.repeat(1 << 16);
        let source = io::repeat(0).take(1 << 12).chain(Pieces(&source, 4096)).take(1 << 21);
        let source: Box<dyn Read> = match endless {
            b"\0" => Box::new(source),
            _ => Box::new(io::repeat(b'x')),
        };
        let mut text = String::new();
        let error = TextReader::new(source, ANSWER_LOG).read_to_string(&mut text).unwrap_err();
        assert!(error.to_string().starts_with(said), "{error}");
    }
}

#[test]
fn files_are_named() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("a.json");
    let said = |path: &Path, kind| read(path, kind).unwrap_err().to_string().replace('\\', "/");
    let shown = path.display();
    assert!(said(&path, SMALL).starts_with(&format!("cannot read the configuration {shown}: ")));
    assert!(read(&path, SMALL).unwrap_err().is_missing());
    assert!(said(place.path(), SMALL).ends_with("it is a directory; give the path of a file"));
    for bytes in [&b""[..], b"\xef\xbb\xbf"] {
        fs::write(&path, bytes).unwrap();
        let said = said(&path, SMALL);
        assert!(said.contains("the file is empty; `blysk presets show NAME`"), "{said}");
    }
    fs::write(&path, "a\n".repeat(51)).unwrap();
    assert!(said(&path, SMALL).contains("more than the 100 bytes"));
    fs::write(&path, b"a\n\xff").unwrap();
    assert!(said(&path, SMALL).starts_with(&format!("{shown}:2: the line is not UTF-8: ")));
    fs::write(&path, b"\xef\xbb\xbfa\r\n").unwrap();
    assert_eq!(read(&path, SMALL).unwrap(), "a\n");
}

proptest! {
    /// Good text comes through as it is, but for its line ends; anything else is refused.
    #[test]
    fn text_comes_through(bytes in prop::collection::vec(any::<u8>(), 0..300), size in 1_usize..9) {
        let kind = TextKind { most_bytes: 1000, most_line_bytes: 1000, ..CONFIGURATION };
        let whole = in_pieces(&bytes, 1 << 20, kind).map_err(|problem| problem.to_string());
        let pieces = in_pieces(&bytes, size, kind).map_err(|problem| problem.to_string());
        prop_assert_eq!(&whole, &pieces);
        if let Ok(text) = whole {
            let given = String::from_utf8(bytes).unwrap();
            let given = given.trim_start_matches('\u{feff}');
            prop_assert_eq!(text, given.replace("\r\n", "\n").replace('\r', "\n"));
        }
    }

    #[test]
    fn any_text_is_text(given in "[^\0]{0,200}") {
        let kind = TextKind { most_bytes: 1000, most_line_bytes: 1000, ..CONFIGURATION };
        let text = in_pieces(given.as_bytes(), 5, kind).unwrap();
        let given = given.trim_start_matches('\u{feff}');
        prop_assert_eq!(text, given.replace("\r\n", "\n").replace('\r', "\n"));
    }
}
