//! The registers inside a multiply-add, where a configuration has ranks for them: products of pieces of the operands,
//! the whole product, and the sum before it is rounded.
//!
//! What they hold are the terms of the one line ([`MultiplyAdd`]), step by step. Operands of more than [`PIECE`] bits
//! have a lower and an upper piece, m = m₀ + m₁·2^18 and v = v₀ + v₁·2^18, and their product is
//! m₀v₀ + (m₀v₁ + m₁v₀)·2^18 + m₁v₁·2^36. Lower pieces have no sign; the upper one of a signed multiplicand has its.

use crate::format::{FormatError, QFormat};
use crate::pipelining::{LineStep, PIECE};
use crate::registers::Register;
use crate::rounding::Lane;

use super::parts::Datapath;
use super::signals::Signals;
use super::stage::MultiplyAdd;

/// What meets in a multiply-add.
struct Operands {
    multiplicand: QFormat,
    variable: QFormat,
    result: QFormat,
}

/// Some bits of an operand.
#[derive(Clone, Copy)]
struct Bits {
    /// Its lowest one in the operand.
    from: u32,
    bits: u32,
    /// True where no bits of the operand lie above: they have its sign.
    last: bool,
}

impl Bits {
    /// The pieces of an operand of this width: itself, or a lower and an upper one.
    fn of(width: u32) -> impl Iterator<Item = Self> + Clone {
        let lower = Self { from: 0, bits: width.min(PIECE), last: width <= PIECE };
        let upper = (width > PIECE).then(|| Self { from: PIECE, bits: width - PIECE, last: true });
        [Some(lower), upper].into_iter().flatten()
    }

    fn take<L: Lane>(self, operand: L) -> L {
        let above = operand >> self.from;
        if self.last { above } else { above & ((L::ONE << self.bits) - L::ONE) }
    }
}

/// Pieces of both operands that meet in one multiplier.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    /// The number of their product among those of the line.
    pub(super) part: usize,
    signed: bool,
    multiplicand: Bits,
    variable: Bits,
}

impl Piece {
    /// Their product.
    fn product<L: Lane>(self, multiplicand: L, variable: L) -> L {
        self.multiplicand.take(multiplicand) * self.variable.take(variable)
    }

    /// Their product at its place in the whole one.
    fn placed<L: Lane>(self, product: L) -> L {
        product << (self.multiplicand.from + self.variable.from)
    }
}

/// A signed multiplicand meets a variable that is given a sign for it, which makes a bit more.
fn of_product(signed: bool, integer: i32, fraction: u32) -> Result<QFormat, FormatError> {
    if signed { QFormat::signed(integer + 1, fraction) } else { QFormat::unsigned(integer, fraction) }
}

impl Datapath {
    /// The multiply-add of a stage, or of the divisor for line 0.
    fn line(&self, line: usize) -> Option<&MultiplyAdd> {
        match line.checked_sub(1) {
            Some(index) => self.stages().get(index),
            None => self.divider.as_ref().map(|divider| &divider.divisor),
        }
    }

    /// Widths of multiplicand, variable and result of a stage, or of the divisor for line 0; none where the data path
    /// has no such line.
    #[must_use]
    pub fn line_widths(&self, line: usize) -> Option<[u32; 3]> {
        let Operands { multiplicand, variable, result } = self.operands(line)?;
        Some([multiplicand, variable, result].map(QFormat::width))
    }

    fn operands(&self, line: usize) -> Option<Operands> {
        if line == 0 {
            let formats = self.formats.tail.as_ref()?;
            let variable = self.tail_x_format();
            return Some(Operands { multiplicand: formats.b, variable, result: formats.divisor });
        }
        let formats = self.formats.polynomial.as_ref()?;
        let result = *formats.t().get(line - 1)?;
        Some(Operands { multiplicand: formats.multiplicand(line), variable: formats.v, result })
    }

    /// The pieces whose products make up the product of a line, in the order of their parts.
    pub(super) fn pieces(&self, line: usize) -> impl Iterator<Item = Piece> {
        let operands = self.operands(line);
        operands.into_iter().flat_map(|Operands { multiplicand, variable, .. }| {
            Bits::of(multiplicand.width()).flat_map(move |m| {
                Bits::of(variable.width()).map(move |v| Piece {
                    part: 2 * usize::from(m.from > 0) + usize::from(v.from > 0),
                    signed: m.last && multiplicand.is_signed(),
                    multiplicand: m,
                    variable: v,
                })
            })
        })
    }

