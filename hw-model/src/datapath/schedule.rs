//! Which rank takes which step: the ranks that a data path makes of the composition, and their names.
//!
//! | ranks | take in |
//! |---|---|
//! | 0 | address, x, the ROM word (`fetch`) |
//! | with a register behind the ROM | the same once more (`word`) |
//! | with a cut front end | region, segment, distances (`compare`) |
//! | the last of the head | the variable (`front_end`) |
//! | the middle ones | the multiply-adds on one side, divisor and quotient bits on the other |
//! | the last | intensity and status (`clamp`) |
//!
//! [`Pipelining`] says how many ranks the parts take; nothing else counts them.

use crate::handshake::Control;
use crate::pipelining::{LineStep, Pipelining};
use crate::registers::Register;

use super::parts::Datapath;
use super::signals::RankRegister;

/// The name of the rank behind the front end.
pub const FRONT_END: &str = "front_end";

/// The name of a register of a rank with the rank's name in front: `stage1.t1`. A register of the divider has the
/// divider's name there, also where a multiply-add stage gives the rank its own: `tail0.divisor`. `head` is the number
/// of ranks up to the front end's.
#[must_use]
pub fn register_name(head: usize, rank: usize, rank_name: &str, register: &str) -> String {
    use Register::{Digits, Divisor, Partial, Product, Remainder, Sum};
    let of_divider =
        matches!(Register::named(register), Some(Divisor | Remainder | Digits | Partial(0, _) | Product(0) | Sum(0)));
    match rank.checked_sub(head) {
        Some(index) if of_divider => format!("tail{index}.{register}"),
        _ => format!("{rank_name}.{register}"),
    }
}

impl Datapath {
    /// Where the configuration puts ranks beyond the least.
    #[must_use]
    pub const fn pipelining(&self) -> &Pipelining {
        &self.pipelining
    }

    /// What stands around the ranks: the rule by which they advance, the reset, a register slice.
    #[must_use]
    pub const fn control(&self) -> &Control {
        &self.control
    }

    /// Clock cycles from the edge that takes a request to the one that can give its result away: one for each rank, and
    /// one for a register slice.
    #[must_use]
    pub fn latency(&self) -> usize {
        self.rank_count() + self.control.slice_latency()
    }

    /// Requests that can be under way at once: one in each rank, and two in a register slice.
    #[must_use]
    pub fn capacity(&self) -> usize {
        self.rank_count() + self.control.slice_entries()
    }

    /// Gives the data path these ranks beyond the least, and as many quotient bits in a cycle.
    ///
    /// # Errors
    /// When a register would be wider than one can be; says what would be right.
    pub(crate) fn set_ranks(&mut self, pipelining: Pipelining, quotient_bits: u32) -> Result<(), String> {
        self.pipelining = pipelining;
        self.control.slice = pipelining.ready_slice;
        if let Some(divider) = &mut self.divider {
            divider.digits_per_stage = quotient_bits;
        }
        self.check_pipelining()
    }

    /// Bits of registers in all ranks, valid flags included.
    #[must_use]
    pub fn register_bits(&self) -> u64 {
        let bits = |rank: usize| {
            let held = self.registers(rank).into_iter();
            1 + held.map(|register| u64::from(register.format.width())).sum::<u64>()
        };
        (0..self.rank_count()).map(bits).sum()
    }

    /// Number of ranks of registers.
    #[must_use]
    pub fn rank_count(&self) -> usize {
        self.head_ranks() + self.polynomial_ranks().max(self.divider_ranks()) + 1
    }

    /// Ranks before the multiply-adds: the last of them is the front end's.
    #[must_use]
    pub const fn head_ranks(&self) -> usize {
        self.pipelining.head_ranks()
    }

    /// Ranks of the multiply-adds of the polynomial.
    fn polynomial_ranks(&self) -> usize {
        self.degree() * self.pipelining.line_ranks()
    }

    /// Ranks of the divider: its divisor's, and those of its quotient bits.
    #[must_use]
    pub fn divider_ranks(&self) -> usize {
        self.divider.map_or(0, |divider| self.pipelining.line_ranks() + divider.digit_stages() as usize)
    }

    /// Ranks that hold a division under way: from the divisor's on.
    pub(super) fn division_ranks(&self) -> usize {
        self.divider.map_or(0, |divider| 1 + divider.digit_stages() as usize)
    }

