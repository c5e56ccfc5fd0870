//! The registers that each part of the block diagram stands for: what a page shows of it on a click.

use hw_model::registers::Register;

use super::block::Picture;

/// A part of the diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    Rom,
    /// The register of x.
    Input,
    FrontEnd,
    /// The wire of region and status.
    Choice,
    /// A box of a multiply-add.
    Stage(usize),
    Divisor,
    /// The ranks of quotient bits, and the wires between them.
    Digits,
    Clamp,
    /// The wire of a coefficient of all segments.
    Coefficients(usize),
    /// The wire of one register.
    Only(Register),
}

impl Part {
    fn has(self, register: Register) -> bool {
        use Register as R;
        match self {
            Self::Rom => {
                matches!(register, R::C(..) | R::Cut | R::Shift(_) | R::HandOver(_) | R::TailA | R::TailB)
            }
            Self::Input => register == R::X,
            Self::FrontEnd => {
                matches!(register, R::X | R::Region | R::Status | R::V | R::Distance(_) | R::Beyond | R::TailX)
            }
            Self::Choice => matches!(register, R::Region | R::Status),
            Self::Stage(stage) => match register {
                R::T(of) | R::Product(of) | R::Sum(of) | R::Partial(of, _) => of == stage,
                _ => false,
            },
            Self::Divisor => {
                matches!(register, R::Divisor | R::Product(0) | R::Sum(0) | R::Partial(0, _))
            }
            Self::Digits => matches!(register, R::Divisor | R::Remainder | R::Digits),
            Self::Clamp => matches!(register, R::Intensity | R::Status),
            Self::Coefficients(power) => matches!(register, R::C(_, of) if of == power),
            Self::Only(only) => register == only,
        }
    }
}

impl Picture<'_> {
    /// Draws a part, whose element in the SVG names the registers that it stands for.
    pub(super) fn named(&mut self, part: Part, draw: impl FnOnce(&mut Self)) {
        let mut names: Vec<&str> = Vec::new();
        for rank in 0..self.datapath.rank_count() {
            for register in self.datapath.registers(rank) {
                if part.has(register.register) && !names.contains(&register.name()) {
                    names.push(register.name());
                }
            }
        }
        self.canvas.open(&names.join(" "));
        draw(self);
        self.canvas.close();
    }
}
