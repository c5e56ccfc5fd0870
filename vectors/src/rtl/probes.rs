//! What ports and registers are called: in traces, in waves, and in the RTL. `docs/FILES.md` has the table.

use hw_model::datapath::{Datapath, RankRegister};
use hw_model::format::QFormat;
use hw_model::registers::Register;

use super::reset_port;

/// A port of the pipeline.
#[derive(Debug, Clone, Copy)]
pub struct Port {
    /// Its name in RTL and waves.
    pub name: &'static str,
    /// Its column in traces; the clock has none.
    pub column: Option<&'static str>,
    /// The format of the port's bits.
    pub format: QFormat,
}

/// The ports, the clock first, in the order of traces.
#[must_use]
pub fn ports(datapath: &Datapath) -> [Port; 10] {
    let formats = datapath.formats();
    let flag = QFormat::field(1);
    let address = QFormat::field(datapath.rom().address_width());
    let status = QFormat::field(datapath.status_width());
    [
        ("clk_i", None, flag),
        (reset_port::name(&datapath.control().reset), Some("rst"), flag),
        ("in_valid_i", Some("in_valid"), flag),
        ("in_ready_o", Some("in_ready"), flag),
        ("address_i", Some("address"), address),
        ("x_i", Some("x"), formats.input),
        ("out_valid_o", Some("out_valid"), flag),
        ("out_ready_i", Some("out_ready"), flag),
        ("intensity_o", Some("intensity"), formats.output),
        ("status_o", Some("status"), status),
    ]
    .map(|(name, column, format)| Port { name, column, format })
}

/// A register of the model with its place in the RTL.
#[derive(Debug, Clone)]
pub struct Probe {
    /// The rank it stands in, counted from 0.
    pub rank: usize,
    /// Its name with its part's: `stage1.t1`.
    pub name: String,
    /// The register of the model that holds the same bits.
    pub register: RankRegister,
    /// What it is called in waves, in the scope of its rank: `stage1.t1_q`.
    pub wave: String,
    /// What it is called in the RTL, below the top module: `polynomial.stage[1].multiply_add.t_q`. In a rank where
    /// the model keeps a field apart that the RTL keeps in a wider register, a wire that shows it.
    pub path: String,
}

/// Every register of every rank, in the order of traces.
#[must_use]
pub fn probes(datapath: &Datapath) -> Vec<Probe> {
    let mut probes = Vec::new();
    for rank in 0..datapath.rank_count() {
        for register in datapath.registers(rank) {
            let name = datapath.register_name(rank, &register);
            let wave = format!("{}.{}_q", datapath.rank_name(rank), register.name());
            let path = path(datapath, rank, register.register);
            probes.push(Probe { rank, name, register, wave, path });
        }
    }
    probes
}

/// The valid flags in the RTL: that of rank 0 is bit 0.
pub const VALID_FLAGS: &str = "handshake.valid_q";

/// The valid flag of a rank in the RTL.
#[must_use]
pub fn valid_path(rank: usize) -> String {
    format!("{VALID_FLAGS}[{rank}]")
}

/// The valid flag of a rank in waves, which have them one by one too.
#[must_use]
pub fn valid_wave(datapath: &Datapath, rank: usize) -> String {
    format!("{}.valid_q", datapath.rank_name(rank))
}

/// The status of rank 0 in the RTL: a wire around the only flag that is known by then. The other bits are 0 from the
/// start, where a register would be unknown.
pub const FETCH_STATUS: &str = "fetch_status";

fn path(datapath: &Datapath, rank: usize, register: Register) -> String {
    let pipelining = datapath.pipelining();
    let (compare, front_end) = (pipelining.compare_rank(), pipelining.front_end_rank());
    if rank + 1 == datapath.rank_count() {
        return format!("clamp.{register}_q");
    }
    match rank {
        _ if rank < compare => in_fetch(datapath, rank, register),
        _ if rank < front_end => in_compare(datapath, register),
        _ => behind_front_end(datapath, rank - front_end, register),
    }
}

/// The fetched word with x, in its first rank or behind it.
fn in_fetch(datapath: &Datapath, rank: usize, register: Register) -> String {
    match (rank, register) {
        (0, Register::X) => "x_q".to_owned(),
        (0, Register::Status) => FETCH_STATUS.to_owned(),
        (_, Register::X | Register::Status) => carried(&format!("{register}_behind_rom"), 0),
        (_, field) if rank + 1 == datapath.pipelining().compare_rank() => rom_field(datapath, "value", field),
        (_, field) => rom_field(datapath, "behind.fetched", field),
    }
}

/// The rank that cuts the front end.
fn in_compare(datapath: &Datapath, register: Register) -> String {
    let part = match register {
        Register::X | Register::Region | Register::Status => format!("front_end.held_{register}"),
        Register::Beyond => "front_end.several_segments.held_beyond".to_owned(),
        Register::Distance(segment) => format!("front_end.segment[{segment}].distance.held"),
        field => return carried(&format!("word_field[{}].held", field_number(datapath, field)), 0),
    };
    carried(&part, 0)
}

