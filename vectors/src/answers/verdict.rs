//! What a comparison found.

use hw_model::format::QFormat;

use super::column::{Column, Got};
use super::log::Answer;
use crate::table::TableRow;

/// A port or register of a vector, expected and found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// Its name, as the log's column.
    pub name: String,
    /// The format in which got and expected bits are read.
    pub format: QFormat,
    /// The bits by the bundle.
    pub expected: i64,
    /// What the log says.
    pub got: Got,
}

impl Field {
    /// True when the log says something else than the bundle.
    #[must_use]
    pub fn differs(&self) -> bool {
        self.got != Got::Known(self.expected)
    }

    /// True for a register, false for a port.
    #[must_use]
    pub fn is_register(&self) -> bool {
        self.name.contains('.')
    }
}

/// A vector that is not answered as it should be.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    /// The vector that failed, with its expected outputs.
    pub vector: TableRow,
    /// The line of the log, counted from 1; none where no line answers the vector.
    pub line: Option<u64>,
    /// Everything the log says of the vector, in the order in which it passes through: registers, then
    /// intensity and status. Empty where nothing is said.
    pub fields: Vec<Field>,
}

/// What a comparison found.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Vectors of the bundle.
    pub vectors: u64,
    /// The format of x.
    pub input: QFormat,
    /// Registers that the log has columns for.
    pub registers: usize,
    /// The first vector, in the bundle's order, that is not answered as it should be.
    pub first: Option<Failure>,
    /// How many vectors depart first in each rank, of what the log shows; ranks without one are left
    /// out. The ports are the last rank's.
    pub departures: Vec<(String, u64)>,
    /// Vectors without an answer.
    pub unanswered: u64,
}

impl Verdict {
    /// True when every vector is answered as it should be.
    #[must_use]
    pub const fn holds(&self) -> bool {
        self.first.is_none()
    }

    /// Vectors that are answered otherwise, or not at all.
    #[must_use]
    pub fn failing(&self) -> u64 {
        self.unanswered + self.departures.iter().map(|(_, count)| count).sum::<u64>()
    }
}

/// A verdict under way.
pub(super) struct Tally {
    registers: usize,
    first: Option<Failure>,
    /// Vectors that depart first in each rank.
    departures: Vec<u64>,
    unanswered: u64,
}

impl Tally {
    pub(super) const fn new(registers: usize) -> Self {
        Self { registers, first: None, departures: Vec::new(), unanswered: 0 }
    }

    /// Takes in what a line says of a vector: what each column should hold, and what it does.
    pub(super) fn answer<'a>(
        &mut self,
        vector: &TableRow,
        columns: impl Iterator<Item = &'a Column>,
        expected: &[i64],
        answer: Answer,
    ) {
        let fields: Vec<_> = columns.zip(expected.iter().copied()).zip(answer.values).collect();
        let departs = fields.iter().find(|((_, expected), got)| *got != Got::Known(*expected));
        let Some(((column, _), _)) = departs else { return };
        if self.departures.len() <= column.rank {
            self.departures.resize(column.rank + 1, 0);
        }
        self.departures[column.rank] += 1;
        self.offer(vector, Some(answer.line), || {
            let field = |((column, expected), got): ((&Column, i64), Got)| Field {
                name: column.name.clone(),
                format: column.format,
                expected,
                got,
            };
            fields.into_iter().map(field).collect()
        });
    }

    /// Takes in that nothing is said of a vector.
    pub(super) fn no_answer(&mut self, vector: &TableRow) {
        self.unanswered += 1;
        self.offer(vector, None, Vec::new);
    }

    /// Lines may come in any order: the first failure is that of the first vector.
    fn offer(&mut self, vector: &TableRow, line: Option<u64>, fields: impl FnOnce() -> Vec<Field>) {
        let first = self.first.as_ref().map(|first| first.vector.index);
        if first.is_none_or(|first| vector.index < first) {
            self.first = Some(Failure { vector: vector.clone(), line, fields: fields() });
        }
    }

    pub(super) fn verdict<'a>(self, vectors: u64, ranks: impl Iterator<Item = &'a str>, input: QFormat) -> Verdict {
        let departures = ranks.zip(self.departures).filter(|(_, count)| *count > 0);
        Verdict {
            vectors,
            input,
            registers: self.registers,
            first: self.first,
            departures: departures.map(|(rank, count)| (rank.to_owned(), count)).collect(),
            unanswered: self.unanswered,
        }
    }
}
