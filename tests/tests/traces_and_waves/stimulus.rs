//! Stimulus files full of stalls, bubbles and resets.

use std::fmt::Write;

use hw_model::design::Design;

/// One line of the file.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// n, or 0 for one that the ROM does not have.
    pub n: f64,
    /// The bits of x, in the input format.
    pub x: i64,
    pub valid: bool,
    pub ready: bool,
    pub reset: bool,
}

#[derive(Debug, Clone)]
pub struct Stimulus {
    pub lines: Vec<Line>,
}

impl Stimulus {
    pub fn to_csv(&self) -> String {
        let mut text = String::from("reset,valid,n,x_bits,ready\n");
        for line in &self.lines {
            let (reset, valid, ready) = (line.reset as u8, line.valid as u8, line.ready as u8);
            writeln!(text, "{reset},{valid},{},{},{ready}", line.n, line.x).unwrap();
        }
        text
    }
}

/// A small generator (xorshift), so that the stimulus is the same on every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 >> 11
    }

    /// True once in `of` times.
    fn once_in(&mut self, of: u64) -> bool {
        self.next().is_multiple_of(of)
    }
}

/// Lines of each stimulus.
const LINES: usize = 160;

/// How often each pattern has (bubbles, stalls, resets): once in so many cycles, 0 for never.
const PATTERNS: [(&str, u64, u64, u64); 6] = [
    ("nothing in the way", 0, 0, 0),
    ("bubbles", 2, 0, 0),
    ("stalls", 0, 2, 0),
    ("bubbles and stalls", 3, 2, 0),
    ("resets", 0, 0, 9),
    ("everything", 3, 3, 20),
];

pub fn patterns(design: &Design) -> Vec<(&'static str, Stimulus)> {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut all: Vec<_> = PATTERNS
        .iter()
        .map(|&(name, bubbles, stalls, resets)| {
            let mut at = |of: u64| of > 0 && random.once_in(of);
            let flags: Vec<_> = (0..LINES).map(|_| (!at(bubbles), !at(stalls), at(resets))).collect();
            (name, with_inputs(design, &flags, &mut random))
        })
        .collect();
    // A stall long enough to fill every rank, a reset in the middle of it, and bubbles that collapse.
    let long: Vec<_> = (0..LINES).map(|i| (i % 3 != 1, !(40..100).contains(&i), i == 80)).collect();
    all.push(("a long stall", with_inputs(design, &long, &mut random)));
    all
}

/// x at and beside its ends, and anywhere; every exponent, and some that the ROM does not have.
fn with_inputs(design: &Design, flags: &[(bool, bool, bool)], random: &mut Random) -> Stimulus {
    let exponents = design.rom().exponents().as_slice();
    let input = design.config().input;
    let ends = [0, 1, input.one() - 1, input.one(), input.one() + 1, input.min_bits(), input.max_bits()];
    let lines = flags.iter().map(|&(valid, ready, reset)| {
        let n = match random.next() as usize % (exponents.len() + 1) {
            index if index < exponents.len() => exponents[index],
            _ => exponents[exponents.len() - 1] + 0.5,
        };
        let span = (input.max_bits() - input.min_bits()) as u64 + 1;
        let x = match random.next() as usize % 16 {
            end if end < ends.len() && input.holds(ends[end].into()) => ends[end],
            _ => input.min_bits() + (random.next() % span) as i64,
        };
        Line { n, x, valid, ready, reset }
    });
    Stimulus { lines: lines.collect() }
}
