//! Mutations of a netlist that are said to be equivalent are so: on a configuration that is small enough
//! to try every input.

use std::path::Path;
use std::sync::LazyLock;

use blysk_tests::rtl::Failure;
use blysk_tests::rtl::mutants::proof::graph::{Bit, Graph, Holds};
use blysk_tests::rtl::mutants::proof::{Judgement, Prover, facts};
use blysk_tests::rtl::mutants::{Bench, netlist};
use blysk_tests::rtl::simulators;
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::registers::Register;
use vectors::rtl::probes;
use vectors::{Bundle, Strategy};

const MUTATIONS: usize = 60;
const SEED: u64 = 1;
const SECONDS: u32 = 20;

static DESIGN: LazyLock<Design> = LazyLock::new(|| design("1..=8"));

/// Of these exponents A has bits that are the same in every row.
static ALIKE: LazyLock<Design> = LazyLock::new(|| design("5..=8"));

/// Signed, with polynomial and tail, so that there are all regions and flags.
fn design(exponents: &str) -> Design {
    let json = format!(
        r#"{{"name": "proofs", "method": "hermite", "exponents": "{exponents}", "input": "Q2.5",
        "output": "UQ1.5", "form": "power", "tail": "rational", "cut": "epicentre",
        "error_budget_ulp": 2, "quotient_bits_per_stage": 3}}"#
    );
    Design::new(Config::from_json(&json).unwrap()).unwrap()
}

/// The netlist, its mutations, and every input there is.
struct Small {
    design: &'static Design,
    bench: Bench,
    mutations: Vec<String>,
}

impl Small {
    fn new(name: &str) -> Self {
        Self::of(name, &DESIGN)
    }

    fn of(name: &str, design: &'static Design) -> Self {
        let bundle = Bundle::new(design, Strategy::Exhaustive, 0, 1, "a test").unwrap();
        let bench = Bench::new(name, &bundle).unwrap();
        let mutations = netlist::mutate(&bench.directory, MUTATIONS, SEED).unwrap();
        Self { design, bench, mutations }
    }

    fn prover(&self, file: &str) -> Result<Prover, Failure> {
        Prover::new(&self.bench.directory, file, self.design.datapath(), SECONDS)
    }

    /// The netlist with a mutation in it, in a file of its own.
    fn spoil(&self, mutation: &str) -> &'static str {
        const SPOILT: &str = "spoilt.il";
        let script = format!("read_rtlil {}; {mutation}; write_rtlil {SPOILT}", netlist::RIGHT);
        blysk_tests::rtl::mutants::proof::tools::yosys(&self.bench.directory, &script).unwrap();
        SPOILT
    }
}

/// A mutation of one bit of a register: of what it loads (`D`) or what it shows (`Q`).
fn mutation(graph: &Graph, mode: &str, signal: &str, bit: usize, port: &str) -> String {
    let (index, place) = graph.locate(graph.named(signal)[bit]).unwrap();
    let cell = &graph.registers[index].cell;
    format!("mutate -mode {mode} -module blysk -cell {cell} -port {port} -portbit {place}")
}

/// What no vector of all shows is the same, and what is said to be the same no vector shows. A judgement takes
/// seconds: every mutation that survives is judged, and of those that are killed every fourth, or with
/// BLYSK_JUDGED=all, as `make mutants` asks, every one.
#[test]
fn judgements_are_those_of_every_input() {
    let every = match std::env::var("BLYSK_JUDGED") {
        Ok(all) => {
            assert_eq!(all, "all", "BLYSK_JUDGED is all, or is not set");
            1
        }
        Err(_) => 4,
    };
    let small = Small::new("proofs-every-input");
    let icarus = &simulators::all().unwrap()[0];
    small.bench.build(icarus, &netlist::sources()).unwrap();
    let outcomes = netlist::run(&small.bench, icarus, &small.mutations).unwrap();
    let asked: Vec<bool> = (outcomes.iter().enumerate())
        .map(|(index, outcome)| outcome.killed_by.is_none() || index % every == 0)
        .collect();
    let directory = &small.bench.directory;
    let judged = netlist::judge(directory, DESIGN.datapath(), &small.mutations, &asked, SECONDS).unwrap();
    let (mut equivalent, mut visible) = (0, 0);
    for (outcome, judgement) in outcomes.iter().zip(judged) {
        let killed = outcome.killed_by.is_some();
        match judgement {
            None => {}
            Some(Judgement::Equivalent(why)) => {
                assert!(!killed, "{outcome:?} is said to be equivalent: {why}");
                equivalent += 1;
            }
            Some(Judgement::Visible { .. }) => {
                assert!(killed, "{outcome:?} is said to be visible");
                visible += 1;
            }
            Some(Judgement::Open) => {}
        }
    }
    // How many stay open is a matter of the machine's speed; that there are both kinds is none.
    let open = asked.iter().filter(|asked| **asked).count() - equivalent - visible;
    assert!(equivalent >= 1 && visible >= 10, "{equivalent} equivalent, {visible} visible, {open} open");
}

