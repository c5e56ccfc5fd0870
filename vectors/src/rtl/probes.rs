//! What ports and registers are called: in traces, in waves, and in the RTL. `docs/FILES.md` has the table.

use hw_model::datapath::{Datapath, Register};
use hw_model::format::QFormat;

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
    pub register: Register,
    /// What it is called in waves, in the scope of its rank: `stage1.t1_q`.
    pub wave: String,
    /// What it is called in the RTL, below the top module: `polynomial.stage1.t_q`. In a rank where
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
            let wave = format!("{}.{}_q", datapath.rank_name(rank), register.name);
            let path = path(datapath, rank, register.name);
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

/// Ranks before the first multiply-add stage.
const HEAD: usize = 2;
/// The rank of t3.
const STAGE3: usize = 4;

fn path(datapath: &Datapath, rank: usize, name: &str) -> String {
    let last = datapath.rank_count() - 1;
    match (rank, name) {
        (0, "x") => "x_q".to_owned(),
        (0, "status") => FETCH_STATUS.to_owned(),
        (0, field) => field.to_owned(),
        (_, "intensity" | "status") if rank == last => format!("clamp.{name}_q"),
        (1, "v") => "front_end.variable.v_q".to_owned(),
        (1, "tail_x") => "front_end.tail.tail_x_q".to_owned(),
        (1, "region" | "status") => format!("front_end.{name}_q"),
        (_, "region" | "status") => carried(&format!("{name}_delay"), rank - HEAD),
        (_, "c3" | "c2" | "c1" | "c0") => carried(&format!("polynomial.{name}_delay"), rank - 1),
        (_, "tail_a") => carried("tail.a_delay", rank - 1),
        (_, "tail_b") => carried("tail.b_delay", rank - 1),
        (_, "v") => carried(&format!("polynomial.v_delay_{rank}"), 0),
        (_, "t1" | "t2") => format!("polynomial.stage{}.t_q", rank - 1),
        (STAGE3, "t3") => "polynomial.stage3.t_q".to_owned(),
        (_, "t3") => carried("polynomial.wait_for_tail.t3_delay", rank - STAGE3 - 1),
        (HEAD, "divisor") => "tail.divider.divisor_stage.t_q".to_owned(),
        (HEAD, division) => format!("tail.divider.{division}_q"),
        (_, division) => digit_stage(datapath, rank - HEAD - 1, division),
    }
}

/// The registers after digit stage `step`, and where the division waits for the polynomial.
fn digit_stage(datapath: &Datapath, step: usize, name: &str) -> String {
    let steps = datapath.divider().map_or(0, |divider| divider.digit_stages() as usize);
    match name {
        "divisor" => format!("tail.divider.digit_stage[{step}].quotient_bits.carried.divisor_q"),
        _ if step < steps => format!("tail.divider.digit_stage[{step}].quotient_bits.{name}_q"),
        _ => carried(&format!("tail.wait_for_polynomial.{name}_delay"), step - steps),
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
    pub fn lsb(&self, rank: usize, name: &str) -> Option<u32> {
        let mut before = self.fields.iter().filter(|(probe, _)| probe.rank <= rank);
        before.rfind(|(probe, _)| probe.register.name == name).map(|&(_, lsb)| lsb)
    }
}
