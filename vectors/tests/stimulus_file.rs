//! The stimulus file of the simulator: what it means, and what is wrong with a wrong one.

mod common;

use std::path::Path;

use proptest::prelude::*;
use vectors::stimulus_file::{StimulusError, StimulusLine, parse_stimulus};

fn parse(text: impl AsRef<[u8]>) -> Result<Vec<StimulusLine>, StimulusError> {
    // n in 1, 2, 3.5, 8; x in Q2.8
    let design = common::small();
    parse_stimulus(text.as_ref(), Path::new("in.csv"), design.rom(), design.config().input)
}

#[test]
fn columns_come_in_any_order_and_have_defaults() {
    let cycles = parse("# by hand\nx, n\n0.5,2\n# more\n-2,64\n 1.00390625 , 3.5\n").unwrap();
    let seen: Vec<_> = cycles.iter().map(|c| (c.case.address, c.case.x)).collect();
    assert_eq!(seen, [(1, 128), (4, -512), (2, 257)]);
    assert!(cycles.iter().all(|c| c.valid && c.ready && !c.reset));
    assert_eq!(cycles[1].case.exponent, Some(64.0), "an exponent without a word is kept");

    let cycles = parse("reset,ready,valid,x_bits,n\n1,0,0,,\n0,1,1,0x3ff,8\n0,0,0,-512,1").unwrap();
    let [first, second, third] = cycles[..] else { panic!("{cycles:?}") };
    assert_eq!((first.reset, first.ready, first.valid), (true, false, false));
    assert_eq!((first.case.address, first.case.x, first.case.exponent), (0, 0, None));
    assert_eq!((second.reset, second.ready, second.valid), (false, true, true));
    assert_eq!((second.case.address, second.case.x), (3, -1));
    assert_eq!((third.valid, third.case.x), (false, -512));
}

#[test]
fn a_real_x_is_rounded_to_the_nearest_and_a_tie_to_even() {
    let cycles = parse("n,x\n1,0.001953125\n1,0.005859375\n1,0.0020\n1,5e-1\n").unwrap();
    let xs: Vec<i64> = cycles.iter().map(|c| c.case.x).collect();
    assert_eq!(xs, [0, 2, 1, 128]);
}

proptest! {
    #[test]
    fn bits_come_back(xs in prop::collection::vec(-512_i64..512, 1..20)) {
        let lines = |text: fn(&i64) -> String| xs.iter().map(text).collect::<String>();
        let given = |text: String| {
            parse(text).unwrap().iter().map(|cycle| cycle.case.x).collect::<Vec<_>>()
        };
        prop_assert_eq!(&given(format!("n,x_bits\n{}", lines(|x| format!("1,{x}\n")))), &xs);
        prop_assert_eq!(&given(format!("n,x_bits\n{}", lines(|x| format!("1,{:#x}\n", x & 0x3ff)))), &xs);
        prop_assert_eq!(&given(format!("n,x\n{}", lines(|x| format!("1,{}\n", *x as f64 / 256.0)))), &xs);
    }
}

#[test]
fn a_wrong_field_is_named_with_its_line() {
    for (text, line, field, part) in [
        ("n,x\n1,0\n0.5,0\n", 3, "n", "from 1 up"),
        ("n,x\nNaN,0\n", 2, "n", "from 1 up"),
        ("n,x\ninf,0\n", 2, "n", "finite"),
        ("n,x\n,0\n", 2, "n", "not a number"),
        ("n,x\nbig,0\n", 2, "n", "such as 64"),
        ("n,x\n1,NaN\n", 2, "x", "finite"),
        ("n,x\n1,-inf\n", 2, "x", "finite"),
        ("n,x\n\n# c\n1,2\n", 4, "x", "-2 to 1.99609375"),
        ("n,x\n1,0x10\n", 2, "x", "x_bits"),
        ("n,x\n1,\n", 2, "x", "not a number"),
        ("n,x_bits\n1,512\n", 2, "x_bits", "-512 to 511"),
        ("n,x_bits\n1,0x400\n", 2, "x_bits", "10 bits"),
        ("n,x_bits\n1,0.5\n", 2, "x_bits", "integer"),
        ("n,x_bits\n1,0x+1\n", 2, "x_bits", "integer"),
        ("n,x,valid\n1,0,yes\n", 2, "valid", "neither 0 nor 1"),
        ("n,x,ready\n1,0,2\n", 2, "ready", "neither 0 nor 1"),
        ("n,x,reset\n1,0,\n", 2, "reset", "neither 0 nor 1"),
        ("n,x,valid\n,,1\n", 2, "n", "not a number"),
        ("n,x,valid\n,0.5,0\n", 2, "n", "not a number"),
    ] {
        match parse(text) {
            Err(error @ StimulusError::Field { .. }) => {
                let message = error.to_string();
                let place = format!("in.csv:{line}: field `{field}`: ");
                assert!(message.starts_with(&place), "{text:?}: {message}");
                assert!(message.contains(part), "{text:?}: {message}");
            }
            other => panic!("{text:?}: {other:?}"),
        }
    }
}

