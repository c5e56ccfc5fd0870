//! What each rank of registers holds, bit by bit.

use hw_model::datapath::{Datapath, RankRegister, Status};
use hw_model::registers::Register;

use super::table::Table;

/// What each rank holds.
pub(super) fn ranks(datapath: &Datapath) -> Table {
    let mut table = Table::new(&["rank", "name", "registers (width)", "flip-flops", "of them always 0"]);
    let (mut all, mut all_idle) = (0, 0);
    for rank in 0..datapath.rank_count() {
        let registers = datapath.registers(rank);
        let listed: Vec<String> = registers
            .iter()
            .map(|register| format!("`{}` ({})", shown(rank, register), declared(rank, register)))
            .collect();
        // One more for the valid flag.
        let bits = 1 + registers.iter().map(|held| declared(rank, held)).sum::<u32>();
        let idle = idle(datapath, rank, &registers);
        let name = datapath.rank_name(rank);
        all += bits;
        all_idle += idle.len();
        let words = if idle.is_empty() { String::new() } else { format!("{}: {}", idle.len(), idle.join(", ")) };
        table.row([rank.to_string(), name, listed.join(", "), bits.to_string(), words]);
    }
    let words = [String::new(), "all".to_owned(), String::new(), all.to_string()];
    let [rank, name, registers, bits] = words;
    table.row([rank, name, registers, bits, all_idle.to_string()]);
    table
}

/// Of the status rank 0 has a flip-flop for what it knows, and no other.
fn only_no_word(rank: usize, register: &RankRegister) -> bool {
    rank == 0 && register.register == Register::Status
}

fn declared(rank: usize, register: &RankRegister) -> u32 {
    if only_no_word(rank, register) { 1 } else { register.format.width() }
}

fn shown(rank: usize, register: &RankRegister) -> &'static str {
    if only_no_word(rank, register) { "no_word" } else { register.name() }
}

/// Bits of region and status that nothing in this configuration sets.
fn idle(datapath: &Datapath, rank: usize, registers: &[RankRegister]) -> Vec<String> {
    let mut idle = Vec::new();
    let has = |name| registers.iter().any(|register| register.register == name);
    if has(Register::Region) {
        let parts = [datapath.degree() > 0, datapath.divider().is_some()];
        let unused = (0..).zip(parts).filter(|&(_, present)| !present);
        idle.extend(unused.map(|(bit, _): (u32, _)| format!("`region[{bit}]`")));
    }
    if rank > 0 && has(Register::Status) {
        let flags = datapath.status_flags().iter();
        let never = flags.filter(|&&(flag, _)| !can_be_set(datapath, rank, flag));
        idle.extend(never.map(|(_, name)| format!("`{name}`")));
    }
    idle
}

/// Whether there is logic that sets a flag in what a rank behind the first holds.
fn can_be_set(datapath: &Datapath, rank: usize, flag: Status) -> bool {
    let input = datapath.formats().input;
    match flag {
        // Before x is compared with anything, only the ROM has something to say.
        _ if flag != Status::NO_WORD && rank < datapath.rank_of(Register::Region) => false,
        Status::ABOVE_ONE => input.max_bits() > input.one(),
        Status::FACING_AWAY => input.is_signed(),
        Status::CLAMPED => rank + 1 == datapath.rank_count() && datapath.degree() > 0,
        _ => true,
    }
}
