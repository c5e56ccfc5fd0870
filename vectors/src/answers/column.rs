//! What a log of answers may have in its columns.

use hw_model::datapath::{FRONT_END, register_name};
use hw_model::format::QFormat;

use crate::manifest::Manifest;

/// The log's name for the port, as the manifest's.
pub(super) const INTENSITY: &str = "intensity";
pub(super) const STATUS: &str = "status";

/// What a log may have in a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Column {
    pub(super) name: String,
    pub(super) format: QFormat,
    /// The rank that computes it.
    pub(super) rank: usize,
    /// The column of the bundle's table with what it should hold, as an integer.
    pub(super) table: String,
}

impl Column {
    pub(super) fn is_port(&self) -> bool {
        self.name == INTENSITY || self.name == STATUS
    }
}

/// The columns that a log may have, in the order in which a case passes through them: every register
/// where it is computed, then the ports.
pub(super) fn columns(manifest: &Manifest) -> Vec<Column> {
    let ranks = &manifest.hardware.ranks;
    let last = ranks.len().saturating_sub(1);
    let head = ranks.iter().position(|rank| rank.name == FRONT_END).map_or(0, |rank| rank + 1);
    let registers = (0..).zip(ranks).flat_map(|(rank, list)| {
        let computed = list.registers.iter().filter(|register| register.computed);
        computed.map(move |register| {
            let name = register_name(head, rank, &list.name, &register.name);
            // The table does not say twice what a port shows.
            let table = match register.name.as_str() {
                "x" if rank == 0 => "x_bits",
                port if rank == last => port_column(port).unwrap_or(&name),
                _ => &name,
            };
            Column { table: table.to_owned(), name, format: register.format, rank }
        })
    });
    let ports = manifest.words.expected.fields.iter().rev().filter_map(|field| {
        let table = port_column(&field.name)?.to_owned();
        Some(Column { name: field.name.clone(), format: field.format, rank: last, table })
    });
    registers.chain(ports).collect()
}

/// The table's column for an output port.
fn port_column(name: &str) -> Option<&'static str> {
    match name {
        INTENSITY => Some("intensity_bits"),
        STATUS => Some("status"),
        _ => None,
    }
}

/// What a log says of a port or register.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Got {
    /// The bits that the log has, in the register's width.
    Known(i64),
    /// Some bits are `x` or `z`; the number as written.
    Unknown(String),
}
