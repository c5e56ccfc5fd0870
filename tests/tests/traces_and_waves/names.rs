//! The table of names in `docs/FILES.md`, line by line against what commands write.

use std::collections::BTreeMap;
use std::fs;

use blysk_tests::bench;
use blysk_tests::rtl::simulators::repository;
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::presets;
use vectors::rtl::probes::{Probe, ports, probes, valid_path, valid_wave};

use super::designs;

/// A line of the table of registers, its backquotes taken off.
struct Line {
    rank: String,
    trace: String,
    vectors: String,
    wave: String,
    rtl: String,
}

/// The lines of the table whose head begins so.
fn table(head: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(repository().join("docs/FILES.md")).expect("docs/FILES.md");
    let lines = text.lines().skip_while(|line| !line.starts_with(head)).skip(2);
    let cells = |line: &str| {
        let inside = line.trim_matches('|');
        inside.split('|').map(|cell| cell.trim().replace('`', "")).collect()
    };
    let table: Vec<_> = lines.take_while(|line| line.starts_with('|')).map(cells).collect();
    assert!(!table.is_empty(), "{head}");
    table
}

fn registers() -> Vec<Line> {
    let line = |cells: Vec<String>| {
        let [rank, trace, vectors, wave, mut rtl] = cells.try_into().expect("five cells");
        if let Some(end) = rtl.find(" (") {
            rtl.truncate(end);
        }
        Line { rank, trace, vectors, wave, rtl }
    };
    table("| r | trace |").into_iter().map(line).collect()
}

/// What stands for what in a rank of a design.
struct Place<'a> {
    design: &'a Design,
    rank: usize,
}

impl Place<'_> {
    fn steps(&self) -> usize {
        self.design.datapath().divider().map_or(0, |divider| divider.digit_stages() as usize)
    }

    /// Whether a line's ranks include this one: `0`, `every`, `last`, `2 to S+1`, `5 up`.
    fn includes(&self, ranks: &str) -> bool {
        let last = self.rank + 1 == self.design.datapath().rank_count();
        let degree = self.design.datapath().degree();
        let more = |text: &str| text.parse::<usize>().expect("a number");
        let number = |text: &str| match (text.split_once('+'), text) {
            (Some(("S", further)), _) => self.steps() + more(further),
            (Some(("D", further)), _) => degree + more(further),
            (_, "D") => degree,
            _ => more(text),
        };
        match ranks.split_whitespace().collect::<Vec<_>>()[..] {
            ["every"] => true,
            ["last"] => last,
            _ if last => false,
            [rank] => self.rank == number(rank),
            [from, "up"] => self.rank >= number(from),
            [from, "to", to] => (number(from)..=number(to)).contains(&self.rank),
            _ => panic!("{ranks} are no ranks"),
        }
    }

    /// The line's name for a register called `register` here. In a rank that the line does not include it means
    /// nothing.
    fn name(&self, pattern: &str, register: &str) -> String {
        let mut name = pattern.replace("{rank}", &self.design.datapath().rank_name(self.rank));
        let degree = self.design.datapath().degree();
        let fields = self.design.rom().layout().fields();
        let field = fields.iter().position(|field| field.name.name() == register);
        name = name.replace("{field}", register).replace("c{i}", register);
        name = name.replace("{i}", register.trim_start_matches('c'));
        name = name.replace("{D}", &degree.to_string());
        name = name.replace("{f}", &field.map_or_else(String::new, |field| field.to_string()));
        let steps = self.steps();
        for (text, less) in
            [("{r}", 0), ("{r-1}", 1), ("{r-2}", 2), ("{r-3}", 3), ("{r-D-2}", degree + 2), ("{r-S-3}", steps + 3)]
        {
            name = name.replace(text, &self.rank.wrapping_sub(less).to_string());
        }
        assert!(!name.contains('{'), "{pattern} leaves {name}");
        name
    }
}

/// Whether a pattern with `{field}` or `c{i}` can mean this register.
fn can_mean(line: &Line, register: &str) -> bool {
    let coefficient = ["c0", "c1", "c2", "c3", "c4"].contains(&register);
    match &line.trace {
        pattern if pattern.contains("c{i}") => coefficient,
        pattern if pattern.contains("{field}") => !["x", "status"].contains(&register),
        _ => true,
    }
}

/// A divider that is done before the polynomial, and waits.
const SHORT_DIVIDER: &str = r#"{"name": "short", "method": "hermite", "exponents": "1..=8", "input": "Q2.9",
    "output": "UQ1.5", "form": "power", "tail": "rational", "quotient_bits_per_stage": 8}"#;

