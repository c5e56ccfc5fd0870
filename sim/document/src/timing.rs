//! A recorded run as a timing diagram.

use hw_model::datapath::Datapath;
use hw_model::format::QFormat;
use vectors::rtl::reset_port;

use super::scenario::{Sample, Scenario, name};
use plot::canvas::{Anchor, Canvas, Point, colour};

/// Height of a line of the diagram.
const LINE: f64 = 26.0;
/// Height of a wave in it.
const WAVE: f64 = 16.0;
/// Where the waves begin, unless a label wants more room.
const LEFT: f64 = 128.0;
/// Between a label and the waves.
const SPACE: f64 = 10.0;
/// Title, words above shaded cycles, cycle numbers.
const HEAD: f64 = 66.0;
/// How far a bus leans where its value changes.
const SLANT: f64 = 3.0;
/// Heights of letters, in SVG units.
const SMALL: f64 = 10.5;
const NORMAL: f64 = 12.0;
const TITLE: f64 = 14.0;
/// Widest letter of a hexadecimal number or a name at [`SMALL`].
const LETTER: f64 = 6.8;
/// The same of a label, at [`NORMAL`].
const LABEL_LETTER: f64 = 7.0;
/// A label of so many letters has room in the usual place.
const LONGEST_LABEL: usize = 17;

/// Where cycles stand.
#[derive(Clone, Copy)]
struct Grid {
    /// Where the first begins.
    left: f64,
    /// How wide each is.
    column: f64,
}

impl Grid {
    fn of(lines: &[(String, Line)]) -> Self {
        let longest = lines.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0);
        let labels = (longest as f64 * LABEL_LETTER + SPACE).ceil();
        Self { left: if longest > LONGEST_LABEL { LEFT.max(labels) } else { LEFT }, column: column(lines) }
    }

    fn at(self, cycle: usize) -> f64 {
        self.left + self.column * cycle as f64
    }
}

/// What a line shows in each cycle.
enum Line {
    /// The clock, which rises at the end of every cycle.
    Clock,
    /// One bit, with its level in each cycle.
    Bit(Vec<bool>),
    /// Words; none where there is nothing to say.
    Bus(Vec<Option<Word>>),
}

/// A word on a bus. Neighbours that are equal are drawn as one.
#[derive(Clone, PartialEq)]
struct Word {
    text: String,
    fill: &'static str,
}

/// Draws the timing diagram of a recorded run as SVG.
pub(super) fn timing(datapath: &Datapath, scenario: &Scenario) -> String {
    let lines = lines(datapath, scenario);
    let grid = Grid::of(&lines);
    let cycles = scenario.samples.len();
    let size = (grid.at(cycles), HEAD + LINE * lines.len() as f64 + 4.0);
    let mut canvas = Canvas::new();
    canvas.text((0.0, 14.0), scenario.title, Anchor::Start, TITLE);
    shade(&mut canvas, scenario, grid, size.1);
    edges(&mut canvas, cycles, grid, size.1);
    for (index, (label, line)) in lines.iter().enumerate() {
        let top = HEAD + LINE * index as f64 + (LINE - WAVE) / 2.0;
        canvas.text((grid.left - SPACE, top + WAVE - 4.0), label, Anchor::End, NORMAL);
        match line {
            Line::Clock => clock(&mut canvas, cycles, grid, top),
            Line::Bit(values) => bit(&mut canvas, values, grid, top),
            Line::Bus(words) => bus(&mut canvas, words, grid, top),
        }
    }
    // A long title may be wider than a short run.
    let width = size.0.max(TITLE * 0.62 * scenario.title.chars().count() as f64);
    canvas.finish((width, size.1), scenario.title, &scenario.words)
}

fn lines(datapath: &Datapath, scenario: &Scenario) -> Vec<(String, Line)> {
    let samples = &scenario.samples;
    let bits = |of: fn(&Sample) -> bool| Line::Bit(samples.iter().map(of).collect());
    let level = |of: &dyn Fn(&Sample) -> bool| Line::Bit(samples.iter().map(of).collect());
    let reset = &datapath.control().reset;
    let words = |of: &dyn Fn(&Sample) -> Option<Word>| Line::Bus(samples.iter().map(of).collect());
    let plain = |text: String| Word { text, fill: colour::PAPER };
    let formats = datapath.formats();
    let request = |sample: &Sample| sample.presented.map(|index| &scenario.requests[index]);
    let mut lines = vec![
        ("clk_i".to_owned(), Line::Clock),
        (reset_port::name(reset).to_owned(), level(&|sample| sample.reset != reset.is_active_low())),
        ("in_valid_i".to_owned(), bits(|sample| sample.presented.is_some())),
        ("in_ready_o".to_owned(), bits(|sample| sample.in_ready)),
        ("request".to_owned(), words(&|sample| sample.presented.map(tagged))),
        ("address_i".to_owned(), words(&|sample| request(sample).map(|request| plain(request.address.to_string())))),
        (
            "x_i, hex".to_owned(),
            words(&|sample| request(sample).map(|request| plain(digits(request.x, formats.input)))),
        ),
    ];
    for rank in 0..datapath.rank_count() {
        let label = format!("rank {rank}, {}", datapath.rank_name(rank));
        lines.push((label, words(&|sample| sample.ranks[rank].map(tagged))));
    }
    lines.push(("out_valid_o".to_owned(), bits(|sample| sample.out_valid)));
    lines.push(("out_ready_i".to_owned(), bits(|sample| sample.out_ready)));
    lines.push((
        "intensity_o, hex".to_owned(),
        words(&|sample| sample.intensity.map(|bits| plain(digits(bits, formats.output)))),
    ));
    lines.push((
        "status_o, hex".to_owned(),
        words(&|sample| sample.status.map(|status| plain(format!("{:x}", status.bits())))),
    ));
    lines
}

