//! Why a register is as wide as it is, in words.

use hw_model::config::Config;
use hw_model::datapath::front_end::Variable;
use hw_model::datapath::{Datapath, RankRegister};
use hw_model::design::Share;
use hw_model::format::QFormat;
use hw_model::registers::Register;

use super::facts::{Facts, Held, Known};
use super::lines::rounding;
use super::words::{bits, places};

/// A, B and D give up bits together.
const TAIL: [Register; 3] = [Register::TailA, Register::TailB, Register::Divisor];

/// What the reasons are taken from.
pub(super) struct Reasons<'a> {
    facts: &'a Facts<'a>,
}

impl<'a> Reasons<'a> {
    pub(super) const fn new(facts: &'a Facts<'a>) -> Self {
        Self { facts }
    }

    fn datapath(&self) -> &Datapath {
        self.facts.design.datapath()
    }

    fn config(&self) -> &Config {
        self.facts.design.config()
    }

    /// Fraction bits dropped in the line that a register ends, and how.
    pub(super) fn rounded(&self, rank: usize, register: Register) -> String {
        let datapath = self.datapath();
        let line = match register {
            Register::T(stage) => datapath.stages().get(stage - 1).copied(),
            Register::Divisor => datapath.divider().map(|divider| divider.divisor),
            Register::V => {
                return match datapath.front_end().variable {
                    Some(Variable::U { drop, rounding: mode, .. }) => rounding(drop, mode),
                    _ => "no".to_owned(),
                };
            }
            Register::Intensity => {
                let divider = datapath.divider();
                return divider.map_or_else(
                    || "no".to_owned(),
                    |divider| format!("the quotient: 2 (one bit and the sticky), {}", divider.rounding),
                );
            }
            Register::Cut if !self.config().domain.is_empty() => {
                return "in the ROM: down, to the last x that is not above the domain's least".to_owned();
            }
            Register::Cut => return rounded_end("cut", "down", self.cut_up()),
            Register::HandOver(_) => {
                return rounded_end("point", "nearest_even", self.hand_over_up());
            }
            Register::C(..) | Register::TailA | Register::TailB if rank == 0 => {
                return "in the ROM: nearest_even".to_owned();
            }
            _ => None,
        };
        line.map_or_else(|| "no".to_owned(), |line| rounding(line.dropped_bits(), line.rounding()))
    }

    /// Why a register has its width.
    pub(super) fn width(&self, rank: usize, register: &RankRegister, held: &Held) -> String {
        let format = register.format;
        match register.register {
            Register::X if rank > 0 && rank == self.datapath().rank_of(Register::Region) => {
                "x clamped to [0, 1]: no sign, and 1 itself must fit where x reaches it".to_owned()
            }
            Register::X => "the input format".to_owned(),
            Register::Product(_) => "the product is kept whole: the bits of both operands".to_owned(),
            Register::Partial(..) => "the bits of both pieces".to_owned(),
            Register::Sum(_) => "the bits of the result, those rounded off, and a bit and a sign for what \
                                 rounding brings back into its format"
                .to_owned(),
            Register::Distance(0) => "1 − x, with x clamped to [0, 1]".to_owned(),
            Register::Distance(_) => "hand-over − x, and a sign for an x that another segment answers".to_owned(),
            Register::Beyond => "one bit a further segment".to_owned(),
            Register::Region => "three regions".to_owned(),
            Register::Status => "one bit a flag".to_owned(),
            Register::TailX => {
                "x clamped to [0, 1]: no sign, and 1 itself must fit where x reaches it; 0 where the tail \
                 does not answer"
                    .to_owned()
            }
            Register::Cut => end_width("cut", "cut", self.cut_up(), format),
            Register::HandOver(_) => end_width("hand_over", "one", self.hand_over_up(), format),
            Register::Shift(_) => format!("e is at most {}", held.greatest),
            Register::Remainder if rank == self.datapath().rank_of(Register::Remainder) => {
                "the upper part of x·2^k, less than D (see the divider)".to_owned()
            }
            Register::Remainder => "every remainder is less than D".to_owned(),
            Register::Digits => self.digits(rank, held, format),
            Register::Intensity => "the output format".to_owned(),
            Register::V if self.datapath().front_end().variable == Some(Variable::X) => {
                format!("x as it comes: {}", integer(held, format))
            }
            Register::T(stage) if stage == self.datapath().degree() => {
                format!("{}; {}", integer(held, format), self.last(stage, format))
            }
            name => {
                let integer = integer(held, format);
                let fraction = self.fraction(name, format);
                format!("{integer}; {fraction}{}", self.multiplier(name, format))
            }
        }
    }

    fn cut_up(&self) -> u32 {
        self.datapath().front_end().cut_up
    }

    fn hand_over_up(&self) -> u32 {
        self.datapath().front_end().hand_over_up
    }