    /// The rank that computes a register; for the registers of a division under way, the first one that does.
    #[must_use]
    pub fn rank_of(&self, register: Register) -> usize {
        let Pipelining { operands, product, .. } = self.pipelining;
        let head = self.head_ranks();
        let line = self.pipelining.line_ranks();
        // The first rank of a stage; the divisor's line begins beside the first stage's.
        let begins = |stage: usize| head + stage.saturating_sub(1) * line;
        match register {
            Register::Distance(_) | Register::Beyond | Register::Region => self.pipelining.compare_rank(),
            Register::V | Register::TailX => self.pipelining.front_end_rank(),
            Register::Partial(stage, _) => begins(stage) + usize::from(operands),
            Register::Product(stage) => begins(stage) + usize::from(operands) + (product as usize).saturating_sub(1),
            Register::Sum(stage) => begins(stage) + usize::from(operands) + product as usize,
            Register::T(stage) => begins(stage) + line - 1,
            Register::Divisor | Register::Remainder | Register::Digits => head + line - 1,
            Register::Intensity | Register::Status => self.rank_count() - 1,
            Register::X | Register::Cut | Register::TailA | Register::TailB => 0,
            Register::C(..) | Register::Shift(_) | Register::HandOver(_) => 0,
        }
    }

    /// The first rank of which `register`, an operand of a multiply-add, is not read any more: its multiplier or adder
    /// stands before that rank.
    pub(super) fn read_by(&self, register: Register) -> usize {
        let degree = self.degree();
        match register {
            Register::C(_, power) if power == degree => self.rank_of(Register::Partial(1, 0)),
            Register::C(_, power) => self.rank_of(Register::Sum(degree.saturating_sub(power))),
            Register::T(stage) if stage < degree => self.rank_of(Register::Partial(stage + 1, 0)),
            Register::V => self.rank_of(Register::Partial(degree, 0)),
            Register::TailB => self.rank_of(Register::Partial(0, 0)),
            Register::TailA => self.rank_of(Register::Sum(0)),
            Register::TailX => self.rank_of(Register::Divisor),
            _ => self.rank_count() - 1,
        }
    }

    /// The multiply-add of the polynomial that a rank works on, counted from 1, and its step; none where the rank does
    /// nothing to the polynomial.
    pub(super) fn polynomial_step(&self, rank: usize) -> Option<(usize, LineStep)> {
        let index = rank.checked_sub(self.head_ranks()).filter(|&index| index < self.polynomial_ranks())?;
        let line = self.pipelining.line_ranks();
        Some((1 + index / line, self.pipelining.line_step(index % line)))
    }

    /// The step of the divisor's multiply-add that a rank takes; none where it takes none.
    pub(super) fn divisor_step(&self, rank: usize) -> Option<LineStep> {
        let index = rank.checked_sub(self.head_ranks())?;
        let begun = self.divider.is_some() && index < self.pipelining.line_ranks();
        begun.then(|| self.pipelining.line_step(index))
    }

    /// The name of a rank, as in traces and waves.
    #[must_use]
    pub fn rank_name(&self, rank: usize) -> String {
        let front_end = self.pipelining.front_end_rank();
        if rank == 0 {
            return "fetch".to_owned();
        }
        if rank <= front_end {
            let cut = rank < front_end && rank == self.pipelining.compare_rank();
            let name = if rank == front_end { FRONT_END } else { "word" };
            return if cut { "compare" } else { name }.to_owned();
        }
        if rank + 1 == self.rank_count() {
            return "clamp".to_owned();
        }
        match self.polynomial_step(rank) {
            Some((stage, LineStep::Operands)) => format!("stage{stage}_operands"),
            Some((stage, LineStep::Partial)) => format!("stage{stage}_partial"),
            Some((stage, LineStep::Product)) => format!("stage{stage}_product"),
            Some((stage, LineStep::Sum)) => format!("stage{stage}_sum"),
            Some((stage, LineStep::Result)) => format!("stage{stage}"),
            None => format!("tail{}", rank - self.head_ranks()),
        }
    }

    /// The name of a register of a rank, with its part's in front: see [`register_name`].
    #[must_use]
    pub fn register_name(&self, rank: usize, register: &RankRegister) -> String {
        register_name(self.head_ranks(), rank, &self.rank_name(rank), register.name())
    }
}
