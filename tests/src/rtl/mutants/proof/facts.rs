//! What the model knows of the registers: the least and the greatest value each of them takes.

use hw_model::datapath::Datapath;
use hw_model::datapath::reach::{PolynomialReach, Reach, TailReach};
use hw_model::registers::Register;
use vectors::rtl::probes;

/// A register that only takes values of a range, whatever the input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fact {
    /// The rank of the register.
    pub rank: usize,
    /// Its name in the RTL.
    pub path: String,
    /// The least value that the register takes.
    pub least: i64,
    /// The greatest value that the register takes.
    pub greatest: i64,
    /// True where the highest bit is a sign.
    pub signed: bool,
}

/// What is known of every register that the model's range analysis looks at ([`Datapath::polynomial_reach`],
/// [`Datapath::tail_reach`]: exact, over every row and every x).
#[must_use]
pub fn facts(datapath: &Datapath) -> Vec<Fact> {
    let (polynomial, tail) = (datapath.polynomial_reach(), datapath.tail_reach());
    let digit_stages = datapath.divider().map_or(0, |divider| divider.digit_stages() as usize);
    let divided = datapath.rank_of(Register::Divisor);
    let known = probes::probes(datapath).into_iter().filter_map(|probe| {
        let reach = match probe.register.register {
            Register::Remainder if probe.rank != divided => None,
            Register::Digits if probe.rank < divided + digit_stages => None,
            register => of_polynomial(polynomial.as_ref(), register).or(of_tail(tail.as_ref(), register)),
        }?;
        Some(Fact {
            rank: probe.rank,
            path: probe.path,
            least: reach.least.bits,
            greatest: reach.greatest.bits,
            signed: probe.register.format.is_signed(),
        })
    });
    known.collect()
}

fn of_polynomial(reach: Option<&PolynomialReach>, register: Register) -> Option<Reach> {
    let reach = reach?;
    match register {
        Register::V => Some(reach.v),
        Register::T(stage) => reach.lines.get(stage - 1).copied(),
        _ => None,
    }
}

fn of_tail(reach: Option<&TailReach>, register: Register) -> Option<Reach> {
    let reach = reach?;
    match register {
        Register::TailX => Some(reach.x),
        Register::Divisor => Some(reach.divisor),
        Register::Remainder => Some(reach.first_remainder),
        Register::Digits => Some(reach.quotient),
        _ => None,
    }
}

impl Fact {
    /// The fact as Verilog says it of a value of this many bits.
    #[must_use]
    pub fn condition(&self, value: &str, width: usize) -> String {
        let literal = |bits: i64| {
            let sign = if bits < 0 { "-" } else { "" };
            let kind = if self.signed { "sd" } else { "d" };
            format!("{sign}{width}'{kind}{}", bits.unsigned_abs())
        };
        let value = if self.signed { format!("$signed({value})") } else { value.to_owned() };
        format!("{value} >= {} && {value} <= {}", literal(self.least), literal(self.greatest))
    }
}