#[test]
fn a_bit_that_is_the_same_in_every_row_may_be_stuck_there_and_nowhere_else() {
    let small = Small::of("proofs-constant-bit", &ALIKE);
    let prover = small.prover(netlist::RIGHT).unwrap();
    let rows = ALIKE.rom().rows();
    let values = || rows.iter().map(|row| row.get(Register::TailA));
    let always = values().fold(!0, |all, bits| all & bits);
    let ever = values().fold(0, |any, bits| any | bits);
    let width = ALIKE.datapath().formats().tail.unwrap().a.width() as usize;
    let mut constant = 0;
    for bit in 0..width {
        for (value, mode, other) in [(always, "const1", "const0"), (!ever, "const0", "const1")] {
            if value >> bit & 1 == 1 {
                let at = |mode| mutation(prover.graph(), mode, "tail.a_added", bit, "D");
                let same = prover.judge(1, &at(mode)).unwrap();
                assert!(matches!(same, Judgement::Equivalent(_)), "bit {bit}: {same:?}");
                let not_same = prover.judge(1, &at(other)).unwrap();
                assert!(!matches!(not_same, Judgement::Equivalent(_)), "bit {bit}: {not_same:?}");
                constant += 1;
            }
        }
    }
    assert!(constant > 0, "no bit of A is the same in all of {rows:?}");
}

#[test]
fn a_clamp_that_acts_is_not_proved_idle() {
    let small = Small::new("proofs-clamp");
    let prover = small.prover(netlist::RIGHT).unwrap();
    // The flag of x above 1, which an input of more than 1 sets.
    let above_one = mutation(prover.graph(), "const0", "front_end.status_q", 1, "D");
    let judged = prover.judge(1, &above_one).unwrap();
    let Judgement::Visible { x, .. } = judged else { panic!("{judged:?}") };
    assert!((33..64).contains(&x), "x = {x}/32 is not above 1");
}

#[test]
fn valid_flags_and_enables_are_control_and_the_rest_is_data() {
    let small = Small::new("proofs-places");
    let prover = small.prover(netlist::RIGHT).unwrap();
    for stuck in ["const0", "const1", "inv"] {
        let flag = mutation(prover.graph(), stuck, "handshake.valid_q", 2, "Q");
        assert_eq!(prover.judge(1, &flag).unwrap(), Judgement::Open, "{flag}");
        let enable = mutation(prover.graph(), stuck, "x_q", 0, "EN");
        assert_eq!(prover.judge(1, &enable).unwrap(), Judgement::Open, "{enable}");
        let clock = mutation(prover.graph(), stuck, "x_q", 0, "CLK");
        assert_eq!(prover.judge(1, &clock).unwrap(), Judgement::Open, "{clock}");
    }
}

/// What the proofs take for granted is looked at, not believed.
#[test]
fn a_netlist_that_mixes_requests_or_parts_is_refused() {
    let small = Small::new("proofs-premises");
    let graph = small.prover(netlist::RIGHT).unwrap();
    let graph = graph.graph();
    let region = probes::probes(DESIGN.datapath());
    let region = region.iter().rfind(|probe| probe.register.register == Register::Region).unwrap();
    // The quotient is shown in the region zero too.
    let shown = mutation(graph, "const1", &region.path, 1, "Q");
    // A rank is loaded where it should hold.
    let text = std::fs::read_to_string(small.bench.directory.join(netlist::RIGHT)).unwrap();
    let cells = text.lines().filter_map(|line| line.trim().strip_prefix("cell $and "));
    let and = cells.into_iter().find(|cell| cell.contains("handshake")).unwrap();
    let reloads = format!("mutate -mode inv -module blysk -cell {and} -port Y -portbit 2");
    for spoilt in [shown, reloads] {
        let refused = small.prover(small.spoil(&spoilt));
        assert!(refused.is_err(), "{spoilt}");
    }
}

/// The facts on every request there is.
#[test]
fn every_request_keeps_to_the_facts() {
    let datapath = DESIGN.datapath();
    let facts = facts::facts(datapath);
    let names: Vec<&str> = facts.iter().map(|fact| fact.path.as_str()).collect();
    assert!(names.contains(&"polynomial.stage[3].multiply_add.t_q") && facts.len() > 8, "{names:?}");
    let probes = probes::probes(datapath);
    let input = datapath.formats().input;
    for address in 0..16 {
        for x in input.min_bits()..=input.max_bits() {
            let passage = datapath.passage(address, x);
            for fact in &facts {
                let probe = probes.iter().find(|probe| probe.path == fact.path).unwrap();
                let held = probe.register.bits(&passage[probe.rank]);
                assert!((fact.least..=fact.greatest).contains(&held), "{fact:?}: {held}");
            }
        }
    }
}

#[test]
fn every_register_is_found_in_its_rank() {
    let small = Small::new("proofs-graph");
    let prover = small.prover(netlist::RIGHT).unwrap();
    let graph = prover.graph();
    let mut found = 0;
    for probe in probes::probes(DESIGN.datapath()) {
        for bit in graph.named(&probe.path) {
            if let (Bit::Net(_), Some((index, _))) = (bit, graph.locate(bit)) {
                assert_eq!(graph.registers[index].holds, Holds::Data(probe.rank), "{}", probe.name);
                found += 1;
            }
        }
    }
    assert!(found > 100, "{found}");
    assert!(Path::new(&small.bench.directory).join("proof/graph.json").exists());
}