/// Every preset too: deep dividers, two segments.
fn all_designs() -> Vec<(String, Design)> {
    let mut all = designs();
    let short = Design::new(Config::from_json(SHORT_DIVIDER).unwrap()).unwrap();
    all.push(("--config short.json".to_owned(), short));
    for example in ["parabolas", "quartics"] {
        let path = format!("{}/../docs/examples/{example}.json", env!("CARGO_MANIFEST_DIR"));
        let json = std::fs::read_to_string(&path).unwrap();
        let design = Design::new(Config::from_json(&json).unwrap()).unwrap();
        all.push((format!("--config {path}"), design));
    }
    for preset in presets::ALL {
        let design = Design::new(Config::from_json(preset.json).unwrap()).unwrap();
        all.push((format!("--preset {}", preset.name), design));
    }
    all
}

#[test]
fn every_register_stands_in_the_table_once_and_no_line_is_idle() {
    let bench = bench!();
    bench.write("short.json", SHORT_DIVIDER);
    let lines = registers();
    let mut used: BTreeMap<usize, usize> = BTreeMap::new();
    for (which, design) in all_designs() {
        let _summary = bench.good(&format!("vectors {which} --count 1 --out v"));
        let table = bench.text("v/vectors.csv");
        let columns: Vec<&str> = table.lines().next().expect("a header").split(',').collect();
        for probe in probes(design.datapath()) {
            let place = Place { design: &design, rank: probe.rank };
            let register = probe.register.name();
            let means = |line: &Line| {
                place.includes(&line.rank)
                    && can_mean(line, register)
                    && place.name(&line.trace, register) == probe.name
            };
            let found: Vec<usize> = (0..lines.len()).filter(|&at| means(&lines[at])).collect();
            let [at] = found[..] else { panic!("{which}: {} is in lines {found:?}", probe.name) };
            *used.entry(at).or_default() += 1;
            check(&lines[at], &place, &probe, &columns, &which);
        }
        for rank in 0..design.datapath().rank_count() {
            let place = Place { design: &design, rank };
            assert_eq!(place.name(&lines[0].wave, ""), valid_wave(design.datapath(), rank));
            assert_eq!(place.name(&lines[0].rtl, ""), valid_path(rank));
        }
    }
    assert_eq!(lines[0].trace, "{rank}.valid");
    let idle: Vec<&str> =
        (1..lines.len()).filter(|at| !used.contains_key(at)).map(|at| lines[at].trace.as_str()).collect();
    assert_eq!(idle, [""; 0], "lines that no register is in");
}

fn check(line: &Line, place: &Place<'_>, probe: &Probe, columns: &[&str], which: &str) {
    let register = probe.register.name();
    assert_eq!(place.name(&line.wave, register), probe.wave, "{which}");
    assert_eq!(place.name(&line.rtl, register), probe.path, "{which}");
    let column = match line.vectors.as_str() {
        "=" => Some(probe.name.as_str()),
        "= with several segments" => (place.design.datapath().segment_count() > 1).then_some(probe.name.as_str()),
        "" => None,
        other => Some(other),
    };
    assert_eq!(columns.contains(&probe.name.as_str()), column == Some(&probe.name), "{which}");
    assert!(column.is_none_or(|column| columns.contains(&column)), "{which}: {column:?}");
}

#[test]
fn every_port_stands_in_the_table() {
    let bench = bench!();
    let (which, design) = designs().swap_remove(0);
    bench.write("in.csv", "n,x\n1,1\n");
    let _counts = bench.good(&format!("simulate {which} --stimulus in.csv --trace t.csv"));
    let _rtl = bench.good(&format!("rtl {which} --count 1 --out rtl"));
    let (trace, testbench) = (bench.text("t.csv"), bench.text("rtl/blysk_tb.sv"));
    let lines = table("| trace | RTL and waves |");
    let ports = ports(design.datapath());
    assert_eq!(lines.len(), ports.len());
    let mut header = vec!["cycle"];
    for (line, port) in lines.iter().zip(&ports) {
        let [column, name, driven] = &line[..] else { panic!("{line:?}") };
        assert_eq!((column.as_str(), name.as_str()), (port.column.unwrap_or(""), port.name));
        header.extend(port.column);
        assert!(testbench.contains(&format!(".{name}({driven})")), "{name}");
    }
    assert!(trace.starts_with(&format!("{},fetch.valid,", header.join(","))), "{header:?}");
}
