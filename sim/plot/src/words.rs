//! Breaking text into lines that fit.
//!
//! The widths are upper bounds for DejaVu Sans in three classes of letters: enough to keep every
//! line inside the picture, without shaping the text before it is drawn.

/// At most this wide, in SVG units, at this height of letters.
pub(super) fn width(text: &str, size: u32) -> f64 {
    text.chars().map(em).sum::<f64>() * f64::from(size)
}

fn em(letter: char) -> f64 {
    match letter {
        'i' | 'j' | 'l' | 'f' | 't' | 'r' | 'I' | ' ' | '.' | ',' | ':' | ';' | '!' | '|' | '(' | ')' | '[' | ']'
        | '/' | '-' | '\'' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' => 1.0,
        'A'..='Z' => 0.79,
        '+' | '<' | '=' | '>' | '~' | '#' | '_' | '"' | '^' => 0.84,
        letter if letter.is_ascii() => 0.65,
        '·' | '⁰'..='⁹' | '¹' | '²' | '³' => 0.42,
        '⁻' => 0.55,
        // Greek and superscript letters are narrower, Cyrillic ones nearly as wide as this.
        _ => 1.0,
    }
}

/// The text in lines no longer than `length`, broken between words, and inside a word only where
/// it is longer than a line. Never empty.
pub(super) fn lines(text: &str, size: u32, length: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        for piece in pieces(word, size, length) {
            let last = lines.last().map_or("", String::as_str);
            if last.is_empty() {
                lines.pop();
                lines.push(piece);
                continue;
            }
            let joined = format!("{last} {piece}");
            if width(&joined, size) <= length {
                lines.pop();
                lines.push(joined);
            } else {
                lines.push(piece);
            }
        }
    }
    lines
}

/// A word, cut where it is longer than a line.
fn pieces(word: &str, size: u32, length: f64) -> Vec<String> {
    let mut pieces = Vec::new();
    let mut piece = String::new();
    for letter in word.chars() {
        piece.push(letter);
        if piece.chars().count() > 1 && width(&piece, size) > length {
            piece.pop();
            pieces.push(std::mem::replace(&mut piece, letter.to_string()));
        }
    }
    pieces.push(piece);
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_fit_and_no_letter_is_lost() {
        let text = format!("cos γ to the n-th  power {} and so on", "щ".repeat(40));
        let broken = lines(&text, 12, 120.0);
        assert!(broken.len() > 4);
        assert!(broken.iter().all(|line| width(line, 12) <= 120.0));
        let letters = |text: &str| text.split_whitespace().collect::<String>();
        assert_eq!(letters(&broken.concat()), letters(&text));
    }

    #[test]
    fn short_text_is_left_alone() {
        assert_eq!(lines("error, %", 12, 120.0), ["error, %"]);
        assert_eq!(lines("", 12, 120.0), [""]);
        assert_eq!(lines("ab", 12, 0.0), ["a", "b"]);
    }
}
