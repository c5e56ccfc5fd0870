//! Reads memory files as `$readmemh` does: hex words, addresses, comments.

use std::collections::BTreeSet;
use std::path::Path;

use dashu_int::UBig;
use dashu_int::ops::BitTest;

use super::error::{LineProblem, MemoryError, at_line};
use crate::limits::MOST_NUMBERS;
use crate::text_file::{self, MEMORY};

/// What a number in a memory file means.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Value {
    /// Every digit is known.
    Known(UBig),
    /// Some digits are `x`, `z` or `?`; the number as written, without `_`.
    Unknown(String),
}

/// One number, and where it goes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Its line, counted from 1.
    pub line: u64,
    /// Its address: one more than the number's before it, or as an `@` says.
    pub address: u64,
    /// The word, or a number with unknown digits.
    pub value: Value,
}

/// Every number of a memory file's text, in order; `path` is for messages.
///
/// # Errors
/// Names the line and what is wrong with it.
pub fn parse(text: &str, path: &Path) -> Result<Vec<Entry>, MemoryError> {
    let mut entries = Vec::new();
    let mut next_address = 0_u64;
    for (line, token) in tokens(text, path)? {
        let wrong = |problem| at_line(path, line, problem);
        if let Some(digits) = token.strip_prefix('@') {
            let address = hex_digits(digits).and_then(|digits| u64::from_str_radix(&digits, 16).ok());
            next_address = address.ok_or_else(|| wrong(LineProblem::Address(token.to_owned())))?;
        } else {
            let value = value(token).ok_or_else(|| wrong(LineProblem::Digit(token.to_owned())))?;
            entries.push(Entry { line, address: next_address, value });
            next_address = next_address.saturating_add(1);
        }
    }
    Ok(entries)
}

/// The `depth` words of `width` bits in the memory file at `path`. A word given twice has its last
/// value, as in the language.
///
/// # Errors
/// When the file cannot be read, a line is wrong, a value is unknown or too wide, or a word is
/// missing or beyond the end.
pub fn read_words(path: &Path, width: u32, depth: usize) -> Result<Vec<UBig>, MemoryError> {
    let text = text_file::read(path, MEMORY)?;
    let entries = parse(&text, path)?;
    // Memory follows the file and not the number that is asked for: of more words than the file has, one of the first
    // ones is missing, and it is found in as many places and one more.
    let places = depth.min(entries.len() + 1);
    let mut words: Vec<Option<UBig>> = vec![None; places];
    let mut beyond = BTreeSet::new();
    for Entry { line, address, value } in entries {
        let wrong = |problem| Err(at_line(path, line, problem));
        let place = usize::try_from(address).ok().filter(|place| *place < depth);
        let Some(place) = place else {
            return wrong(LineProblem::PastEnd { address, depth });
        };
        let word = match value {
            Value::Unknown(text) => return wrong(LineProblem::Unknown(text)),
            Value::Known(word) if word.bit_len() > width as usize => {
                return wrong(LineProblem::TooWide { text: format!("{word:x}"), width });
            }
            Value::Known(word) => word,
        };
        match words.get_mut(place) {
            Some(known) => *known = Some(word),
            None => _ = beyond.insert(place),
        }
    }
    let found = words.iter().flatten().count() + beyond.len();
    let missing = words.iter().position(Option::is_none);
    match missing {
        None => Ok(words.into_iter().flatten().collect()),
        Some(address) => Err(MemoryError::Short { path: path.to_owned(), address, found, expected: depth }),
    }
}

/// What a number means; none where it is no hex number.
pub(crate) fn value(token: &str) -> Option<Value> {
    let is_unknown = |c: char| matches!(c, 'x' | 'X' | 'z' | 'Z' | '?');
    if token.contains(is_unknown) {
        hex_digits(&token.replace(is_unknown, "0"))?;
        return Some(Value::Unknown(token.replace('_', "")));
    }
    UBig::from_str_radix(&hex_digits(token)?, 16).ok().map(Value::Known)
}

/// The digits without their `_`; none where they are not a Verilog hex number, which begins with a
/// digit.
fn hex_digits(token: &str) -> Option<String> {
    let proper =
        token.starts_with(|c: char| c.is_ascii_hexdigit()) && token.chars().all(|c| c.is_ascii_hexdigit() || c == '_');
    proper.then(|| token.replace('_', ""))
}

/// The pieces between white space and comments, with their lines.
fn tokens<'a>(text: &'a str, path: &Path) -> Result<Vec<(u64, &'a str)>, MemoryError> {
    let mut tokens = Vec::new();
    let mut open_comment = None;
    for (line, text) in (1..).zip(text.lines()) {
        let mut rest = text;
        while !rest.is_empty() {
            if open_comment.is_some() {
                let Some(end) = rest.find("*/") else { break };
                open_comment = None;
                rest = &rest[end + 2..];
                continue;
            }
            let comment = [rest.find("//"), rest.find("/*")].into_iter().flatten().min();
            let (code, after) = rest.split_at(comment.unwrap_or(rest.len()));
            // One more is enough to see that there are too many, were all of them in one line.
            let more = code.split_whitespace().take(MOST_NUMBERS + 1 - tokens.len());
            tokens.extend(more.map(|token| (line, token)));
            if tokens.len() > MOST_NUMBERS {
                return Err(at_line(path, line, LineProblem::TooMany));
            }
            if !after.starts_with("/*") {
                break;
            }
            open_comment = Some(line);
            rest = &after[2..];
        }
    }
    match open_comment {
        Some(line) => Err(at_line(path, line, LineProblem::OpenComment)),
        None => Ok(tokens),
    }
}