/// A request by its name, in one of four tints in turn.
fn tagged(request: usize) -> Word {
    const TINTS: [&str; 4] = [colour::BLUE, colour::ORANGE, colour::GREEN, colour::GREY];
    Word { text: name(request), fill: TINTS[request % TINTS.len()] }
}

/// Bits of a port as a hexadecimal number without its prefix.
fn digits(bits: i64, format: QFormat) -> String {
    let width = format.width().div_ceil(4) as usize;
    format!("{:0width$x}", format.to_word(bits))
}

/// Wide enough for the longest word.
fn column(lines: &[(String, Line)]) -> f64 {
    let longest = lines.iter().filter_map(|(_, line)| match line {
        Line::Bus(words) => words.iter().flatten().map(|word| word.text.chars().count()).max(),
        Line::Clock | Line::Bit(_) => None,
    });
    let letters = longest.max().unwrap_or(0).max(5);
    (letters as f64 * LETTER + 4.0 * SLANT).ceil()
}

fn shade(canvas: &mut Canvas, scenario: &Scenario, grid: Grid, bottom: f64) {
    for &(first, end, words) in &scenario.spans {
        let (left, right) = (grid.at(first), grid.at(end));
        canvas.block((left, HEAD - 22.0), (right - left, bottom - HEAD + 22.0), colour::SHADE);
        canvas.text((left.midpoint(right), HEAD - 26.0), words, Anchor::Middle, NORMAL);
    }
}

/// A line at each rising edge, and the number of each cycle.
fn edges(canvas: &mut Canvas, cycles: usize, grid: Grid, bottom: f64) {
    canvas.quiet((grid.left - SPACE, HEAD - 8.0), "cycle", Anchor::End, SMALL);
    for cycle in 0..=cycles {
        let x = grid.at(cycle);
        canvas.dashes(&[(x, HEAD - 4.0), (x, bottom)], colour::FAINT);
        if cycle < cycles {
            canvas.quiet((x + grid.column / 2.0, HEAD - 8.0), &cycle.to_string(), Anchor::Middle, SMALL);
        }
    }
}

/// High in the first half of a cycle: it begins and ends with a rising edge.
fn clock(canvas: &mut Canvas, cycles: usize, grid: Grid, top: f64) {
    let mut points = vec![(grid.left, top + WAVE)];
    for cycle in 0..cycles {
        let (x, half) = (grid.at(cycle), grid.column / 2.0);
        points.extend([(x, top), (x + half, top), (x + half, top + WAVE), (x + grid.column, top + WAVE)]);
    }
    canvas.line(&points, colour::INK, 1.4);
}

fn bit(canvas: &mut Canvas, values: &[bool], grid: Grid, top: f64) {
    let level = |value: bool| if value { top } else { top + WAVE };
    let ends = |(cycle, &value): (usize, &bool)| -> [Point; 2] {
        [(grid.at(cycle), level(value)), (grid.at(cycle + 1), level(value))]
    };
    let points: Vec<Point> = values.iter().enumerate().flat_map(ends).collect();
    canvas.line(&points, colour::INK, 1.6);
}

fn bus(canvas: &mut Canvas, words: &[Option<Word>], grid: Grid, top: f64) {
    let mut first = 0;
    while first < words.len() {
        let same = words[first..].iter().take_while(|word| **word == words[first]).count();
        let (left, right) = (grid.at(first), grid.at(first + same));
        match &words[first] {
            None => {
                let middle = top + WAVE / 2.0;
                canvas.line(&[(left, middle), (right, middle)], colour::FAINT, 1.4);
            }
            Some(word) => value(canvas, word, (left, right), top),
        }
        first += same;
    }
}

fn value(canvas: &mut Canvas, word: &Word, (left, right): Point, top: f64) {
    let (middle, bottom) = (top + WAVE / 2.0, top + WAVE);
    let shape = [
        (left, middle),
        (left + SLANT, top),
        (right - SLANT, top),
        (right, middle),
        (right - SLANT, bottom),
        (left + SLANT, bottom),
    ];
    canvas.polygon(&shape, word.fill);
    canvas.text((left.midpoint(right), bottom - 4.0), &word.text, Anchor::Middle, SMALL);
}
