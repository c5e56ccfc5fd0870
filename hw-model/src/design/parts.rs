//! What the derivations of the polynomial and of the tail add to, until it is a design.

use crate::budget::Bound;
use crate::config::Config;
use crate::datapath::formats::Formats;
use crate::format::QFormat;
use crate::registers::Register;
use crate::rom::Row;

use super::doubt::Doubt;
use super::real_row::RealRow;

/// What the derivation of the polynomial and of the tail add to.
pub(super) struct Parts {
    pub(super) rom_rows: Vec<Row>,
    pub(super) fields: Vec<(Register, QFormat)>,
    pub(super) formats: Formats,
    pub(super) bounds: Vec<Bound>,
    /// Every line with the bits it needs.
    pub(super) lane_bits: Vec<(&'static str, u32)>,
    /// Stated formats that the ranges refuse.
    pub(super) doubts: Vec<Doubt>,
}

impl Parts {
    pub(super) fn new(config: &Config, rows: &[RealRow]) -> Self {
        Self {
            rom_rows: vec![Row::default(); rows.len()],
            fields: Vec::new(),
            formats: Formats {
                input: config.input,
                output: config.output,
                polynomial: None,
                tail: None,
                cut: None,
                hand_over: None,
            },
            bounds: vec![Bound::default(); rows.len()],
            lane_bits: Vec::new(),
            doubts: Vec::new(),
        }
    }

    /// Adds a field whose bits are given for each row.
    pub(super) fn add_field(&mut self, name: Register, format: QFormat, bits: impl Iterator<Item = i64>) {
        self.fields.push((name, format));
        let index = name.index();
        for (row, bits) in self.rom_rows.iter_mut().zip(bits) {
            row.set_at(index, bits);
        }
    }
}
