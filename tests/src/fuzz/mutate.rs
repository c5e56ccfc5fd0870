//! Altered inputs: bits and bytes, lines and tokens, nodes of JSON. The same seed gives the same input.

use serde_json::Value;

use super::archive;
use naive::configurations::Random;

/// What an input looks like, and so what is altered in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A JSON document, altered node by node.
    Json,
    /// Lines of tokens, altered line by line.
    Lines,
    /// Several files in one (`archive`).
    Archive,
}

/// No input is longer.
const LONGEST: usize = 1 << 16;

/// Numbers and words at which readers go wrong.
const TOKENS: [&str; 52] = [
    "",
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "3",
    "4",
    "7",
    "8",
    "9",
    "63",
    "64",
    "65",
    "127",
    "128",
    "255",
    "256",
    "65535",
    "65536",
    "65537",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "-9223372036854775808",
    "1e15",
    "1e16",
    "1e308",
    "1e400",
    "-1e400",
    "5e-324",
    "0.5",
    "1.0000000000000002",
    "NaN",
    "inf",
    "0x",
    "0xffffffffffffffff",
    "UQ1.62",
    "UQ0.63",
    "Q2.61",
    "UQ-62.63",
    "UQ63.0",
    "UQ1.0",
    "1..=65536",
    "@ffffffffffffffff",
    "\u{feff}",
    "é",
];

/// An input made of `first`, now and then with pieces of `second`.
#[must_use]
pub fn mutate(first: &[u8], second: &[u8], form: Form, random: &mut Random) -> Vec<u8> {
    let mut bytes = first.to_vec();
    for _ in 0..random.one_of(&[1, 1, 2, 4]) {
        bytes = match random.integer(0, 5) {
            0 => altered_bytes(&bytes, random),
            1 => altered_text(&bytes, second, random),
            _ => match form {
                Form::Json => altered_json(&bytes, second, random),
                Form::Lines => altered_text(&bytes, second, random),
                Form::Archive => altered_file(&bytes, second, random),
            },
        };
        bytes.truncate(LONGEST);
    }
    bytes
}

/// A place in a list, or before or behind it.
fn place(len: usize, random: &mut Random) -> usize {
    random.integer(0, len as i64) as usize
}

/// A short run of places.
fn span(len: usize, random: &mut Random) -> std::ops::Range<usize> {
    let start = place(len, random);
    let most = if random.once_in(4) { len } else { 8 };
    start..(start + place(most, random)).min(len)
}

fn altered_bytes(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let range = span(bytes.len(), random);
    match random.integer(0, 4) {
        0 if range.start < bytes.len() => bytes[range.start] ^= 1 << random.integer(0, 7),
        1 => bytes.insert(range.start, random.integer(0, 255) as u8),
        2 => {
            let copy = bytes[range.clone()].to_vec();
            bytes.splice(range.end..range.end, copy);
        }
        3 => bytes.truncate(range.start),
        _ => drop(bytes.drain(range)),
    }
    bytes
}

/// Text that is none becomes bytes.
fn altered_text(bytes: &[u8], second: &[u8], random: &mut Random) -> Vec<u8> {
    let (Ok(text), Ok(second)) = (std::str::from_utf8(bytes), std::str::from_utf8(second)) else {
        return altered_bytes(bytes, random);
    };
    if random.once_in(3) { lines(text, second, random) } else { tokens(text, second, random) }.into_bytes()
}

fn lines(text: &str, second: &str, random: &mut Random) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let others: Vec<&str> = second.lines().collect();
    let at = place(lines.len(), random);
    match random.integer(0, 3) {
        0 if at < lines.len() => drop(lines.remove(at)),
        1 if at < lines.len() => {
            let times = if random.once_in(8) { 200 } else { 1 };
            lines.splice(at..at, std::iter::repeat_n(lines[at], times).collect::<Vec<_>>());
        }
        2 if !others.is_empty() => lines.insert(at, random.one_of(&others)),
        _ if at < lines.len() => lines.swap(at, 0),
        _ => {}
    }
    lines.join("\n") + "\n"
}

/// Pieces of letters and digits, and what is between them.
fn pieces(text: &str) -> Vec<&str> {
    let word = |c: char| c.is_alphanumeric() || "_.+-@=".contains(c);
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|c: char| word(c) != word(first)).unwrap_or(rest.len());
        let (piece, after) = rest.split_at(end);
        pieces.push(piece);
        rest = after;
    }
    pieces
}

