//! `blysk evaluate`: the golden model, asked.

use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::{Args as ClapArgs, ValueEnum};
use hw_model::datapath::Datapath;
use hw_model::design::Design;
use hw_model::quantise::decimal;
use vectors::stimulus_file::{bits, real as real_field};
use vectors::text_file::{self, QUESTIONS, TextReader};

use super::bar;
use super::configuration::Configuration;
use super::out::{Out, Outcome};
use super::table::{Cell, Format as TableFormat, Rows, digits};
use vectors::evaluate::{Answer, Csv, Dialect, Held, Hex, Question, StreamError, stream};

/// Ask the golden model: the intensity of (n, x), or of every line of a file or of standard input.
///
/// With --n and --x the command prints the intensity, x^n, the error and the part of the pipeline that answered. x is
/// rounded to the input format first, and x^n is taken at the rounded x, so that the error is the hardware's.
///
/// With a file, or - for standard input, the command writes an answer for each line, in order, as the lines come. CSV
/// begins with a line that names the columns n (or address) and x (or x_bits, an integer or 0x…); an answer has the
/// columns n, x, intensity, reference, error_ulp, region, intensity_bits, status. In hex a question is a word
/// {address, x} as in stimulus.mem, and an answer a word {status, intensity} as in expected.mem.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk evaluate --preset paper --n 64 --x 0.99 --ranks\n          \
                        blysk evaluate --preset paper --format csv - < questions.csv\n          \
                        blysk evaluate --preset paper --format hex stimulus.mem")]
pub(super) struct Args {
    /// Answer every line of this file; - is standard input.
    #[arg(value_name = "FILE", required_unless_present = "n", conflicts_with_all = ["n", "x", "x_bits", "ranks"])]
    questions: Option<PathBuf>,
    #[command(flatten)]
    configuration: Configuration,
    /// The exponent n, one of the ROM's.
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    n: Option<f64>,
    /// x as a real number.
    #[arg(long, value_name = "X", allow_hyphen_values = true, requires = "n")]
    x: Option<String>,
    /// x as its bits in the input format: an integer, or 0x….
    #[arg(long, value_name = "BITS", allow_hyphen_values = true, requires = "n", conflicts_with = "x")]
    x_bits: Option<String>,
    /// Also print every register of every rank: hex, bits and value.
    #[arg(long, requires = "n")]
    ranks: bool,
    /// How questions and answers are written.
    #[arg(long, value_enum)]
    format: Option<Format>,
}

/// How questions and answers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Four lines for people.
    Text,
    /// Comma-separated values with a header.
    Csv,
    /// Words in hex, as in stimulus.mem and expected.mem.
    Hex,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let design = args.configuration.design()?;
    match (&args.questions, args.n) {
        (Some(path), _) => answer_lines(args, &design, path, out),
        (None, Some(n)) => answer_one(args, &design, n, out),
        // clap demands one of the two.
        (None, None) => Err(anyhow!("give --n and --x, or a file of questions")),
    }
}

fn answer_lines(args: &Args, design: &Design, path: &Path, out: &mut Out) -> anyhow::Result<Outcome> {
    let datapath = design.datapath();
    match args.format {
        None | Some(Format::Csv) => answer_all(datapath, &mut Csv::new(datapath), path, out),
        Some(Format::Hex) => answer_all(datapath, &mut Hex::new(datapath), path, out),
        Some(Format::Text) => Err(anyhow!("--format text is for one question; say --format csv or hex")),
    }
}

fn answer_all(datapath: &Datapath, dialect: &mut impl Dialect, path: &Path, out: &mut Out) -> anyhow::Result<Outcome> {
    let out = &mut UntilClosed(out);
    let answered = if path == Path::new("-") {
        // Who types questions at a terminal is not shown for how long the command has waited.
        bar::end();
        let name = Path::new("standard input");
        stream(datapath, dialect, (name, TextReader::new(io::stdin(), QUESTIONS)), out)
    } else {
        stream(datapath, dialect, (path, text_file::open(path, QUESTIONS)?), out)
    };
    match answered {
        Ok(_) => Ok(Outcome::Good),
        // The reader of the answers is gone, so no question is left.
        Err(StreamError::Write(error)) if error.kind() == ErrorKind::BrokenPipe => Ok(Outcome::Good),
        Err(StreamError::Write(error)) => Err(error.into()),
        Err(error) => Err(error.into()),
    }
}

