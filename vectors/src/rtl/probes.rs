//! What ports and registers are called: in traces, in waves, and in the RTL. `docs/FILES.md` has the table.

use hw_model::datapath::HEAD_RANKS;
use hw_model::datapath::{Datapath, RankRegister};
use hw_model::format::QFormat;
use hw_model::registers::Register;

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
        ("rst_i", Some("rst"), flag),
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
    let last = datapath.rank_count() - 1;
    let degree = datapath.degree();
    match (rank, register) {
        (0, Register::X) => "x_q".to_owned(),
        (0, Register::Status) => FETCH_STATUS.to_owned(),
        (0, field) => rom_field(datapath, field),
        (_, Register::Intensity | Register::Status) if rank == last => {
            format!("clamp.{register}_q")
        }
        (1, Register::V) => "front_end.variable.v_q".to_owned(),
        (1, Register::TailX) => "front_end.tail.tail_x_q".to_owned(),
        (1, Register::Region | Register::Status) => format!("front_end.{register}_q"),
        (_, Register::Region | Register::Status) => carried(&format!("{register}_delay"), rank - HEAD_RANKS),
        (_, Register::C(_, power)) => carried(&format!("polynomial.coefficient[{power}].delay"), rank - 1),
        (_, Register::TailA) => carried("tail.a_delay", rank - 1),
        (_, Register::TailB) => carried("tail.b_delay", rank - 1),
        (_, Register::V) => carried(&format!("polynomial.stage[{rank}].later.v_delay"), 0),
        (_, Register::T(stage)) if rank > degree + 1 => {
            carried("polynomial.wait_for_tail.t_delay", rank - stage - HEAD_RANKS)
        }
        (_, Register::T(stage)) => format!("polynomial.stage[{stage}].multiply_add.t_q"),
        (HEAD_RANKS, Register::Divisor) => "tail.divider.divisor_stage.t_q".to_owned(),
        (HEAD_RANKS, division) => format!("tail.divider.{division}_q"),
        (_, division) => digit_stage(datapath, rank - HEAD_RANKS - 1, division),
    }
}

/// A field of the ROM word, which the RTL has by its number.
fn rom_field(datapath: &Datapath, register: Register) -> String {
    let fields = datapath.rom().layout().fields();
    let number = fields.iter().position(|field| field.name == register).unwrap_or(fields.len());
    format!("rom.field[{number}].value")
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
