//! A list of questions, read to its end and not answered: the cases of a bundle.

use std::io::BufRead;
use std::path::Path;

use crate::text_file::{QUESTIONS, TextError};

use super::answer::Question;
use super::stream::{Dialect, StreamError};

/// Every question of `from`, in order, at most `most` of them. `name` is for messages; `from` gives text, as
/// [`TextReader`](crate::text_file::TextReader) does.
///
/// # Errors
/// At the first line that is no question, or one question too many; when reading fails; when there is no question.
pub fn questions(
    dialect: &mut impl Dialect,
    (name, mut from): (&Path, impl BufRead),
    most: u64,
) -> Result<Vec<Question>, StreamError> {
    let mut questions = Vec::new();
    let mut text = String::new();
    let mut line = 0;
    let shown = || name.display().to_string();
    loop {
        text.clear();
        let read = from.read_line(&mut text);
        if read.map_err(|error| StreamError::Read(TextError::new(name, &QUESTIONS, error)))? == 0 {
            break;
        }
        line += 1;
        let wrong = |problem| StreamError::Line { questions: shown(), line, problem };
        dialect.read(text.trim_end_matches('\n'), &mut questions).map_err(wrong)?;
        if questions.len() as u64 > most {
            return Err(wrong(format!("there are more than {most} questions; make several lists")));
        }
    }
    if questions.is_empty() {
        return Err(StreamError::Empty { questions: shown(), wanted: dialect.wanted() });
    }
    Ok(questions)
}
