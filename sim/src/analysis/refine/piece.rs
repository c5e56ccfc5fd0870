//! One segment of one row: its x, what x^n is there, and the judgement of integers.

use hw_model::config::{Cut, Form};
use hw_model::datapath::clamp::clamp;
use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Block, Datapath};
use hw_model::design::{Design, Revision};
use hw_model::highlight::phong;
use hw_model::rom::{FieldName, Place, Row};
use hw_model::steps::CoefficientSteps;

use super::NO_BUDGET;

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
pub struct Span {
    /// The address of the ROM row.
    pub address: u32,
    /// True for the second segment.
    pub outer: bool,
    /// The least x of the span, bits in the input format.
    pub first: i64,
    /// The greatest x of the span, bits in the input format.
    pub last: i64,
}

impl Span {
    /// How many x it has.
    pub const fn samples(&self) -> u64 {
        (self.last - self.first + 1) as u64
    }
}

/// The segments of a row that answer anything in the range.
pub fn spans(design: &Design, address: u32, range: Range) -> Vec<Span> {
    let row = &design.rows()[address as usize];
    if row.polynomial.is_none() {
        return Vec::new();
    }
    let config = design.config();
    let greatest = design.datapath().front_end().greatest;
    let cut = match (range, config.cut) {
        // A stated cut may be below where the epicentre ends.
        (Range::Fitted, Cut::Minimum | Cut::Epicentre) => {
            row.cut.max(row.first_of_epicentre(config))
        }
        _ => row.cut,
    };
    let cut = cut.max(0);
    let spans = [
        Span { address, outer: false, first: cut.max(row.hand_over), last: greatest },
        Span { address, outer: true, first: cut, last: (row.hand_over - 1).min(greatest) },
    ];
    spans.into_iter().filter(|span| span.first <= span.last).collect()
}

/// The greatest error and the x where it is first seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    pub error: f64,
    pub x: i64,
}

/// One segment with all that does not change while its integers do.
pub struct Piece<'a> {
    pub design: &'a Design,
    pub span: Span,
    pub exponent: f64,
    /// The row as it is.
    pub row: Row,
    /// The fields of c0, c1, c2, c3.
    pub fields: [FieldName; 4],
    /// Which of them may be moved.
    pub free: [bool; 4],
    /// x^n at every x.
    reference: Vec<f64>,
    /// The greatest error with real coefficients.
    pub method: f64,
}

impl<'a> Piece<'a> {
    pub fn new(design: &'a Design, span: Span) -> Self {
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
        let fields =
            if span.outer { FieldName::OUTER_COEFFICIENTS } else { FieldName::COEFFICIENTS };
        Self {
            design,
            span,
            exponent: row.exponent,
            row: design.datapath().row(span.address),
            fields,
            free: free(design, span.outer, fields),
            reference,
            method,
        }
    }

    /// x^n at an x of the span.
    pub fn reference(&self, x: i64) -> f64 {
        self.reference[(x - self.span.first) as usize]
    }

    /// The polynomial's variable at an x of the span, as the hardware has it.
    pub fn variable(&self, x: i64) -> i64 {
        let front_end = self.design.datapath().front_end();
        let (start, shift) = if self.span.outer {
            (front_end.hand_over(&self.row), self.row.shift_outer())
        } else {
            (front_end.one, self.row.shift())
        };
        front_end.variable(x, Region::Polynomial, start, shift)
    }

    /// The row with its integers moved.
    pub fn moved(&self, steps: [i32; 4]) -> Row {
        let mut row = self.row;
        for (field, steps) in self.fields.into_iter().zip(steps) {
            row.set(field, row.get(field) + i64::from(steps));
        }
        row
    }

    /// The steps from the rounded coefficients, where these are from the row as it is.
    pub fn steps_in_all(&self, steps: [i32; 4]) -> [i32; 4] {
        let config = self.design.config();
        let before = config.coefficient_steps.iter().find(|row| row.n == self.exponent);
        let before = before.map_or([0; 4], |row| match self.span.outer {
            true => row.outer(),
            false => row.first(),
        });
        std::array::from_fn(|i| before[i].saturating_add(steps[i]))
    }

    /// True where every coefficient stays within its format.
    pub fn within_formats(&self, steps: [i32; 4]) -> bool {
        let Some(formats) = &self.design.datapath().formats().polynomial else { return false };
        let row = self.moved(steps);
        let mut both = self.fields.into_iter().zip(formats.coefficients);
        both.all(|(field, format)| format.holds(row.get(field).into()))
    }

    /// True where the design's own analysis cannot say that every register holds its values.
    pub fn overflows(&self, steps: [i32; 4]) -> bool {
        let row =
            CoefficientSteps::none(self.exponent).with(self.span.outer, self.steps_in_all(steps));
        let revision = Revision {
            widths: self.design.widths(),
            error_budget_ulp: NO_BUDGET,
            coefficient_steps: vec![row],
            ..self.design.revision()
        };
        let Ok(alone) = self.design.row_alone(self.span.address, revision) else { return true };
        let t3 = |datapath: &Datapath| datapath.formats().polynomial.map(|formats| formats.t3);
        let (Some(here), Some(whole)) = (t3(alone.datapath()), t3(self.design.datapath())) else {
            return true;
        };
        // t3 cannot be stated, so it must not have become wider.
        !whole.holds(here.min_bits().into()) || !whole.holds(here.max_bits().into())
    }
}

/// A field that is the same in every row is no part of the ROM and must stay so; and f(1) = 1 is what the
/// centred form is made for.
fn free(design: &Design, outer: bool, fields: [FieldName; 4]) -> [bool; 4] {
    let layout = design.rom().layout();
    let stored =
        |name| layout.field(name).is_some_and(|field| matches!(field.place, Place::Stored { .. }));
    let mut free = fields.map(stored);
    free[0] &= outer || design.config().form == Form::Power;
    free
}

/// Judges integers of one piece, and remembers where others were bad.
pub struct Judge<'a, 'b> {
    piece: &'a Piece<'b>,
    pool: Vec<i64>,
    next: usize,
    block: Block,
    xs: Vec<i64>,
}

impl<'a, 'b> Judge<'a, 'b> {
    pub fn new(piece: &'a Piece<'b>) -> Self {
        Self { piece, pool: Vec::new(), next: 0, block: Block::default(), xs: Vec::new() }
    }

    /// The greatest error over every x; none where it is not less than `limit`.
    pub fn below(&mut self, steps: [i32; 4], limit: f64) -> Option<Worst> {
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
        for (&x, &t3) in self.xs.iter().zip(&self.block.intensities) {
            let error = (clamp(t3, one) as f64 * ulp - self.piece.reference(x)).abs();
            if error > worst.error {
                worst = Worst { error, x };
            }
        }
        worst
    }
}
