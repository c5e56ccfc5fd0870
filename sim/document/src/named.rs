//! The registers that each part of the block diagram stands for: what a page shows of it on a click.

use hw_model::datapath::Datapath;
use hw_model::registers::Register;

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

    /// The names of the registers that it stands for, in the order of the ranks, with spaces between.
    pub(super) fn names(self, datapath: &Datapath) -> String {
        let mut names: Vec<&str> = Vec::new();
        for register in (0..datapath.rank_count()).flat_map(|rank| datapath.registers(rank)) {
            if self.has(register.register) && !names.contains(&register.name()) {
                names.push(register.name());
            }
        }
        names.join(" ")
    }
}
