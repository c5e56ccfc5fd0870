//! Formats of ports and registers as structures of C.

use hw_model::format::QFormat;
use model::Model;

/// A fixed-point format: a value is `bits / 2^fraction_bits`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Format {
    /// Bits in all, the sign included: 1 to 63.
    pub width: u32,
    /// Bits before the point, the sign included. It may be negative: then leading fraction bits are left out.
    pub integer_bits: i32,
    /// Bits behind the point.
    pub fraction_bits: u32,
    /// Whether the highest bit is a sign.
    pub is_signed: bool,
}

impl Format {
    pub(crate) fn of(format: QFormat) -> Self {
        Self {
            width: format.width(),
            integer_bits: format.integer_bits(),
            fraction_bits: format.fraction_bits(),
            is_signed: format.is_signed(),
        }
    }
}

/// The ports of a pipeline, its latency and its sizes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interface {
    /// Format of the port `address_i`.
    pub address: Format,
    /// Format of the port `x_i`.
    pub x: Format,
    /// Format of the port `intensity_o`.
    pub intensity: Format,
    /// Format of the port `status_o`.
    pub status: Format,
    /// Clock cycles from a request to its result, which is the number of ranks.
    pub latency: u32,
    /// Words of the ROM; addresses from there on have none.
    pub depth: u32,
    /// Registers of all ranks: what `blysk_registers` and `blysk_pipeline_ranks` write.
    pub register_count: usize,
}

impl Interface {
    pub(crate) fn of(model: &Model) -> Self {
        // The clock, reset, and the handshake of requests stand before these.
        let [_, _, _, _, address, x, _, _, intensity, status] = model.ports().map(|port| Format::of(port.format));
        let size = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        Self {
            address,
            x,
            intensity,
            status,
            latency: size(model.latency()),
            depth: size(model.datapath().rom().depth()),
            register_count: model.probes().len(),
        }
    }
}