    fn digits(&self, rank: usize, held: &Held, format: QFormat) -> String {
        let output = self.config().output.fraction_bits();
        if rank == self.facts.last_digits() {
            format!(
                "the whole quotient: {} fraction bits (one more than the output, for the rounding), at most \
                 {}",
                output + 1,
                places(held.greatest as f64 * (-f64::from(output + 1)).exp2(), 7)
            )
        } else {
            format!("{} of dividend to come or quotient found, in all", bits(format.width().into()))
        }
    }

    fn last(&self, stage: usize, format: QFormat) -> String {
        let share = self.share(Register::T(stage));
        let shown = share.map_or(0.0, |share| share.ulp);
        format!(
            "{} as the output: the last rounding adds at most {} ulp; [0, 1] is the clamp's work",
            fraction_bits(format),
            places(shown, 3)
        )
    }

    fn share(&self, register: Register) -> Option<&Share> {
        // All segments have the same formats.
        let name = hw_model::stated::name(register.of_any_segment());
        self.facts.shares.iter().find(|share| share.register == name)
    }

    /// The fraction bits, from the error budget.
    fn fraction(&self, register: Register, format: QFormat) -> String {
        let count = fraction_bits(format);
        let Some(share) = self.share(register) else { return count };
        let shows = if share.ulp > 0.0 {
            let shown = places(share.ulp, 3);
            let place = format!("output ulp, most at n = {}", share.exponent);
            if shown == "0" {
                format!("rounding to them shows as less than 0.001 {place}")
            } else {
                format!("rounding to them shows as at most {shown} {place}")
            }
        } else {
            "nothing is lost by them".to_owned()
        };
        let budget = places(self.config().error_budget_ulp, 6);
        match share.one_bit_fewer {
            Some(worst) if TAIL.contains(&register) => format!(
                "{count}: {shows}; with one less in A, B and D the bound would be {} ulp, above the \
                 budget of {budget}",
                above(worst, &budget)
            ),
            Some(worst) => format!(
                "{count} by the error budget: {shows}; with one less the bound would be {} ulp, above the \
                 budget of {budget}",
                above(worst, &budget)
            ),
            None => format!("{count}: {shows}"),
        }
    }

    fn multiplier(&self, register: Register, format: QFormat) -> String {
        let degree = self.datapath().degree();
        let multiplied = match register {
            Register::V => true,
            Register::C(_, power) => power == degree,
            Register::T(stage) => stage < degree,
            _ => false,
        };
        match self.config().multiplier_operand_bits {
            Some(most) if multiplied && format.width() == most => {
                format!("; {most} bits are what an operand of the multipliers may have")
            }
            _ => String::new(),
        }
    }
}

/// A number in as few places, three or more, as show that it is not the other one.
fn above(value: f64, other: &str) -> String {
    let mut written = (3..12).map(|count| places(value, count));
    written.find(|text| text != other).unwrap_or_else(|| places(value, 12))
}

/// How an end of a segment, in the ROM, comes from the real one.
fn rounded_end(end: &str, mode: &str, up: u32) -> String {
    let first = format!("in the ROM: up, to the first x that is not below the real {end}");
    if up == 0 { first } else { format!("{first}; then {mode} to the stated bits") }
}

/// The width of an end of a segment, which x is compared with.
fn end_width(end: &str, greatest: &str, up: u32, format: QFormat) -> String {
    let fraction = if up == 0 {
        format!("the fraction bits of x, so that x ≥ {end} is exact")
    } else {
        let zeros = if up == 1 { "1 zero brings".to_owned() } else { format!("{up} zeros bring") };
        format!("{}, as stated; {zeros} it to the unit of x", fraction_bits(format))
    };
    format!("{fraction}; integer bits for the greatest {greatest}")
}

fn fraction_bits(format: QFormat) -> String {
    let count = format.fraction_bits();
    if count == 1 { "1 fraction bit".to_owned() } else { format!("{count} fraction bits") }
}

/// The integer bits, from the values.
fn integer(held: &Held, format: QFormat) -> String {
    let sign = if format.is_signed() { "sign included" } else { "no sign" };
    let count = format.integer_bits();
    let words = if count >= 0 {
        let plural = if count == 1 { "" } else { "s" };
        format!("the values take {count} integer bit{plural}, {sign}")
    } else {
        let zeros = -count;
        let places = if zeros == 1 { "place is" } else { "places are" };
        format!("no integer bit, and the first {zeros} {places} always 0 and not kept, {sign}")
    };
    let least = i128::from(held.least);
    let greatest = i128::from(held.greatest);
    let needed = QFormat::for_range(least, greatest, format.fraction_bits());
    match needed {
        Ok(needed) if held.known == Known::Exact && needed.width() < format.width() => {
            let spare = format.width() - needed.width();
            let plural = if spare == 1 { "" } else { "s" };
            format!(
                "{words} ({spare} bit{plural} more than these values need: the range analysis bounds \
                 rounding errors and does not follow them)"
            )
        }
        _ => words,
    }
}
