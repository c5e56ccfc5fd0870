//! VCD and FST, both read back by a reader that shares nothing with their writers, against the trace:
//! the same signals, times and values.

use blysk_tests::bench;
use blysk_tests::cli::Bench;
use blysk_tests::waves::Waves;
use hw_model::design::Design;

use super::trace::Trace;
use super::waves::signals;
use super::{designs, simulate};
use crate::stimulus::patterns;

/// The run recorded as FST as well, against what is there already.
pub fn check(bench: &Bench, which: &str, trace: &Trace, design: &Design, place: &str) {
    let _counts = bench.good(&format!("simulate {which} --stimulus in.csv --waves run.fst"));
    let top = &design.config().name;
    let [vcd, fst] = ["run/waves.vcd", "run.fst"].map(|file| Waves::read(&bench.path(file), &format!("{top}.clk_i")));
    against_trace(&vcd, trace, design, place);
    assert!(vcd == fst, "{place}: VCD and FST differ");
}

fn against_trace(waves: &Waves, trace: &Trace, design: &Design, place: &str) {
    assert_eq!(waves.timescale, -9, "{place}: ns");
    let edges: Vec<u64> = (0..trace.len() as u64).map(|cycle| 10 * cycle + 5).collect();
    assert_eq!(waves.edges, edges, "{place}");
    let signals = signals(design);
    assert_eq!(waves.end, 10 * trace.len() as u64, "{place}: half a cycle behind the last edge");
    assert_eq!(waves.signals.len(), signals.len() + 2, "{place}: the signals, clock and flags");
    flags(waves, trace, design, place);
    for signal in signals {
        let name = signal.path(&design.config().name).join(".");
        let found = waves.get(&name);
        assert_eq!(found.width, signal.width, "{place}: {name}");
        for cycle in 0..trace.len() {
            let at = format!("{place}, cycle {cycle}: {name}");
            let wanted = trace.get(cycle, &signal.column).map(|bits| signal.to_word(bits));
            assert_eq!(found.word(cycle), wanted, "{at}");
            let unknown = found.values[cycle].bytes().all(|digit| digit == b'x');
            assert_eq!(unknown, wanted.is_none(), "{at}: {}", found.values[cycle]);
        }
    }
}

/// The valid flags side by side, that of rank 0 in bit 0; at the end nothing is in flight.
fn flags(waves: &Waves, trace: &Trace, design: &Design, place: &str) {
    let flags = waves.get(&format!("{}.handshake.valid_q", design.config().name));
    let datapath = design.datapath();
    assert_eq!(flags.width as usize, datapath.rank_count(), "{place}");
    for cycle in 0..trace.len() {
        let of_rank = |rank| trace.flag(cycle, &format!("{}.valid", datapath.rank_name(rank)));
        let wanted = (0..datapath.rank_count()).fold(0, |word, rank| word | u64::from(of_rank(rank)) << rank);
        assert_eq!(flags.word(cycle), Some(wanted), "{place}, cycle {cycle}");
    }
    assert_eq!(flags.last_word(), Some(0), "{place}");
    let port = waves.get(&format!("{}.out_valid_o", design.config().name));
    assert_eq!(port.last_word(), Some(0), "{place}: the last result was taken");
}

/// The same run, the same bytes.
#[test]
fn waves_have_no_time_stamp() {
    let bench = bench!();
    let (_, design) = designs().swap_remove(0);
    for (_, stimulus) in patterns(&design) {
        let _recorded = simulate(&bench, "--config small.json", &stimulus);
        for format in ["vcd", "fst"] {
            for file in ["one", "two"] {
                let run = "simulate --config small.json --stimulus in.csv --waves";
                let _counts = bench.good(&format!("{run} {file}.{format}"));
            }
            let [one, two] = ["one", "two"].map(|file| bench.read(&format!("{file}.{format}")));
            assert!(!one.is_empty() && one == two, "{format}");
        }
    }
}

/// A run so long that its changes do not stay in memory to the end: several blocks of an FST file.
#[test]
fn a_long_run_is_the_same_in_both_formats() {
    let bench = bench!();
    let lines: String = (0..40_000_u32).map(|cycle| format!("{},{}\n", 1 + cycle % 8, cycle * 401 % 512)).collect();
    bench.write("in.csv", format!("n,x_bits\n{lines}"));
    let run = "simulate --config small.json --stimulus in.csv --waves";
    let [vcd, fst] = ["w.vcd", "w.fst"].map(|file| {
        let _counts = bench.good(&format!("{run} {file}"));
        Waves::read(&bench.path(file), "small.clk_i")
    });
    assert!(vcd == fst);
    assert!(vcd.edges.len() > 40_000, "{} edges", vcd.edges.len());
    let (vcd, fst) = (bench.read("w.vcd").len(), bench.read("w.fst").len());
    assert!(fst < vcd / 4, "{fst} bytes of FST, {vcd} of VCD");
}
