//! The statements of an OBJ file, or of a library of its materials: lines without comments, joined where they go on.

use std::borrow::Cow;
use std::iter::Enumerate;
use std::str::Lines;

/// Every statement with the line it begins in, counted from 1.
///
/// `#` begins a comment wherever it stands, to the end of its line. `\` at the end of a line joins the next one to it,
/// with a space between. A comment is not joined to anything: one that ends in a path, `C:\models\`, would swallow a
/// vertex.
#[derive(Debug)]
pub(crate) struct Statements<'a> {
    lines: Enumerate<Lines<'a>>,
}

impl<'a> Statements<'a> {
    pub(crate) fn of(text: &'a str) -> Self {
        Self { lines: text.lines().enumerate() }
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = (usize, Cow<'a, str>);

    fn next(&mut self) -> Option<Self::Item> {
        let (index, line) = self.lines.next()?;
        let (start, mut goes_on) = piece(line);
        let mut statement = Cow::Borrowed(start);
        while goes_on {
            let Some((_, line)) = self.lines.next() else { break };
            let (more, further) = piece(line);
            let joined = statement.to_mut();
            joined.push(' ');
            joined.push_str(more);
            goes_on = further;
        }
        Some((index + 1, statement))
    }
}

/// What a line says, and whether the next one goes on with it. Files that were put together have marks inside.
fn piece(line: &str) -> (&str, bool) {
    let line = line.trim_start_matches('\u{feff}');
    if let Some((statement, _comment)) = line.split_once('#') {
        return (statement, false);
    }
    match line.trim_end().strip_suffix('\\') {
        Some(statement) => (statement, true),
        None => (line, false),
    }
}
