//! Save files of GTKWave, beside waves and beside the RTL: every signal they name is in the dump.

use std::process::Command;

use blysk_tests::bench;
use blysk_tests::save_file::SaveFile;
use blysk_tests::waves::Waves;

use super::{designs, simulate};
use crate::stimulus::patterns;

#[test]
fn a_save_file_comes_with_the_waves() {
    let bench = bench!();
    for (which, design) in designs() {
        let _recorded = simulate(&bench, &which, &patterns(&design)[0].1);
        let _counts = bench.good(&format!("simulate {which} --stimulus in.csv --waves to/a.b.fst"));
        for (save, dump) in [("run/waves.gtkw", "waves.vcd"), ("to/a.b.gtkw", "a.b.fst")] {
            let file = SaveFile::read(&bench.text(save));
            assert_eq!(file.dump.as_deref(), Some(dump));
            let dump = bench.path(save).with_file_name(dump);
            let waves = Waves::read(&dump, &format!("{}.clk_i", design.config().name));
            file.check(&waves);
            // The ports, and each rank with its flag and its registers.
            let ranks = design.datapath().rank_count();
            assert_eq!(file.groups.len(), 1 + ranks);
            assert_eq!(file.groups[0].1.len(), 10);
            for (rank, (name, signals)) in file.groups[1..].iter().enumerate() {
                assert_eq!(*name, format!("rank {rank}, {}", design.datapath().rank_name(rank)));
                assert_eq!(signals.len(), 1 + design.datapath().registers(rank).len(), "{name}");
            }
        }
    }
}

/// Fixed-point numbers are shown as such, flags bit by bit.
#[test]
fn numbers_are_shown_as_what_they_are() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,1\n");
    let _counts = bench.good("simulate --config small.json --stimulus in.csv --waves w.vcd");
    let text = bench.text("w.gtkw");
    for lines in [
        "[dumpfile] \"w.vcd\"\n",
        "@28\nsmall.clk_i\n",
        "@24\nsmall.address_i[3:0]\n",
        "@40000420\n[fpshift_count] 9\nsmall.x_i[10:0]\n",
        "@40000024\n[fpshift_count] 8\nsmall.intensity_o[8:0]\n",
        "@28\nsmall.status_o[3:0]\n",
        "@24\nsmall.front_end.region_q[1:0]\n",
    ] {
        assert!(text.contains(lines), "{lines}{text}");
    }
}

/// The save file is a file of the command: the trace cannot have its name.
#[test]
fn the_save_file_is_not_the_trace() {
    let bench = bench!();
    bench.write("in.csv", "n,x\n1,1\n");
    let run = "simulate --config small.json --stimulus in.csv --waves w.vcd --trace ./w.gtkw";
    let refused = bench.run(run);
    assert_eq!(refused.status, 2, "{refused:#?}");
    assert!(refused.stderr.contains("save file"), "{refused:#?}");
    assert!(!bench.path("w.gtkw").exists() && !bench.path("w.vcd").exists());
}

/// `make waves` in Icarus: the dump has every signal of the bundle's save file, and what the last edge brings.
#[test]
fn a_save_file_comes_with_the_testbench() {
    let bench = bench!();
    for (which, _) in designs().into_iter().take(3) {
        let _rtl = bench.good(&format!("rtl {which} --count 20 --out rtl"));
        let mut make = Command::new("make");
        make.args(["--silent", "-C"]).arg(bench.path("rtl")).args(["waves", "BUILD=other"]);
        make.env_remove("MAKEFLAGS").env_remove("MFLAGS").env_remove("MAKELEVEL");
        let output = make.output().expect("make is there");
        assert!(output.status.success(), "{output:?}");
        let file = SaveFile::read(&bench.text("rtl/waves.gtkw"));
        assert_eq!(file.dump.as_deref(), Some("waves.vcd"));
        let waves = Waves::read(&bench.path("rtl/waves.vcd"), "blysk_tb.dut.clk_i");
        file.check(&waves);
        // Picoseconds: half a cycle behind the last edge.
        assert_eq!(waves.end, waves.edges.last().expect("edges") + 5_000, "{which}");
    }
    // Of a user's own module only the ports are known.
    let _rtl = bench.good("rtl --config small.json --count 20 --dut mine --out rtl");
    let file = SaveFile::read(&bench.text("rtl/waves.gtkw"));
    assert_eq!(file.groups.len(), 1);
}
