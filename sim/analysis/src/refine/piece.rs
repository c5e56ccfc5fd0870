//! One segment of one row: its x, what x^n is there, and the judgement of integers.

use hw_model::config::{Cut, Form};
use hw_model::datapath::clamp::clamp;
use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Block, Datapath};
use hw_model::design::{Design, Revision};
use hw_model::highlight::phong;
use hw_model::registers::{MAX_DEGREE, Register};
use hw_model::rom::{Place, Row};
use hw_model::steps::{CoefficientSteps, Steps};

use crate::budget::NO_BUDGET;

/// Samples that go through the data path together.
const BLOCK: usize = 4096;
/// The most x that are asked first, because other integers failed there.
const POOL: usize = 256;

/// Over which x an error is to be least.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// What the method was fitted to: the epicentre, or all segments.
    Fitted,
    /// All that the polynomial answers.
    Polynomial,
}

/// Which segment, and its x.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Span {
    /// The address of the ROM row.
    pub address: u32,
    /// The segment.
    pub segment: usize,
    /// The least x.
    pub first: i64,
    /// The greatest x of the span, bits in the input format.
    pub last: i64,
}

impl Span {
    /// How many x it has.
    pub(super) const fn samples(&self) -> u64 {
        (self.last - self.first + 1) as u64
    }
}

/// The segments of a row that answer anything in the range.
pub(super) fn spans(design: &Design, address: u32, range: Range) -> Vec<Span> {
    let row = &design.rows()[address as usize];
    let config = design.config();
    let greatest = design.datapath().front_end().greatest;
    let cut = match (range, config.cut) {
        // A stated cut may be below where the epicentre ends.
        (Range::Fitted, Cut::Minimum | Cut::Epicentre) => row.cut.max(row.first_of_epicentre(config)),
        _ => row.cut,
    };
    let cut = cut.max(0);
    let spans = row.segments.iter().enumerate().map(|(segment, real)| {
        let next = row.segments.get(segment + 1).map_or(cut, |next| next.start.max(cut));
        let last = if segment == 0 { greatest } else { (real.start - 1).min(greatest) };
        Span { address, segment, first: next, last }
    });
    spans.filter(|span| span.first <= span.last).collect()
}

/// The greatest error and the x where it is first seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Worst {
    pub error: f64,
    pub x: i64,
}

/// One segment with all that does not change while its integers do.
pub(super) struct Piece<'a> {
    pub design: &'a Design,
    pub span: Span,
    pub exponent: f64,
    /// The row as it is.
    pub row: Row,
    /// The degree.
    pub degree: usize,
    /// Which of c0, c1, … may be moved.
    pub free: [bool; MAX_DEGREE + 1],
    /// x^n at every x.
    reference: Vec<f64>,
    /// The greatest error with real coefficients.
    pub method: f64,
}

impl<'a> Piece<'a> {
    pub(super) fn new(design: &'a Design, span: Span) -> Self {
        let row = &design.rows()[span.address as usize];
        let input = design.config().input;
        let mut method = 0.0_f64;
        let reference = (span.first..=span.last)
            .map(|x| {
                let power = phong(row.exponent, x as f64 * input.ulp());
                let s = (input.one() - x) as f64 * input.ulp();
                method = method.max((row.value_at_s(s, true) - power).abs());
                power
            })
            .collect();
        Self {
            design,
            span,
            exponent: row.exponent,
            row: design.datapath().row(span.address),
            degree: design.datapath().degree(),
            free: free(design, span.segment),
            reference,
            method,
        }
    }

    /// x^n at an x of the span.
    pub(super) fn reference(&self, x: i64) -> f64 {
        self.reference[(x - self.span.first) as usize]
    }

    /// The polynomial's variable at an x of the span, as the hardware has it.
    pub(super) fn variable(&self, x: i64) -> i64 {
        let front_end = self.design.datapath().front_end();
        let segment = self.span.segment;
        let (start, shift) = (front_end.start(&self.row, segment), self.row.shift(segment));
        front_end.variable(x, Region::Polynomial, start, shift)
    }

    /// The fields of c0, c1, …
    pub(super) fn fields(&self) -> impl Iterator<Item = Register> + use<> {
        let segment = self.span.segment;
        (0..=self.degree).map(move |power| Register::C(segment, power))
    }

    /// The row with its integers moved.
    pub(super) fn moved(&self, steps: Steps) -> Row {
        let mut row = self.row;
        for (field, steps) in self.fields().zip(steps) {
            row.set(field, row.get(field) + i64::from(steps));
        }
        row
    }

