//! Writes the self-checking testbench, from a template and the register list.

use askama::Template;
use hw_model::datapath::Datapath;
use hw_model::format::QFormat;
use hw_model::handshake::{Handshake, ReadySlice};

use super::probes::{Probe, StageWord, probes, valid_path};
use super::sources::Sources;
use super::testbench_rules::Rules;

/// The text of `blysk_tb.sv`.
#[must_use]
pub fn testbench(sources: &Sources<'_>) -> String {
    let datapath = sources.design.datapath();
    let formats = datapath.formats();
    let word = StageWord::of(datapath);
    let probes = probes(datapath);
    let computed: Vec<&Probe> = word.fields.iter().map(|(probe, _)| probe).collect();
    let white_box = sources.modules.is_own();
    let testbench = Testbench {
        configuration: &sources.design.config().name,
        command: sources.command,
        dut: sources.modules.dut(),
        white_box,
        vectors: sources.vectors,
        ranks: datapath.rank_count(),
        latency: datapath.latency(),
        rules: Rules::of(datapath),
        last: datapath.rank_name(datapath.rank_count() - 1),
        depth: datapath.rom().depth(),
        address: Number::of(QFormat::field(datapath.rom().address_width())),
        x: Number::of(formats.input),
        intensity: Number::of(formats.output),
        status_width: datapath.status_width(),
        stage_width: word.width,
        rom_width: datapath.rom().layout().word_width(),
        white_box_ranks: ranks(datapath, &probes, &word),
        log_columns: join(white_box, &computed, |probe| format!(",{}", probe.name)),
        log_format: join(white_box, &computed, |_| ",%h".to_owned()),
        log_values: log_values(white_box, &word),
        trace_format: trace_format(datapath, &probes),
        trace_values: trace_values(datapath, &probes),
    };
    // The template writes to a String, which cannot fail.
    testbench.render().unwrap_or_default() + "\n"
}

#[derive(Template)]
#[template(path = "blysk_tb.sv", escape = "none")]
struct Testbench<'a> {
    configuration: &'a str,
    command: &'a str,
    dut: &'a str,
    white_box: bool,
    vectors: u64,
    ranks: usize,
    latency: usize,
    rules: Rules,
    last: String,
    depth: usize,
    address: Number,
    x: Number,
    intensity: Number,
    status_width: u32,
    stage_width: u32,
    rom_width: u32,
    white_box_ranks: Vec<Rank>,
    log_columns: String,
    log_format: String,
    log_values: String,
    trace_format: String,
    trace_values: String,
}

/// A format as the testbench needs it.
pub(super) struct Number {
    pub(super) width: u32,
    pub(super) signed: u8,
    pub(super) fraction: u32,
}

impl Number {
    pub(super) fn of(format: QFormat) -> Self {
        Self { width: format.width(), signed: u8::from(format.is_signed()), fraction: format.fraction_bits() }
    }
}

struct Rank {
    index: usize,
    count: usize,
    registers: Vec<Field>,
}

/// A register and the bits of the stage word it must equal.
struct Field {
    name: String,
    path: String,
    msb: u32,
    lsb: u32,
    width: u32,
    signed: u8,
    fraction: u32,
    computed: bool,
}

fn ranks(datapath: &Datapath, probes: &[Probe], word: &StageWord) -> Vec<Rank> {
    let of_rank = |index| {
        let registers: Vec<Field> =
            probes.iter().filter(|probe| probe.rank == index).filter_map(|probe| field(probe, word)).collect();
        Rank { index, count: registers.len(), registers }
    };
    (0..datapath.rank_count()).map(of_rank).collect()
}

fn field(probe: &Probe, word: &StageWord) -> Option<Field> {
    let lsb = word.lsb(probe.rank, probe.register.register)?;
    let Number { width, signed, fraction } = Number::of(probe.register.format);
    Some(Field {
        name: probe.name.clone(),
        path: format!("dut.{}", probe.path),
        msb: lsb + width - 1,
        lsb,
        width,
        signed,
        fraction,
        computed: probe.register.computed,
    })
}

fn join(white_box: bool, probes: &[&Probe], each: impl Fn(&Probe) -> String) -> String {
    if white_box { probes.iter().map(|probe| each(probe)).collect() } else { String::new() }
}

fn log_values(white_box: bool, word: &StageWord) -> String {
    let fields = word.fields.iter().filter(|_| white_box);
    let value = |(probe, lsb): &(Probe, u32)| {
        format!(",\n        seen[index][{}:{lsb}]", lsb + probe.register.format.width() - 1)
    };
    fields.map(value).collect()
}

/// `R`, the ports, and for each rank its valid flag and registers.
fn trace_format(datapath: &Datapath, probes: &[Probe]) -> String {
    let tokens = datapath.rank_count() + probes.len();
    format!("R %b %b %b %h %h %b %b{}", " %h".repeat(tokens))
}

fn trace_values(datapath: &Datapath, probes: &[Probe]) -> String {
    let mut values = String::new();
    for rank in 0..datapath.rank_count() {
        values += &format!(",\n        dut.{}", valid_path(rank));
        for probe in probes.iter().filter(|probe| probe.rank == rank) {
            values += &format!(", dut.{}", probe.path);
        }
    }
    values
}
