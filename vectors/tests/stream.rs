//! Streams of questions: lines that are read together are answered as they are one at a time.

use std::io::{self, Read};
use std::path::Path;
use std::sync::LazyLock;

use hw_model::design::Design;
use proptest::prelude::*;
use vectors::evaluate::{Answer, Csv, Dialect, Question, stream};
use vectors::text_file::{QUESTIONS, TextReader};

static DESIGN: LazyLock<Design> = LazyLock::new(|| Design::preset("schlick").unwrap());

/// CSV without the shorter way: a line at a time.
struct LineByLine<'a>(Csv<'a>);

impl Dialect for LineByLine<'_> {
    fn header(&self) -> &'static str {
        self.0.header()
    }
    fn wanted(&self) -> &'static str {
        self.0.wanted()
    }
    fn read(&mut self, line: &str, questions: &mut Vec<Question>) -> Result<(), String> {
        self.0.read(line, questions)
    }
    fn write(&mut self, answers: &[Answer], to: &mut Vec<u8>) {
        self.0.write(answers, to);
    }
}

/// A text as a pipe gives it, in pieces of these lengths in turn.
struct Pieces<'a>(&'a [u8], std::iter::Cycle<std::slice::Iter<'a, usize>>);

impl Read for Pieces<'_> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let count = self.1.next().map_or(1, |&piece| piece.min(to.len()).min(self.0.len()));
        let (now, later) = self.0.split_at(count);
        to[..count].copy_from_slice(now);
        self.0 = later;
        Ok(count)
    }
}

/// What is answered, and how it ends.
fn answered(dialect: &mut impl Dialect, text: &str, pieces: &[usize]) -> (String, String) {
    let reader = TextReader::new(Pieces(text.as_bytes(), pieces.iter().cycle()), QUESTIONS);
    let mut answers = Vec::new();
    let ended = stream(DESIGN.datapath(), dialect, (Path::new("asked"), reader), &mut answers);
    (String::from_utf8(answers).unwrap(), ended.map_or_else(|error| error.to_string(), |count| count.to_string()))
}

proptest! {
    /// Lines that are read together have the answers and the errors, with their places, of one line at a time.
    #[test]
    fn together_is_line_by_line(
        lines in prop::collection::vec(
            prop_oneof![
                60 => "[1-9][0-9]{0,2},[01]\\.[0-9]{1,16}\r?",
                6 => "# a comment| *|[1-9],0\\.[0-9]{3} | \"7\",\"0\\.5\"|2\\.5,1e-3|9, 1",
                1 => "0,0\\.5|7,seven|7|7,0\\.5,3|7;5|7,2\\.5|é,1",
            ],
            0..400,
        ),
        ended in any::<bool>(),
        pieces in prop::collection::vec(1_usize..3000, 1..9),
    ) {
        let text = format!("n,x\n{}{}", lines.join("\n"), if ended { "\n" } else { "" });
        let csv = || Csv::new(DESIGN.datapath());
        let wanted = answered(&mut LineByLine(csv()), &text, &[usize::MAX]);
        prop_assert_eq!(&answered(&mut csv(), &text, &[usize::MAX]), &wanted);
        prop_assert_eq!(&answered(&mut csv(), &text, &pieces), &wanted);
    }
}