    /// The steps from the rounded coefficients, where these are from the row as it is.
    pub(super) fn steps_in_all(&self, steps: Steps) -> Steps {
        let config = self.design.config();
        let before = config.coefficient_steps.iter().find(|row| row.n == self.exponent);
        let before = before.map_or(Steps::default(), |row| row.of(self.span.segment));
        std::array::from_fn(|i| before[i].saturating_add(steps[i]))
    }

    /// True where every coefficient stays within its format.
    pub(super) fn within_formats(&self, steps: Steps) -> bool {
        let Some(formats) = &self.design.datapath().formats().polynomial else { return false };
        let row = self.moved(steps);
        let mut both = self.fields().zip(formats.coefficients());
        both.all(|(field, format)| format.holds(row.get(field).into()))
    }

    /// True where the design's own analysis cannot say that every register holds its values.
    pub(super) fn overflows(&self, steps: Steps) -> bool {
        let row = CoefficientSteps::none(self.exponent).with(self.span.segment, self.steps_in_all(steps));
        let revision = Revision {
            widths: self.design.widths(),
            error_budget_ulp: NO_BUDGET,
            coefficient_steps: vec![row],
            ..self.design.revision()
        };
        let Ok(alone) = self.design.row_alone(self.span.address, revision) else { return true };
        let last = |datapath: &Datapath| datapath.formats().polynomial.map(|p| p.last());
        let both = last(alone.datapath()).zip(last(self.design.datapath()));
        let Some((here, whole)) = both else { return true };
        // The last stage's result cannot be stated, so it must not have become wider.
        !whole.holds(here.min_bits().into()) || !whole.holds(here.max_bits().into())
    }
}

/// A field that is the same in every row is no part of the ROM and must stay so; and f(1) = 1 is what the
/// centred form is made for.
fn free(design: &Design, segment: usize) -> [bool; MAX_DEGREE + 1] {
    let layout = design.rom().layout();
    let stored = |name| layout.field(name).is_some_and(|field| matches!(field.place, Place::Stored { .. }));
    let mut free = std::array::from_fn(|power| stored(Register::C(segment, power)));
    free[0] &= segment > 0 || design.config().form == Form::Power;
    free
}

/// Judges integers of one piece, and remembers where others were bad.
pub(super) struct Judge<'a, 'b> {
    piece: &'a Piece<'b>,
    pool: Vec<i64>,
    next: usize,
    block: Block,
    xs: Vec<i64>,
}

impl<'a, 'b> Judge<'a, 'b> {
    pub(super) fn new(piece: &'a Piece<'b>) -> Self {
        Self { piece, pool: Vec::new(), next: 0, block: Block::default(), xs: Vec::new() }
    }

    /// The greatest error over every x; none where it is not less than `limit`.
    pub(super) fn below(&mut self, steps: Steps, limit: f64) -> Option<Worst> {
        let row = self.piece.moved(steps);
        if !self.pool.is_empty() {
            self.xs.clear();
            self.xs.extend_from_slice(&self.pool);
            if self.worst(&row).error >= limit {
                return None;
            }
        }
        let (first, last) = (self.piece.span.first, self.piece.span.last);
        let mut greatest = Worst { error: 0.0, x: first };
        let mut start = first;
        while start <= last {
            let end = last.min(start + BLOCK as i64 - 1);
            self.xs.clear();
            self.xs.extend(start..=end);
            let worst = self.worst(&row);
            if worst.error >= limit {
                self.remember(worst.x);
                return None;
            }
            if worst.error > greatest.error {
                greatest = worst;
            }
            start = end + 1;
        }
        self.remember(greatest.x);
        Some(greatest)
    }

    /// The oldest is forgotten.
    fn remember(&mut self, x: i64) {
        if self.pool.contains(&x) {
            return;
        }
        if self.pool.len() < POOL {
            self.pool.push(x);
        } else {
            self.pool[self.next] = x;
            self.next = (self.next + 1) % POOL;
        }
    }

    /// Over the x that stand in `xs`.
    fn worst(&mut self, row: &Row) -> Worst {
        let datapath = self.piece.design.datapath();
        datapath.evaluate_row(row, None, &self.xs, &mut self.block);
        let ulp = self.piece.design.config().output.ulp();
        let one = datapath.output_one();
        let mut worst = Worst { error: -1.0, x: 0 };
        for (&x, &t) in self.xs.iter().zip(&self.block.intensities) {
            let error = (clamp(t, one) as f64 * ulp - self.piece.reference(x)).abs();
            if error > worst.error {
                worst = Worst { error, x };
            }
        }
        worst
    }
}