/// Standard output that says when it is closed: of a command without a verdict nothing is left to do then, and the
/// questions may have no end.
struct UntilClosed<'a>(&'a mut Out);

impl UntilClosed<'_> {
    fn unless_closed<T>(&self, done: T) -> io::Result<T> {
        if self.0.get_ref().is_closed() { Err(ErrorKind::BrokenPipe.into()) } else { Ok(done) }
    }
}

impl Write for UntilClosed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.0.write(bytes)?;
        self.unless_closed(count)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()?;
        self.unless_closed(())
    }
}

fn answer_one(args: &Args, design: &Design, n: f64, out: &mut Out) -> anyhow::Result<Outcome> {
    let input = design.config().input;
    let n = vectors::stimulus_file::exponent(&n.to_string()).map_err(|problem| anyhow!("--n: {problem}"))?;
    let x = match (&args.x, &args.x_bits) {
        (Some(text), _) => real_field(text, input).map_err(|problem| anyhow!("--x: {problem}")),
        (_, Some(text)) => bits(text, input).map_err(|problem| anyhow!("--x-bits: {problem}")),
        (None, None) => Err(anyhow!("give x too: --x 0.99, or --x-bits")),
    }?;
    let datapath = design.datapath();
    let answer = Answer::of(datapath, Question::of(datapath.rom(), n, x));
    let mut lines = Vec::new();
    let (mut csv, mut hex) = (Csv::new(datapath), Hex::new(datapath));
    match args.format {
        None | Some(Format::Text) => lines = text(datapath, &answer).into_bytes(),
        Some(Format::Csv) => {
            lines.extend_from_slice(csv.header().as_bytes());
            csv.write(&[answer], &mut lines);
        }
        Some(Format::Hex) => hex.write(&[answer], &mut lines),
    }
    out.write_all(&lines)?;
    if args.ranks {
        writeln!(out)?;
        ranks(datapath, &answer).print(out, TableFormat::Table, 9)?;
    }
    Ok(Outcome::Good)
}

/// Intensity, x^n, error and region, a line each.
fn text(datapath: &Datapath, answer: &Answer) -> String {
    let (input, output) = (datapath.formats().input, datapath.formats().output);
    let bits = answer.intensity;
    let word = output.to_word(bits);
    let reference = answer.reference(datapath).unwrap_or(0.0);
    let ulp = answer.error_ulp(datapath, reference);
    let per_cent = (answer.value(datapath) - reference) * 100.0;
    format!(
        "intensity  {}  ({output}: {bits}, 0x{word:x})\n\
         x^n        {}  (n = {}, x = {} in {input})\n\
         error      {} ulp of {output}, {} % of full intensity\n\
         region     {}  (status {})\n",
        decimal(bits, output),
        digits(reference, 17),
        answer.question.exponent.unwrap_or(0.0),
        digits(answer.x(datapath), 17),
        digits(ulp, 6),
        digits(per_cent, 4),
        answer.region.name(),
        answer.status
    )
}

/// Every register of every rank as the question passes through on its own.
fn ranks(datapath: &Datapath, answer: &Answer) -> Rows {
    let mut rows = Rows::new(&["rank", "register", "format", "hex", "bits", "value"]);
    for (rank, registers) in Held::of_question(datapath, &answer.question).iter().enumerate() {
        let name = datapath.rank_name(rank);
        for held in registers {
            rows.push(vec![
                Cell::from(name.as_str()),
                held.name().into(),
                held.format().to_string().into(),
                held.hex().into(),
                Cell::Integer(held.bits),
                held.value().into(),
            ]);
        }
    }
    rows
}
