//! From linear light to display codes.
//!
//! A display code is an integer from 0 to 2^bits − 1. Light is clamped to [0, 1], goes through the transfer curve,
//! times the greatest code, and is rounded to the nearest integer (half up). It is done by the light at which each code
//! begins: those are computed once, correctly rounded, and a code is found by search, so that every machine finds the
//! same one.

use crate::scene::{Image, Transfer};

/// The light at which each display code begins.
#[derive(Debug, Clone, PartialEq)]
pub struct Codes {
    /// That of code k + 1 at k.
    begins: Vec<f64>,
    bits: u32,
}

impl Codes {
    /// The codes of a picture.
    #[must_use]
    pub fn new(image: &Image) -> Self {
        let greatest = (1_u32 << image.display_bits) - 1;
        let begins = |code: u32| {
            let shown = (f64::from(code) - 0.5) / f64::from(greatest);
            light(image.transfer, shown)
        };
        Self { begins: (1..=greatest).map(begins).collect(), bits: image.display_bits }
    }

    /// The greatest display code, 2^bits − 1.
    #[must_use]
    pub fn greatest(&self) -> u16 {
        self.begins.len() as u16
    }

    /// Bits of a code.
    #[must_use]
    pub const fn bits(&self) -> u32 {
        self.bits
    }

    /// The code of linear light.
    #[must_use]
    pub fn of(&self, light: f64) -> u16 {
        self.begins.partition_point(|&begin| begin <= light) as u16
    }
}

/// The light of a display value from 0 to 1.
fn light(transfer: Transfer, shown: f64) -> f64 {
    match transfer {
        Transfer::Linear => shown,
        Transfer::Srgb if shown <= 0.04045 => shown / 12.92,
        Transfer::Srgb => core_math::pow((shown + 0.055) / 1.055, 2.4),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn codes(display_bits: u32, transfer: Transfer) -> Codes {
        Codes::new(&Image { width: 1, height: 1, display_bits, transfer })
    }

    #[test]
    fn linear_codes_are_rounded_light() {
        for bits in [8, 10, 12] {
            let codes = codes(bits, Transfer::Linear);
            let greatest = f64::from(codes.greatest());
            for step in 0..=5000 {
                let light = f64::from(step) / 5000.0;
                assert_eq!(f64::from(codes.of(light)), (light * greatest).round(), "{bits} {light}");
            }
        }
    }

    #[test]
    fn srgb_has_the_codes_of_its_standard() {
        let codes = codes(8, Transfer::Srgb);
        // IEC 61966-2-1: 0.18 is the usual grey card.
        for (light, code) in [(0.0, 0), (0.003_130_8, 10), (0.18, 118), (0.5, 188), (1.0, 255)] {
            assert_eq!(codes.of(light), code, "{light}");
        }
    }

    #[test]
    fn light_beyond_the_display_is_clamped() {
        for transfer in [Transfer::Linear, Transfer::Srgb] {
            let codes = codes(10, transfer);
            assert_eq!((codes.of(-1.0), codes.of(7.0), codes.of(f64::INFINITY)), (0, 1023, 1023));
        }
    }
}
