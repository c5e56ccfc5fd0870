//! Formulas and numbers in words, the same in pictures and tables.

use hw_model::format::QFormat;
use hw_model::quantise::real;
use hw_model::registers::{MAX_SEGMENTS, Register};

/// The formula of stage `stage` (1 is the first) of a polynomial.
pub(super) fn line_formula(stage: usize, degree: usize, subtracts: bool) -> String {
    let sign = if subtracts { '−' } else { '+' };
    let addend = Register::C(0, degree - stage);
    format!("{} = {addend} {sign} {}·v", Register::T(stage), multiplicand(stage, degree))
}

/// What a stage multiplies by v.
pub(super) fn multiplicand(stage: usize, degree: usize) -> Register {
    if stage == 1 { Register::C(0, degree) } else { Register::T(stage - 1) }
}

/// `first`, `second`, …: segments in words.
pub(super) const ORDINALS: [&str; MAX_SEGMENTS] =
    ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth"];

/// A real number with at most this many places, without trailing zeros.
pub(super) fn places(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text };
    match text.strip_prefix('-') {
        Some("0") => "0".to_owned(),
        Some(magnitude) => format!("−{magnitude}"),
        None => text,
    }
}

/// The value of bits, to seven places.
pub(super) fn value(bits: i64, format: QFormat) -> String {
    places(real(bits, format), 7)
}

/// The bits as a hexadecimal literal of Verilog.
pub(super) fn literal(bits: i64, format: QFormat) -> String {
    format!("{}'h{:x}", format.width(), format.to_word(bits))
}

/// `1 bit`, `2 bits`.
pub(super) fn bits(count: i64) -> String {
    if count == 1 { "1 bit".to_owned() } else { format!("{count} bits") }
}

/// A quantity moved up by some places: `c2·2^5`, or the quantity itself.
pub(super) fn moved_up(quantity: &str, up: u32) -> String {
    if up == 0 { quantity.to_owned() } else { format!("{quantity}·2^{up}") }
}