#[test]
fn a_wrong_file_is_named() {
    for (text, wanted) in [
        ("", "in.csv has no cycles: it is empty, or has comments only; write a line"),
        ("\u{feff}", "in.csv has no cycles: it is empty, or has comments only; write a line"),
        ("n,x\n", "in.csv has no cycles"),
        ("# only a comment\n", "in.csv has no cycles"),
        ("n\n1\n", "in.csv:1: the column `x` is missing"),
        ("x\n1\n", "in.csv:1: the column `n` is missing"),
        ("# c\nn,x,y\n1,1,1\n", "in.csv:2: there is no column \"y\""),
        ("n,x,n\n", "in.csv:1: the column `n` is named twice"),
        ("n,x,x_bits\n", "in.csv:1: x is given as `x` and as `x_bits`"),
        ("n,x\n1,0\n1\n", "in.csv:3: there are 1 fields, the first line names 2"),
        ("n,x\n1,0,1\n", "in.csv:2: there are 3 fields"),
    ] {
        let message = parse(text).unwrap_err().to_string();
        assert!(message.starts_with(wanted), "{text:?}: {message}");
    }
    let message = parse(b"n,x\n1,\xff\n").unwrap_err().to_string();
    assert!(message.starts_with("in.csv:2: the line is not UTF-8: its byte 3 is 0xff"), "{message}");
    let cycles = parse("\u{feff}\"n\",\"x\"\r\n\"2\",\"0.5\"\r\n").unwrap();
    assert_eq!((cycles[0].case.address, cycles[0].case.x), (1, 128));
}

/// Tables of other countries: the separator and the comma of numbers are named, with what would be right.
#[test]
fn other_separators_and_decimal_commas_are_named() {
    for (text, wanted) in [
        ("n;x\n1;0,5\n", "in.csv:1: the fields are separated by `;`; separate them by `,`"),
        ("# c\n\"n\";\"x\"\n", "in.csv:2: the fields are separated by `;`"),
        ("n\tx\n1\t0.5\n", "in.csv:1: the fields are separated by tabs"),
        ("n|x\n", "in.csv:1: the fields are separated by `|`"),
        ("sep=;\nn;x\n", "in.csv:1: `sep=` is no column"),
        ("n,x\n1;0.5\n", "in.csv:2: there are 1 fields, the first line names 2 columns: the fields"),
        (
            "n,x\n1,0,5\n",
            "in.csv:2: there are 3 fields, the first line names 2 columns: is `0,5` a decimal comma? write 0.5",
        ),
        ("n,x\n64,\"0,75\"\n", "in.csv:2: there are 3 fields, the first line names 2 columns: is `0,75`"),
        ("n,x\n1,-0,5\n", "in.csv:2: there are 3 fields, the first line names 2 columns: is `-0,5`"),
    ] {
        let message = parse(text).unwrap_err().to_string();
        assert!(message.starts_with(wanted), "{text:?}: {message}");
    }
}

#[test]
fn line_ends_quotes_and_marks_do_not_count() {
    let wanted = parse("n,x\n2,0.5\n3.5,1\n").unwrap();
    for text in [
        "n,x\r\n2,0.5\r\n3.5,1",
        "n,x\r2,0.5\r3.5,1\r",
        "\u{feff}n,x\n2,0.5\n\u{feff}3.5,1\n",
        " \"n\" ,\t\" x \"\n  # c\n \"2\", \"0.5\"\n   \n3.5,1\n",
    ] {
        assert_eq!(parse(text).unwrap(), wanted, "{text:?}");
    }
}

proptest! {
    #[test]
    fn bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _read = parse(bytes);
    }

    /// One byte of a good file replaced, left out or put in.
    #[test]
    fn altered_files_are_read_or_refused(place in 0_usize..40, byte in any::<u8>(), how in 0..3) {
        let mut bytes = b"n,x,valid\n2,0.5,1\n# c\n3.5,-0.25,1\n".to_vec();
        let place = place % bytes.len();
        match how {
            0 => bytes[place] = byte,
            1 => drop(bytes.remove(place)),
            _ => bytes.insert(place, byte),
        }
        let line = bytes.iter().filter(|&&byte| byte == b'\n' || byte == b'\r').count() + 1;
        if let Err(error) = parse(bytes) {
            let said = error.to_string();
            let named = (1..=line).any(|line| said.starts_with(&format!("in.csv:{line}: ")));
            prop_assert!(named || said.contains("UTF-16"), "{}", said);
        }
    }
}
