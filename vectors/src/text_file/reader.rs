//! Text as it streams past.

use std::io::{self, BufRead, Read};

use memchr::{memchr_iter, memchr2, memrchr};

use super::encoding::{BEGINNING, UTF8_MARK, foreign};
use super::kinds::TextKind;
use super::problem::TextProblem;

/// Bytes taken from the source at a time.
const CHUNK: u64 = 1 << 16;

/// A reader that hands on text only: UTF-8 without a mark, with LF at the end of every line, and no more of it
/// than its kind may have. Everything else is an error, which turns into a [`TextProblem`].
#[derive(Debug)]
pub struct TextReader<R> {
    source: R,
    kind: TextKind,
    /// Read, and not yet looked at.
    raw: Vec<u8>,
    /// Looked at, to be handed on.
    ready: Vec<u8>,
    taken: usize,
    total: u64,
    /// Where the next byte stands: its line from 1, and the bytes of the line before it.
    line: u64,
    column: u64,
    /// The last byte was a CR, whose LF is none of its own.
    after_return: bool,
    begun: bool,
    ended: bool,
}

impl<R: Read> TextReader<R> {
    /// The text that `source` gives.
    pub fn new(source: R, kind: TextKind) -> Self {
        Self {
            source,
            kind,
            raw: Vec::new(),
            ready: Vec::new(),
            taken: 0,
            total: 0,
            line: 1,
            column: 0,
            after_return: false,
            begun: false,
            ended: false,
        }
    }

    /// Makes more of the text ready; none is at the end.
    fn advance(&mut self) -> Result<(), TextProblem> {
        self.ready.clear();
        self.taken = 0;
        self.read_more()?;
        if !self.begun {
            self.begin()?;
        }
        let looked_at = self.check_utf8()?;
        let rest = self.raw.split_off(looked_at);
        let text = std::mem::replace(&mut self.raw, rest);
        if self.is_plain(&text) {
            self.count(&text);
            self.ready = text;
            return Ok(());
        }
        self.hand_on(&text)
    }

    /// Whether [`hand_on`](Self::hand_on) would find nothing wrong with this text, and nothing to change.
    fn is_plain(&self, text: &[u8]) -> bool {
        let most = self.kind.most_line_bytes;
        // A line ends in every stretch as long as a line may be, the first of which began before this text.
        let (mut rest, mut room) = (text, most.saturating_sub(self.column));
        while rest.len() as u64 > room {
            let stretch = rest.get(..=room as usize).unwrap_or(rest);
            let Some(end) = memrchr(b'\n', stretch) else { return false };
            (rest, room) = (rest.get(end + 1..).unwrap_or_default(), most);
        }
        !self.after_return && memchr2(b'\r', 0, text).is_none()
    }

    /// Goes on to where this text ends.
    fn count(&mut self, text: &[u8]) {
        self.line += memchr_iter(b'\n', text).count() as u64;
        let last = memrchr(b'\n', text);
        self.column = last.map_or(self.column + text.len() as u64, |end| (text.len() - end - 1) as u64);
    }

    fn read_more(&mut self) -> Result<(), TextProblem> {
        let before = self.raw.len();
        // At least one byte, else what streams slowly would wait for a whole chunk.
        loop {
            let mut chunk = [0; CHUNK as usize];
            match self.source.read(&mut chunk) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(error.into()),
                Ok(count) => self.raw.extend_from_slice(chunk.get(..count).unwrap_or(&chunk)),
            }
            break;
        }
        let count = self.raw.len() - before;
        self.ended = count == 0;
        self.total += count as u64;
        if self.total > self.kind.most_bytes { Err(self.kind.too_long()) } else { Ok(()) }
    }

    fn begin(&mut self) -> Result<(), TextProblem> {
        self.begun = true;
        while !self.ended && self.raw.len() < BEGINNING && !is_plain_line(&self.raw) {
            self.read_more()?;
        }
        if let Some(name) = foreign(&self.raw) {
            return Err(TextProblem::Encoding { name });
        }
        // Two, where a file with a mark was given another.
        while self.raw.starts_with(UTF8_MARK) {
            self.raw.drain(..UTF8_MARK.len());
        }
        Ok(())
    }

    /// How many bytes are UTF-8: all but a character that the next chunk completes.
    fn check_utf8(&mut self) -> Result<usize, TextProblem> {
        let mut valid = 0;
        loop {
            let rest = self.raw.get(valid..).unwrap_or_default();
            let Err(error) = std::str::from_utf8(rest) else { return Ok(self.raw.len()) };
            valid += error.valid_up_to();
            let wrong = match error.error_len() {
                None if !self.ended => return Ok(valid),
                None => self.raw.len() - valid,
                Some(count) => count,
            };
            if !self.kind.lossy {
                return Err(self.not_utf8(valid));
            }
            for byte in self.raw.iter_mut().skip(valid).take(wrong) {
                *byte = b'?';
            }
        }
    }

    /// The byte at this place of what was read is wrong.
    fn not_utf8(&mut self, place: usize) -> TextProblem {
        let value = self.raw.get(place).copied().unwrap_or_default();
        let before = self.raw.get(..place).unwrap_or_default().to_vec();
        match self.hand_on(&before) {
            Err(earlier) => earlier,
            Ok(()) => TextProblem::NotUtf8 { line: self.line, byte: self.column + 1, value },
        }
    }

    fn hand_on(&mut self, text: &[u8]) -> Result<(), TextProblem> {
        for piece in text.split_inclusive(|byte| matches!(byte, b'\n' | b'\r')) {
            if std::mem::take(&mut self.after_return) && piece == b"\n" {
                continue;
            }
            let (content, end) = match piece {
                [content @ .., end @ (b'\n' | b'\r')] => (content, Some(*end)),
                content => (content, None),
            };
            self.column += content.len() as u64;
            let (line, most) = (self.line, self.kind.most_line_bytes);
            if content.contains(&0) {
                return Err(TextProblem::Nul { line });
            }
            if self.column > most {
                return Err(TextProblem::LongLine { line, most });
            }
            self.ready.extend_from_slice(content);
            if let Some(end) = end {
                self.ready.push(b'\n');
                self.after_return = end == b'\r';
                self.line += 1;
                self.column = 0;
            }
        }
        Ok(())
    }
}

/// Whether a line of ASCII is there, which no other encoding begins with: it is enough, as who writes a line and waits
/// for an answer writes no more.
fn is_plain_line(beginning: &[u8]) -> bool {
    let text = beginning.strip_prefix(UTF8_MARK).unwrap_or(beginning);
    text.len() >= 4 && text.contains(&b'\n') && text.is_ascii() && !text.contains(&0)
}

impl<R: Read> BufRead for TextReader<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.taken >= self.ready.len() && !self.ended {
            self.advance()?;
        }
        Ok(self.ready.get(self.taken..).unwrap_or_default())
    }

    fn consume(&mut self, count: usize) {
        self.taken += count;
    }
}

impl<R: Read> Read for TextReader<R> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(to)?;
        self.consume(count);
        Ok(count)
    }
}
