//! The log of every register of every cycle that an RTL simulation prints, against the pipeline.

use std::fmt::Write;

use hw_model::datapath::Datapath;
use hw_model::design::Design;
use naive::configurations::{Random, plain};
use sim::agreement::{Agreement, Disagreement, compare};
use sim::pipeline::{Inputs, Pipeline};
use vectors::rtl::probes::probes;

/// What the testbench would print for these cycles, written from the pipeline.
fn log(datapath: &Datapath, cycles: u64, seed: u64) -> String {
    let mut random = Random::new(seed, 0);
    let mut pipeline = Pipeline::new(datapath);
    let input = datapath.formats().input;
    let probes = probes(datapath);
    let mut text = String::from("a simulator's own line\n");
    for cycle in 0..cycles {
        let inputs = Inputs {
            reset: cycle == 0 || random.once_in(50),
            in_valid: !random.once_in(3),
            address: random.integer(0, datapath.rom().depth() as i64) as u32,
            x: random.integer(0, input.max_bits()),
            out_ready: !random.once_in(3),
        };
        let outputs = pipeline.combinational(&inputs);
        let flag = u8::from;
        write!(
            text,
            "R {} {} {} {:x} {:x} {} {}",
            flag(inputs.reset),
            flag(inputs.in_valid),
            flag(outputs.in_ready),
            inputs.address,
            input.to_word(inputs.x),
            flag(outputs.out_valid),
            flag(inputs.out_ready)
        )
        .unwrap();
        for (index, rank) in pipeline.ranks().iter().enumerate() {
            write!(text, " {}", flag(rank.valid)).unwrap();
            for probe in probes.iter().filter(|probe| probe.rank == index) {
                let bits = probe.register.bits(&rank.signals);
                match rank.loaded {
                    true => write!(text, " {:X}", probe.register.format.to_word(bits)).unwrap(),
                    false => text += " xX",
                }
            }
        }
        text += "\n";
        pipeline.clock();
    }
    writeln!(text, "R-END {cycles}").unwrap();
    text
}

fn design() -> Design {
    Design::new(plain()).expect("the plain configuration makes hardware")
}

fn judge(text: &str) -> Result<Agreement, Disagreement> {
    compare(design().datapath(), text.as_bytes())
}

#[test]
fn a_right_log_agrees_and_is_counted() {
    let design = design();
    let agreement = judge(&log(design.datapath(), 2000, 1)).unwrap();
    assert_eq!(agreement.cycles, 2000);
    assert!(agreement.registers > 30_000, "{agreement:?}");
    for count in [agreement.results, agreement.stalls, agreement.bubbles, agreement.resets] {
        assert!(count > 10, "{agreement:?}");
    }
}

/// A log that stops early says nothing of what would have followed.
#[test]
fn a_log_that_was_cut_off_is_refused() {
    let right = log(design().datapath(), 300, 4);
    let lines: Vec<&str> = right.lines().collect();
    assert!(judge(&right).is_ok());
    for kept in [lines.len() - 1, lines.len() / 2, 2] {
        let message = judge(&lines[..kept].join("\n")).unwrap_err().to_string();
        assert!(message.contains("cut off") && message.contains("R-END"), "{message}");
    }
    // Nor does one with another end, or one in which nothing came out.
    assert!(judge(&right.replace("R-END 300", "R-END 301")).is_err());
    let early = log(design().datapath(), 3, 4);
    assert!(judge(&early).unwrap_err().to_string().contains("no result"), "{early}");
}

/// One digit of one register, wherever it stands, is found in its cycle and by its name.
#[test]
fn any_wrong_word_is_found() {
    let design = design();
    let right = log(design.datapath(), 40, 2);
    let lines: Vec<&str> = right.lines().collect();
    let names = names(design.datapath());
    let mut found = 0;
    for line in [20, 30, 39] {
        let words: Vec<&str> = lines[line].split(' ').collect();
        // What is driven (and R itself) is not the hardware's: the ports after it are.
        for place in [3, 6].into_iter().chain(8..words.len()) {
            if words[place].contains('x') {
                continue;
            }
            let wrong = if words[place] == "0" { "1" } else { "0" };
            let changed: Vec<&str> =
                words.iter().enumerate().map(|(at, word)| if at == place { wrong } else { word }).collect();
            let changed = changed.join(" ");
            let mut text = lines.clone();
            text[line] = &changed;
            match judge(&text.join("\n")) {
                Err(Disagreement::Differs { cycle, line: at, name, .. }) => {
                    assert_eq!((cycle, at), (line as u64 - 1, line as u64 + 1));
                    assert_eq!(name, names[place - 1]);
                    found += 1;
                }
                other => panic!("{place}: {other:?}"),
            }
        }
    }
    assert!(found > 50, "{found}");
}

/// The names of the words of a line.
fn names(datapath: &Datapath) -> Vec<String> {
    let ports = ["rst", "in_valid", "in_ready_o", "address", "x", "out_valid_o", "out_ready"];
    let mut names: Vec<String> = ports.map(str::to_owned).to_vec();
    for rank in 0..datapath.rank_count() {
        names.push(format!("{}.valid", datapath.rank_name(rank)));
        let of_rank = probes(datapath).into_iter().filter(|probe| probe.rank == rank);
        names.extend(of_rank.map(|probe| probe.name));
    }
    names
}

#[test]
fn what_is_no_log_is_refused_with_its_line() {
    let design = design();
    let right = log(design.datapath(), 5, 3);
    let refused = |text: &str, words: &[&str]| {
        let message = judge(text).unwrap_err().to_string();
        for word in words {
            assert!(message.contains(word), "{message}: no {word}");
        }
    };
    refused("", &["nothing was compared"]);
    refused("PASS 12 vectors\n", &["nothing was compared"]);
    refused("R 1 0\n", &["line 1", "2 words", "configuration"]);
    refused(&right.replace("R 1", "R g"), &["line 2", "\"g\"", "hex"]);
    refused(&right.replace("R 1", "R x"), &["line 2", "rst_i", "unknown"]);
    refused(&right.replacen("R 1", "R 12345678123456789", 1), &["line 2", "64 bits"]);
    // Without a reset nothing is promised, so nothing is compared.
    refused(&right.replace("R 1", "R 0"), &["nothing was compared"]);
}