/// Registers of the front end's rank and of the middle ones, `rank` counted from the front end's.
fn behind_front_end(datapath: &Datapath, rank: usize, register: Register) -> String {
    let pipelining = datapath.pipelining();
    let operands = usize::from(pipelining.operands);
    // The step of the multiply-add that the rank takes, and the stage.
    let line = pipelining.line_ranks();
    let (stage, step) = match rank.checked_sub(1) {
        Some(index) => (1 + index / line, index % line),
        None => (0, 0),
    };
    let copied = operands == 1 && rank > 0 && step == 0;
    match register {
        Register::V if rank == 0 => "front_end.variable.v_q".to_owned(),
        Register::TailX if rank == 0 => "front_end.tail.tail_x_q".to_owned(),
        Register::Region | Register::Status if rank == 0 => format!("front_end.{register}_q"),
        Register::Region | Register::Status => carried(&format!("{register}_delay"), rank - 1),
        Register::V if copied => operand(&format!("polynomial.stage[{stage}].multiply_add"), "variable"),
        Register::V => carried(&format!("polynomial.stage[{}].later.v_delay", stage + 1), step - operands),
        Register::C(_, power) if copied && power == datapath.degree() => {
            operand("polynomial.stage[1].multiply_add", "multiplicand")
        }
        Register::C(_, power) => carried(&format!("polynomial.coefficient[{power}].delay"), rank),
        Register::T(last) => result(datapath, rank, last),
        Register::Partial(1.., _) | Register::Product(1..) | Register::Sum(1..) => {
            inside(&format!("polynomial.stage[{stage}].multiply_add"), register)
        }
        _ => in_tail(datapath, rank, register),
    }
}

/// A copied operand of a multiply-add.
fn operand(stage: &str, which: &str) -> String {
    carried(&format!("{stage}.operands.{which}_copy"), 0)
}

/// A register inside a multiply-add.
fn inside(line: &str, register: Register) -> String {
    match register {
        Register::Partial(_, part) => format!("{line}.pieces.upper[{}].by[{}].part_q", part / 2, part % 2),
        Register::Sum(_) => format!("{line}.sum_register.sum_q"),
        _ => format!("{line}.product_register.product_q"),
    }
}

/// The result of a stage: where it is computed, where it is an operand of the next, and where the last one waits.
fn result(datapath: &Datapath, rank: usize, stage: usize) -> String {
    let since = rank - stage * datapath.pipelining().line_ranks();
    match since {
        0 => format!("polynomial.stage[{stage}].multiply_add.t_q"),
        _ if stage == datapath.degree() => carried("polynomial.wait_for_tail.t_delay", since - 1),
        _ => operand(&format!("polynomial.stage[{}].multiply_add", stage + 1), "multiplicand"),
    }
}

/// The divider's registers behind the front end's rank.
fn in_tail(datapath: &Datapath, rank: usize, register: Register) -> String {
    const LINE: &str = "tail.divider.divisor_stage";
    let pipelining = datapath.pipelining();
    let (line, operands) = (pipelining.line_ranks(), usize::from(pipelining.operands));
    match register {
        Register::TailA => carried("tail.a_delay", rank),
        Register::TailB if rank == 0 => carried("tail.b_delay", 0),
        Register::TailB => operand(LINE, "multiplicand"),
        Register::TailX if rank == operands => operand(LINE, "variable"),
        Register::TailX => carried("tail.divider.x_waits.x_delay", rank - 1 - operands),
        Register::Partial(..) | Register::Product(_) | Register::Sum(_) => inside(LINE, register),
        Register::Divisor if rank == line => format!("{LINE}.t_q"),
        division if rank == line => format!("tail.divider.{division}_q"),
        division => digit_stage(datapath, rank - line - 1, division),
    }
}

fn field_number(datapath: &Datapath, register: Register) -> usize {
    let fields = datapath.rom().layout().fields();
    fields.iter().position(|field| field.name == register).unwrap_or(fields.len())
}

/// A wire that shows a field of the ROM word, which the RTL has by its number.
fn rom_field(datapath: &Datapath, wire: &str, register: Register) -> String {
    format!("rom.field[{}].{wire}", field_number(datapath, register))
}

/// The registers after digit stage `step`, and where the division waits for the polynomial.
fn digit_stage(datapath: &Datapath, step: usize, register: Register) -> String {
    let steps = datapath.divider().map_or(0, |divider| divider.digit_stages() as usize);
    match register {
        Register::Divisor => {
            format!("tail.divider.digit_stage[{step}].quotient_bits.carried.divisor_q")
        }
        _ if step < steps => {
            format!("tail.divider.digit_stage[{step}].quotient_bits.{register}_q")
        }
        _ => carried(&format!("tail.wait_for_polynomial.{register}_delay"), step - steps),
    }
}

fn carried(delay: &str, rank: usize) -> String {
    format!("{delay}.carried.register[{rank}].value_q")
}

/// The word of `stages.mem`: every register in the rank that computes it, from bit 0 up.
#[derive(Debug, Clone)]
pub struct StageWord {
    /// The computed registers, with their lowest bit in the word.
    pub fields: Vec<(Probe, u32)>,
    /// Bits of the word.
    pub width: u32,
}

impl StageWord {
    /// The word of a data path.
    #[must_use]
    pub fn of(datapath: &Datapath) -> Self {
        let mut width = 0;
        let computed = probes(datapath).into_iter().filter(|probe| probe.register.computed);
        let fields = computed
            .map(|probe| {
                let lsb = width;
                width += probe.register.format.width();
                (probe, lsb)
            })
            .collect();
        Self { fields, width }
    }

    /// Where the value that a register holds in `rank` stands in the word: that of the last rank up
    /// to there that computed it.
    #[must_use]
    pub fn lsb(&self, rank: usize, register: Register) -> Option<u32> {
        let mut before = self.fields.iter().filter(|(probe, _)| probe.rank <= rank);
        before.rfind(|(probe, _)| probe.register.register == register).map(|&(_, lsb)| lsb)
    }
}