    /// A step of a multiply-add of the polynomial, or of the divisor's product and sum for line 0.
    pub(super) fn line_step<L: Lane>(&self, line: usize, step: LineStep, held: &mut Signals) {
        let Some(multiply_add) = self.line(line) else { return };
        let degree = self.degree();
        let of = |register| L::from_bits(held.get(register));
        let (multiplicand, variable) = match line {
            0 => (Register::TailB, Register::TailX),
            1 => (Register::C(0, degree), Register::V),
            _ => (Register::T(line - 1), Register::V),
        };
        let product = || match self.pipelining.product {
            0 | 1 => of(multiplicand) * of(variable),
            _ => {
                let placed = self.pieces(line).map(|piece| piece.placed(of(Register::Partial(line, piece.part))));
                placed.fold(L::ZERO, |whole, part| whole + part)
            }
        };
        let kept = |register, there: bool, computed: &dyn Fn() -> L| if there { of(register) } else { computed() };
        let sum = || {
            let addend = if line == 0 { Register::TailA } else { Register::C(0, degree - line) };
            let product = kept(Register::Product(line), self.pipelining.product > 0, &product);
            multiply_add.sum(product, of(addend))
        };
        match step {
            LineStep::Operands => {}
            LineStep::Partial => {
                let [multiplicand, variable] = [of(multiplicand), of(variable)];
                for piece in self.pieces(line) {
                    held.partial[line][piece.part] = piece.product(multiplicand, variable).to_bits();
                }
            }
            LineStep::Product => held.product[line] = product().to_bits(),
            LineStep::Sum => held.sum[line] = sum().to_bits(),
            LineStep::Result => {
                let result = multiply_add.rounded(kept(Register::Sum(line), self.pipelining.sum, &sum)).to_bits();
                match line.checked_sub(1) {
                    Some(index) => held.t[index] = result,
                    None => held.division.divisor = result,
                }
            }
        }
    }

    /// The format of product or sum of a multiply-add, 0 for the divisor's; none of another register, of a line that is
    /// not there, and where 63 bits do not hold it.
    ///
    /// The product is whole: as many fraction bits as both operands, and of a signed multiplicand a sign more than
    /// needed, as the multiplier's other operand has none. The sum has the place that is rounded, and an integer bit
    /// more than the result: rounding may bring it into the result's format from just outside.
    #[must_use]
    pub fn line_format(&self, register: Register) -> Option<QFormat> {
        let (Register::Product(line) | Register::Sum(line) | Register::Partial(line, _)) = register else {
            return None;
        };
        let Operands { multiplicand, variable, result } = self.operands(line)?;
        let drop = self.line(line)?.dropped_bits();
        let format = match register {
            Register::Product(_) => {
                let fraction = multiplicand.fraction_bits() + variable.fraction_bits();
                of_product(multiplicand.is_signed(), multiplicand.integer_bits() + variable.integer_bits(), fraction)
            }
            Register::Partial(_, part) => {
                let piece = self.pieces(line).find(|piece| piece.part == part)?;
                of_product(piece.signed, (piece.multiplicand.bits + piece.variable.bits) as i32, 0)
            }
            _ => QFormat::signed(result.integer_bits() + 1, result.fraction_bits() + drop),
        };
        format.ok()
    }

    /// Refuses a rank of registers that would be wider than a register can be.
    pub(crate) fn check_pipelining(&self) -> Result<(), String> {
        if self.pipelining.front_end > 0 && self.distance_format(self.segment_count() - 1).is_none() {
            return Err("hand-over − x would need more than 63 bits: leave \"front_end\" out".to_owned());
        }
        let lines = (1..=self.degree()).chain(self.divider.map(|_| 0));
        let kept = lines.flat_map(|line| {
            let product = (self.pipelining.product > 0).then_some((Register::Product(line), "product"));
            product.into_iter().chain(self.pipelining.sum.then_some((Register::Sum(line), "sum")))
        });
        for (register, field) in kept {
            if self.line_format(register).is_none() {
                return Err(format!(
                    "the register {register} would need more than 63 bits: leave \"{field}\" out, or state \
                     narrower formats (widths, multiplier_operand_bits)"
                ));
            }
        }
        Ok(())
    }
}
