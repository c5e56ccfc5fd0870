//! A piece of the RTL's text, found by its tokens: a formatter may change the space between them.

/// The text with `wrong` in place of `right`, whose tokens stand there once.
///
/// # Errors
/// How many times they stand there, when that is not once.
pub fn replace_once(text: &str, right: &str, wrong: &str) -> Result<String, usize> {
    let (text_tokens, wanted) = (tokens(text), tokens(right));
    let alike = |window: &&[(usize, &str)]| window.iter().zip(&wanted).all(|((_, here), (_, there))| here == there);
    let places: Vec<_> = text_tokens.windows(wanted.len().max(1)).filter(alike).collect();
    match places.as_slice() {
        [[(start, _), .., (last, end)]] => Ok([&text[..*start], wrong, &text[last + end.len()..]].concat()),
        [[(start, only)]] => Ok([&text[..*start], wrong, &text[start + only.len()..]].concat()),
        places => Err(places.len()),
    }
}

/// Words and single signs, each with the byte that it begins at.
fn tokens(text: &str) -> Vec<(usize, &str)> {
    let in_a_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    let mut place = 0;
    while let Some(first) = text[place..].chars().next() {
        let rest = &text[place..];
        let length = match in_a_word(first) {
            true => rest.find(|c| !in_a_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        if !first.is_whitespace() {
            found.push((place, &rest[..length]));
        }
        place += length;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn space_does_not_matter_and_words_are_whole() {
        let text = "assign a  =\n  b_q;  // b_q\nassign ab = b;";
        assert_eq!(replace_once(text, "a = b_q;", "a = 1;").unwrap(), "assign a = 1;  // b_q\nassign ab = b;");
        assert_eq!(replace_once(text, "b", "c").unwrap(), "assign a  =\n  b_q;  // b_q\nassign ab = c;");
        assert_eq!(replace_once(text, "b_q", "c"), Err(2));
        assert_eq!(replace_once(text, "a = b;", "c"), Err(0));
        assert_eq!(replace_once("x", "a long piece", "c"), Err(0));
    }
}