fn tokens(text: &str, second: &str, random: &mut Random) -> String {
    let mut pieces = pieces(text);
    let others = self::pieces(second);
    let at = place(pieces.len().saturating_sub(1), random);
    if pieces.is_empty() {
        return token(random);
    }
    let made = token(random);
    match random.integer(0, 3) {
        0 if !others.is_empty() => pieces[at] = random.one_of(&others),
        1 => pieces[at] = pieces[place(pieces.len() - 1, random)],
        2 => pieces.insert(at, &made),
        _ => pieces[at] = &made,
    }
    pieces.concat()
}

/// One of the [`TOKENS`], or a format or small integer that may well be right.
fn token(random: &mut Random) -> String {
    match random.integer(0, 5) {
        0 | 1 => {
            let sign = random.one_of(&["UQ", "UQ", "Q"]);
            format!("{sign}{}.{}", random.integer(-4, 4), random.integer(0, 63))
        }
        2 => random.integer(0, 70).to_string(),
        _ => random.one_of(&TOKENS).to_owned(),
    }
}

fn altered_json(bytes: &[u8], second: &[u8], random: &mut Random) -> Vec<u8> {
    let Ok(mut value) = serde_json::from_slice::<Value>(bytes) else {
        return altered_text(bytes, second, random);
    };
    let graft = serde_json::from_slice::<Value>(second).unwrap_or_default();
    let graft = node(&mut graft.clone(), &mut place(count(&graft) - 1, random)).cloned().unwrap_or_default();
    let mut at = place(count(&value) - 1, random);
    if let Some(found) = node(&mut value, &mut at) {
        alter(found, graft, random);
    }
    serde_json::to_vec_pretty(&value).unwrap_or_default()
}

fn count(value: &Value) -> usize {
    1 + match value {
        Value::Array(list) => list.iter().map(count).sum(),
        Value::Object(map) => map.values().map(count).sum(),
        _ => 0,
    }
}

/// The node at this place, counted from the root on.
fn node<'a>(value: &'a mut Value, at: &mut usize) -> Option<&'a mut Value> {
    if *at == 0 {
        return Some(value);
    }
    *at -= 1;
    match value {
        Value::Array(list) => list.iter_mut().find_map(|value| node(value, at)),
        Value::Object(map) => map.values_mut().find_map(|value| node(value, at)),
        _ => None,
    }
}

fn alter(value: &mut Value, graft: Value, random: &mut Random) {
    match value {
        _ if random.once_in(6) => *value = graft,
        Value::Number(number) if random.once_in(2) => *value = near(number.as_f64().unwrap_or(0.0), random),
        Value::Number(_) => *value = any(random),
        Value::String(text) if !random.once_in(6) => *text = tokens(text, "", random),
        Value::Array(list) if !list.is_empty() => {
            let at = place(list.len() - 1, random);
            match random.integer(0, 2) {
                0 => drop(list.remove(at)),
                1 => list.insert(at, list[at].clone()),
                _ => list.swap(at, 0),
            }
        }
        Value::Object(map) if !map.is_empty() => {
            let keys: Vec<String> = map.keys().cloned().collect();
            let key = &keys[place(keys.len() - 1, random)];
            let removed = map.remove(key).unwrap_or_default();
            if random.once_in(2) {
                map.insert(keys[place(keys.len() - 1, random)].clone(), removed);
            }
        }
        _ => *value = any(random),
    }
}

/// A number close to another one.
fn near(number: f64, random: &mut Random) -> Value {
    let changed = match random.integer(0, 6) {
        0 => number.next_up(),
        1 => number.next_down(),
        2 => number + 1.0,
        3 => number - 1.0,
        4 => number * 2.0,
        5 => number / 2.0,
        _ => -number,
    };
    // As it was written: an integer stays one.
    match changed.fract() == 0.0 && changed.abs() < 1e15 {
        true => Value::from(changed as i64),
        false => Value::from(changed),
    }
}

/// A token as the JSON it looks like.
fn any(random: &mut Random) -> Value {
    let token = token(random);
    serde_json::from_str(&token).unwrap_or_else(|_| match random.integer(0, 3) {
        0 => Value::Null,
        1 => Value::Array(Vec::new()),
        2 => Value::Bool(true),
        _ => Value::from(token),
    })
}

/// One of the files in an archive, altered as what it is.
fn altered_file(bytes: &[u8], second: &[u8], random: &mut Random) -> Vec<u8> {
    let (mut files, others) = (archive::unpack(bytes), archive::unpack(second));
    if files.is_empty() {
        return altered_bytes(bytes, random);
    }
    let at = place(files.len() - 1, random);
    let (name, contents) = &mut files[at];
    let other = others.iter().find(|(other, _)| other == name).map(|(_, other)| other.as_slice());
    let other = other.unwrap_or_default();
    *contents = match name.ends_with(".json") {
        true => altered_json(contents, other, random),
        false => altered_text(contents, other, random),
    };
    archive::pack(&files)
}
