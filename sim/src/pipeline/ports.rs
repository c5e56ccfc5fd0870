//! What drives the pipeline in a cycle, and what it shows.

use hw_model::datapath::Status;

/// What drives the pipeline during one cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inputs {
    /// Clears every valid flag, at the edge or at once; whatever the level of the port is that says so.
    pub reset: bool,
    /// Address and x are a request.
    pub in_valid: bool,
    /// The request's ROM address.
    pub address: u32,
    /// x, bits in the input format.
    pub x: i64,
    /// The receiver of the results can take one.
    pub out_ready: bool,
}

/// What the pipeline shows at the edge that ends the cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Outputs {
    /// The request is taken if it is valid.
    pub in_ready: bool,
    /// Intensity and status are a result.
    pub out_valid: bool,
    /// Bits in the output format.
    pub intensity: i64,
    /// Flags of the result.
    pub status: Status,
}
