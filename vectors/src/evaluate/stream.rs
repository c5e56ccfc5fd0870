//! Lines in, lines out.

use std::io::{self, BufRead, Write};
use std::path::Path;

use crate::text_file::{QUESTIONS, TextError};
use hw_model::datapath::{Datapath, Logic, Requests};
use memchr::memchr;
use thiserror::Error;

use super::answer::{Answer, Question};

/// Questions that are evaluated side by side.
const SIDE_BY_SIDE: usize = 64;
/// Answers are written in pieces of about this many bytes.
const PIECE: usize = 1 << 16;

/// How questions and answers are written.
pub trait Dialect {
    /// What stands before the first answer.
    fn header(&self) -> &'static str;

    /// What questions look like, for the message when there was none.
    fn wanted(&self) -> &'static str;

    /// Appends the questions of the lines that a text begins with, each a question ended by LF, and returns how many
    /// bytes these lines have: at most so many lines, and none that needs a closer look. That is left to
    /// [`read`](Self::read), as every line is by a dialect that has no shorter way.
    fn begin(&mut self, text: &str, most: usize, questions: &mut Vec<Question>) -> usize {
        let _ = (text, most, questions);
        0
    }

    /// Appends the question of a line; nothing where the line asks none (it is empty, a comment or names the columns).
    ///
    /// # Errors
    /// What is wrong with the line, and what would be right.
    fn read(&mut self, line: &str, questions: &mut Vec<Question>) -> Result<(), String>;

    /// Appends a line for each answer.
    fn write(&mut self, answers: &[Answer], to: &mut Vec<u8>);
}

/// Why the stream ended early. The lines before were answered.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StreamError {
    /// A line that is no question.
    #[error("{questions}:{line}: {problem}")]
    Line {
        /// The name of the file, or of standard input.
        questions: String,
        /// The line, counted from 1.
        line: u64,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// The questions cannot be read, or are no text.
    #[error(transparent)]
    Read(TextError),
    /// The answers cannot be written.
    #[error(transparent)]
    Write(io::Error),
    /// There was no question.
    #[error("{questions}: there is no question; {wanted}")]
    Empty {
        /// The name of the file, or of standard input.
        questions: String,
        /// What there should be.
        wanted: &'static str,
    },
}

/// Answers every line of `from`, in order, and returns how many were answered. `questions` is for messages; `from`
/// gives text, as [`TextReader`](crate::text_file::TextReader) does.
///
/// # Errors
/// At the first line that is no question: those before it are answered and written. When writing fails, or reading:
/// then what was read last is not answered.
pub fn stream(
    datapath: &Datapath,
    dialect: &mut impl Dialect,
    (questions, mut from): (&Path, impl BufRead),
    to: &mut dyn Write,
) -> Result<u64, StreamError> {
    let mut batch = Batch::new(datapath, dialect, questions);
    // The beginning of a line whose end has not been read yet.
    let mut begun = String::new();
    loop {
        // A reader of text hands on whole characters.
        let text = |read| str::from_utf8(read).map_err(|_| io::ErrorKind::InvalidData.into());
        let read = match from.fill_buf().and_then(text) {
            Ok(read) => read,
            Err(error) => {
                batch.finish(to)?;
                return Err(StreamError::Read(TextError::new(questions, &QUESTIONS, error)));
            }
        };
        let length = read.len();
        let result = batch.take(read, &mut begun, to);
        from.consume(length);
        // What stands before a wrong line is answered all the same.
        let answered = batch.finish(to);
        result?;
        answered?;
        if length == 0 {
            return batch.end();
        }
    }
}

/// Questions that wait for an answer.
struct Batch<'a, D> {
    datapath: &'a Datapath,
    dialect: &'a mut D,
    questions_of: &'a Path,
    logic: Logic,
    requests: Box<Requests<SIDE_BY_SIDE, SIDE_BY_SIDE>>,
    questions: Vec<Question>,
    answers: Vec<Answer>,
    written: Vec<u8>,
    line: u64,
    answered: u64,
}

