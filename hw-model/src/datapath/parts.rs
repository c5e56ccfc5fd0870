//! The data path of one configuration: its parts. [`schedule`](super::schedule) has the ranks that they make.

use crate::handshake::Control;
use crate::pipelining::Pipelining;
use crate::rom::{Rom, Row};

use super::formats::Formats;
use super::front_end::FrontEnd;
use super::signals::Status;
use super::stage::{MultiplyAdd, Stages};
use super::tail::Divider;

/// The data path of one configuration: every line with its alignment, and the ROM.
#[derive(Debug, Clone, PartialEq)]
pub struct Datapath {
    pub(crate) rom: Rom,
    pub(crate) formats: Formats,
    pub(crate) front_end: FrontEnd,
    pub(crate) stages: Stages,
    pub(crate) divider: Option<Divider>,
    /// 1 in the output's unit, or the greatest intensity of a format that does not reach 1.
    pub(crate) output_one: i64,
    /// Where ranks of registers stand beyond the least.
    pub(crate) pipelining: Pipelining,
    /// What stands around the ranks.
    pub(crate) control: Control,
    /// True when every line fits an `i64`.
    pub(crate) narrow: bool,
}

impl Datapath {
    /// The ROM from which rank 0 takes its rows.
    #[must_use]
    pub const fn rom(&self) -> &Rom {
        &self.rom
    }

    /// The formats of every register.
    #[must_use]
    pub const fn formats(&self) -> &Formats {
        &self.formats
    }

    /// The front end's constants.
    #[must_use]
    pub const fn front_end(&self) -> &FrontEnd {
        &self.front_end
    }

    /// The multiply-add lines of the polynomial, in the order of their stages; none where there is no polynomial.
    #[must_use]
    pub fn stages(&self) -> &[MultiplyAdd] {
        self.stages.lines()
    }

    /// The degree of the polynomial, and the number of its stages; 0 where there is no polynomial.
    #[must_use]
    pub const fn degree(&self) -> usize {
        self.stages.degree()
    }

    /// The divider, where there is one.
    #[must_use]
    pub const fn divider(&self) -> Option<&Divider> {
        self.divider.as_ref()
    }

    /// The greatest intensity: 1, or the output format's greatest value where it does not reach 1.
    #[must_use]
    pub const fn output_one(&self) -> i64 {
        self.output_one
    }

    /// The flags of the status port, from bit 0 up.
    #[must_use]
    pub fn status_flags(&self) -> &'static [(Status, &'static str)] {
        let flags = &Status::NAMES;
        if self.front_end.guarded { flags } else { &flags[..flags.len() - 1] }
    }

    /// Bits of the status port.
    #[must_use]
    pub fn status_width(&self) -> u32 {
        self.status_flags().len() as u32
    }

    /// Segments of the polynomial; 1 where there is no polynomial.
    #[must_use]
    pub const fn segment_count(&self) -> usize {
        self.front_end.segments
    }

    /// The row at an address. An address without a word reads the first row: its values are in every
    /// proved range, and a memory needs no gates behind its outputs. The region makes the intensity 0.
    #[must_use]
    pub fn row(&self, address: u32) -> Row {
        *self.row_at(if self.rom.row(address).is_some() { address } else { 0 })
    }

    /// The row at an address that has one.
    #[inline(always)]
    pub(super) fn row_at(&self, address: u32) -> &Row {
        const NONE: &Row = &Row::EMPTY;
        self.rom.row(address).unwrap_or(NONE)
    }
}
