//! The scoreboard with the clocked model itself as DUT: right, and with one wrong bit in any register or port.

use model::{Clocked, Inputs, Model, Outputs, Scoreboard, Seen};

/// Requests with stalls, bubbles and a reset in mid-flight.
fn drive(cycle: u64) -> Inputs {
    let random = cycle.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
    Inputs {
        reset: cycle < 2 || cycle == 150,
        in_valid: random & 3 != 0,
        address: (random / 16 % 256) as u32,
        x: (1 << 23) - (random / 64 % (1 << 18)) as i64,
        out_ready: random >> 2 & 3 != 0,
    }
}

fn seen(model: &Model, inputs: &Inputs, outputs: &Outputs) -> Seen {
    let formats = model.datapath().formats();
    Seen {
        reset: Some(inputs.reset),
        in_valid: Some(inputs.in_valid),
        in_ready: Some(outputs.in_ready),
        address: Some(inputs.address),
        x: Some(formats.input.to_word(inputs.x)),
        out_valid: Some(outputs.out_valid),
        out_ready: Some(inputs.out_ready),
        intensity: Some(formats.output.to_word(outputs.intensity)),
        status: Some(outputs.status.bits().into()),
    }
}

/// What the DUT's registers hold; unknown where nothing was loaded.
fn registers(dut: &mut Clocked) -> Vec<Option<u64>> {
    let ranks = dut.ranks();
    let word = |probe: &model::Probe| {
        let rank = &ranks[probe.rank];
        rank.loaded.then(|| probe.register.format.to_word(probe.register.bits(&rank.signals)))
    };
    dut.model().probes().iter().map(word).collect()
}

/// Runs a DUT whose ports and registers pass through `alter`, until something differs.
fn run(cycles: u64, mut alter: impl FnMut(u64, &mut Seen, &mut [Option<u64>])) -> (Scoreboard, Option<String>) {
    let model = Model::preset("paper").unwrap();
    let mut dut = Clocked::new(&model);
    let mut scoreboard = Scoreboard::new(&model);
    for cycle in 0..cycles {
        let inputs = drive(cycle);
        let mut words = registers(&mut dut);
        let outputs = dut.tick(&inputs).unwrap();
        let mut ports = seen(&model, &inputs, &outputs);
        alter(cycle, &mut ports, &mut words);
        if let Err(difference) = scoreboard.cycle(&ports, Some(&words)) {
            return (scoreboard, Some(difference.to_string()));
        }
    }
    (scoreboard, None)
}

#[test]
fn the_model_passes_beside_itself() {
    let (scoreboard, difference) = run(300, |_, _, _| ());
    assert_eq!(difference, None);
    let counts = scoreboard.counts();
    assert_eq!((counts.cycles, counts.resets, counts.failures), (300, 1, 0));
    assert!(counts.results > 100 && counts.stalls > 20 && counts.bubbles > 20 && counts.compared > 5000, "{counts}");
    assert_eq!(scoreboard.verdict().line, format!("PASS {} results", counts.results));
}

#[test]
fn one_wrong_bit_of_any_register_is_named() {
    let model = Model::preset("paper").unwrap();
    for (index, probe) in model.probes().iter().enumerate() {
        let (scoreboard, difference) = run(300, |cycle, _, words| {
            if cycle == 120 {
                words[index] = words[index].map(|word| word ^ 1);
            }
        });
        let difference = difference.unwrap_or_else(|| panic!("{} is not seen", probe.name));
        assert!(difference.starts_with(&format!("cycle 120: {} is ", probe.name)), "{difference}");
        assert!(!difference.contains("should be"), "the registers were seen: {difference}");
        assert!(scoreboard.verdict().line.starts_with("FAIL 1 of 121 cycles differ; the first: cycle 120: "));
    }
}

#[test]
fn one_wrong_port_is_named() {
    type Alter = fn(&mut Seen);
    let alterations: [(&str, Alter); 6] = [
        ("in_ready_o is 0, expected 1", |seen| seen.in_ready = seen.in_ready.map(|level| !level)),
        ("out_valid_o is x, expected ", |seen| seen.out_valid = None),
        ("clamp.intensity is x, expected 16'h", |seen| seen.intensity = None),
        ("clamp.status is 4'h", |seen| seen.status = seen.status.map(|word| word ^ 8)),
        ("rst_i has an x or z in it", |seen| seen.reset = None),
        ("x_i has an x or z in it", |seen| seen.x = None),
    ];
    for (wanted, alter) in alterations {
        let (_, difference) = run(300, |cycle, seen, _| {
            if cycle > 100 && seen.out_valid == Some(true) && seen.in_valid == Some(true) && seen.in_ready == Some(true)
            {
                alter(seen);
            }
        });
        let difference = difference.unwrap_or_else(|| panic!("{wanted}"));
        assert!(difference.contains(wanted), "{difference}");
    }
}

#[test]
fn a_scoreboard_that_saw_nothing_does_not_pass() {
    let model = Model::preset("compact").unwrap();
    let scoreboard = Scoreboard::new(&model);
    assert_eq!(scoreboard.verdict().line, "FAIL rst_i was not high in 0 cycles: nothing was compared");
    let (scoreboard, difference) = run(2, |_, _, _| ());
    assert_eq!(difference, None);
    assert_eq!(scoreboard.verdict().line, "FAIL no result was taken in 2 cycles: they show little");
    assert!(!scoreboard.verdict().passed);
}