impl<'a, D: Dialect> Batch<'a, D> {
    fn new(datapath: &'a Datapath, dialect: &'a mut D, questions: &'a Path) -> Self {
        Self {
            datapath,
            questions_of: questions,
            logic: datapath.logic(),
            requests: datapath.requests(),
            questions: Vec::with_capacity(SIDE_BY_SIDE),
            answers: Vec::with_capacity(SIDE_BY_SIDE),
            written: dialect.header().as_bytes().to_vec(),
            dialect,
            line: 0,
            answered: 0,
        }
    }

    /// Takes in the complete lines of what was read; nothing read is the end of the last line.
    fn take(&mut self, read: &str, begun: &mut String, to: &mut dyn Write) -> Result<(), StreamError> {
        if read.is_empty() {
            let line = std::mem::take(begun);
            return if line.is_empty() { Ok(()) } else { self.line(&line, to) };
        }
        let mut rest = read;
        loop {
            if begun.is_empty() {
                rest = self.lines(rest, to)?;
            }
            let Some(end) = memchr(b'\n', rest.as_bytes()) else { break };
            let line = &rest[..end];
            rest = &rest[end + 1..];
            if begun.is_empty() {
                self.line(line, to)?;
            } else {
                begun.push_str(line);
                self.line(&std::mem::take(begun), to)?;
            }
        }
        begun.push_str(rest);
        Ok(())
    }

    /// Takes in the lines that a text begins with, as long as the dialect reads them together, and returns the rest.
    fn lines<'t>(&mut self, mut text: &'t str, to: &mut dyn Write) -> Result<&'t str, StreamError> {
        loop {
            let waiting = self.questions.len();
            let length = self.dialect.begin(text, SIDE_BY_SIDE - waiting, &mut self.questions);
            self.line += (self.questions.len() - waiting) as u64;
            text = &text[length..];
            if self.questions.len() < SIDE_BY_SIDE {
                return Ok(text);
            }
            self.answer(to)?;
        }
    }

    fn line(&mut self, line: &str, to: &mut dyn Write) -> Result<(), StreamError> {
        self.line += 1;
        self.dialect.read(line, &mut self.questions).map_err(|problem| {
            let questions = self.questions_of.display().to_string();
            StreamError::Line { questions, line: self.line, problem }
        })?;
        if self.questions.len() == SIDE_BY_SIDE { self.answer(to) } else { Ok(()) }
    }

    /// Evaluates what waits, together.
    fn answer(&mut self, to: &mut dyn Write) -> Result<(), StreamError> {
        let places = self.requests.addresses.iter_mut().zip(&mut self.requests.xs);
        // What is left of an earlier batch behind the last question is evaluated and not looked at.
        for (question, (address, x)) in self.questions.iter().zip(places) {
            (*address, *x) = (question.address, question.x);
        }
        self.logic.evaluate(self.datapath, &mut self.requests, 0);
        self.answers.clear();
        self.answers.extend(self.questions.iter().enumerate().map(|(index, &question)| Answer {
            question,
            intensity: self.requests.intensities()[index],
            status: self.requests.status(index),
            region: self.requests.region(index),
        }));
        self.dialect.write(&self.answers, &mut self.written);
        self.answered += self.questions.len() as u64;
        self.questions.clear();
        if self.written.len() >= PIECE {
            to.write_all(&self.written).map_err(StreamError::Write)?;
            self.written.clear();
        }
        Ok(())
    }

    /// Everything that was read is answered, and the answers are flushed.
    fn finish(&mut self, to: &mut dyn Write) -> Result<(), StreamError> {
        if !self.questions.is_empty() {
            self.answer(to)?;
        }
        if self.answered > 0 {
            to.write_all(&self.written).map_err(StreamError::Write)?;
            self.written.clear();
            to.flush().map_err(StreamError::Write)?;
        }
        Ok(())
    }

    fn end(self) -> Result<u64, StreamError> {
        if self.answered > 0 {
            return Ok(self.answered);
        }
        let questions = self.questions_of.display().to_string();
        Err(StreamError::Empty { questions, wanted: self.dialect.wanted() })
    }
}
