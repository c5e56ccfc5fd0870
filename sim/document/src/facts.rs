//! What is known of a design's registers: what each can hold, and how that is known.

use hw_model::datapath::reach::{PolynomialReach, TailReach};
use hw_model::datapath::{Datapath, RankRegister};
use hw_model::design::{Design, Share};
use hw_model::registers::Register;

/// What a register can hold.
#[derive(Debug, Clone)]
pub struct Held {
    /// The least bits.
    pub least: i64,
    /// The greatest bits.
    pub greatest: i64,
    /// The exponent of the row that reaches furthest from 0, where one is known.
    pub furthest: Option<f64>,
    /// How the two are known.
    pub known: Known,
}

/// How a range is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// Every value between is allowed by the format or the encoding.
    Format,
    /// Evaluated in integers over every row and every x.
    Exact,
    /// A proved bound, which no input need reach.
    Bound,
}

/// A design with what was found out about it.
#[derive(Debug)]
pub struct Facts<'a> {
    /// The design.
    pub design: &'a Design,
    /// What the polynomial's registers take, where the design has one and that was found.
    pub polynomial: Option<PolynomialReach>,
    /// What the divider's registers take, where the design has one.
    pub tail: Option<TailReach>,
    /// What each register adds to the error bound.
    pub shares: Vec<Share>,
}

impl<'a> Facts<'a> {
    /// The facts of a design: reach of its registers, shares of its error.
    #[must_use]
    pub fn new(design: &'a Design) -> Self {
        let datapath = design.datapath();
        Self {
            design,
            polynomial: datapath.polynomial_reach(),
            tail: datapath.tail_reach(),
            shares: design.error_shares(),
        }
    }

    /// The data path of the design.
    #[must_use]
    pub fn datapath(&self) -> &'a Datapath {
        self.design.datapath()
    }

    /// What a register holds in a rank that computes it.
    #[must_use]
    pub fn held(&self, rank: usize, register: &RankRegister) -> Held {
        let reach = match (register.register, &self.polynomial, &self.tail) {
            (Register::V, Some(reach), _) => Some(reach.v),
            (Register::T(stage), Some(reach), _) => reach.lines.get(stage - 1).copied(),
            (Register::TailX, _, Some(reach)) => Some(reach.x),
            (Register::Divisor, _, Some(reach)) => Some(reach.divisor),
            (Register::Remainder, _, Some(reach)) if rank == self.datapath().rank_of(Register::Remainder) => {
                Some(reach.first_remainder)
            }
            (Register::Digits, _, Some(reach)) if rank == self.last_digits() => Some(reach.quotient),
            _ => None,
        };
        if let Some(reach) = reach {
            let (least, greatest) = (reach.least, reach.greatest);
            let furthest = if greatest.bits >= -least.bits { greatest } else { least };
            let exponent = self.design.rows()[furthest.address as usize].exponent;
            let known = Known::Exact;
            return Held { least: least.bits, greatest: greatest.bits, furthest: Some(exponent), known };
        }
        self.of_the_rest(register)
    }

    fn of_the_rest(&self, register: &RankRegister) -> Held {
        let format = register.format;
        let held = |least, greatest, known| Held { least, greatest, furthest: None, known };
        let fields = self.design.rom().layout().fields();
        if let Some(field) = fields.iter().find(|field| field.name == register.register) {
            let bits = || self.design.rom().rows().iter().map(|row| row.get(field.name));
            let ends = bits().min().zip(bits().max());
            return ends.map_or_else(
                || held(format.min_bits(), format.max_bits(), Known::Format),
                |(least, greatest)| held(least, greatest, Known::Exact),
            );
        }
        match (register.register, &self.tail) {
            (Register::Remainder, Some(reach)) => held(0, reach.divisor.greatest.bits - 1, Known::Bound),
            (Register::Region, _) => held(0, self.greatest_region(), Known::Format),
            // Where the polynomial's greatest value was not found, that of the clamp is all that is known.
            (Register::Intensity, _) if self.polynomial.is_none() && self.datapath().degree() > 0 => {
                held(0, self.datapath().output_one(), Known::Bound)
            }
            (Register::Intensity, _) => held(0, self.greatest_intensity(), Known::Exact),
            _ => held(format.min_bits(), format.max_bits(), Known::Format),
        }
    }

    fn greatest_region(&self) -> i64 {
        if self.tail.is_some() { 2 } else { 1 }
    }

    /// Both parts rise with what they are made from.
    fn greatest_intensity(&self) -> i64 {
        let datapath = self.datapath();
        let greatest = datapath.front_end().greatest;
        let tail = self.tail.map(|reach| reach.quotient.greatest);
        let tail = tail.and_then(|place| Some((place.address, place.x?)));
        let rows = 0..datapath.rom().depth() as u32;
        let ends = rows.map(|address| (address, greatest)).chain(tail);
        let line = self.polynomial.as_ref().map(|reach| reach.last().greatest);
        let line = line.and_then(|place| Some((place.address, place.x?)));
        let intensity = |(address, x)| datapath.evaluate(address, x).intensity;
        ends.chain(line).map(intensity).max().unwrap_or(0)
    }

    /// The rank of the last quotient bits.
    #[must_use]
    pub fn last_digits(&self) -> usize {
        let stages = self.datapath().divider().map_or(0, |divider| divider.digit_stages() as usize);
        self.datapath().rank_of(Register::Divisor) + stages
    }
}
