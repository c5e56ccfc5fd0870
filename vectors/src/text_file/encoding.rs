//! Which encoding a file begins like.

/// The mark that some programs write in front of UTF-8.
pub(super) const UTF8_MARK: &[u8] = &[0xef, 0xbb, 0xbf];

/// How many bytes are looked at.
pub(super) const BEGINNING: usize = 64;

/// The encoding of a file that begins like this, by the name that `iconv` has for it; none for UTF-8 and for what
/// may be anything.
pub(super) fn foreign(beginning: &[u8]) -> Option<&'static str> {
    match beginning {
        [0xff, 0xfe, 0, 0, ..] => Some("UTF-32LE"),
        [0, 0, 0xfe, 0xff, ..] => Some("UTF-32BE"),
        [0xff, 0xfe, ..] => Some("UTF-16LE"),
        [0xfe, 0xff, ..] => Some("UTF-16BE"),
        _ => without_mark(beginning.get(..BEGINNING).unwrap_or(beginning)),
    }
}

/// Our files begin with ASCII, of which UTF-16 has every other byte 0, and UTF-32 three of four.
fn without_mark(beginning: &[u8]) -> Option<&'static str> {
    let of_four: Vec<[bool; 4]> = beginning.as_chunks::<4>().0.iter().map(|four| four.map(|byte| byte == 0)).collect();
    let all = |wanted: [bool; 4]| !of_four.is_empty() && of_four.iter().all(|four| *four == wanted);
    if all([false, true, true, true]) {
        return Some("UTF-32LE");
    }
    if all([true, true, true, false]) {
        return Some("UTF-32BE");
    }
    let pairs = beginning.as_chunks::<2>().0;
    let (first, second) = pairs
        .iter()
        .fold((0, 0), |(first, second), pair| (first + usize::from(pair[0] == 0), second + usize::from(pair[1] == 0)));
    // Some of the characters may be others.
    match (first, second) {
        (0, second) if 2 * second > pairs.len() => Some("UTF-16LE"),
        (first, 0) if 2 * first > pairs.len() => Some("UTF-16BE"),
        _ => None,
    }
}
