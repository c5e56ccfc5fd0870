//! Refined ROM integers: never worse than rounded ones, and no neighbour is better. Tried one x after the
//! other through the ranks of registers, not through the block engine that the search uses.

use std::sync::atomic::AtomicU64;

use analysis::refine::{Found, Options, Range, Refined, refine};
use hw_model::config::Config;
use hw_model::design::{Design, Revision};
use hw_model::highlight::phong;
use hw_model::steps::{CoefficientSteps, Steps};
use naive::comparison::{self, Comparison};
use serde_json::json;

const OPTIONS: Options = Options { range: Range::Fitted, reach: 8 };

fn small(segments: u32, form: &str) -> Design {
    let config = json!({
        "name": "small", "method": "minimax", "exponents": "1,4,7.5,12", "input": "UQ1.10",
        "output": "UQ1.9", "form": form, "segments": segments,
        "cut": if segments == 2 { "balanced" } else { "epicentre" },
    });
    Design::new(Config::from_json(&config.to_string()).unwrap()).unwrap()
}

fn designs() -> [Design; 3] {
    [small(1, "centred"), small(2, "centred"), small(1, "power")]
}

fn refined(design: &Design) -> Refined {
    let addresses: Vec<u32> = (0..design.rom().depth() as u32).collect();
    refine(design, &addresses, OPTIONS, &AtomicU64::new(0)).unwrap()
}

/// The greatest error of one segment.
fn worst(design: &Design, address: u32, segment: u32) -> f64 {
    let row = &design.rows()[address as usize];
    let config = design.config();
    let xs = match segment {
        1 => row.least_of_segment(0)..=config.input.one(),
        _ => row.cut..=row.segments[1].start - 1,
    };
    let datapath = design.datapath();
    xs.map(|x| {
        let shown = datapath.passage(address, x).last().unwrap().intensity as f64;
        let exact = phong(row.exponent, x as f64 * config.input.ulp());
        (shown * config.output.ulp() - exact).abs()
    })
    .fold(0.0, f64::max)
}

/// The design with one segment's steps by these more; none where it overflows.
fn beside(design: &Design, found: &Found, by: [i32; 4]) -> Option<Design> {
    let mut revision: Revision = design.revision();
    let rows = &mut revision.coefficient_steps;
    rows.retain(|row| row.n != found.n);
    let own = design.config().coefficient_steps.iter().find(|row| row.n == found.n);
    let own = own.copied().unwrap_or(CoefficientSteps::none(found.n));
    let mut steps = Steps::default();
    for (step, (own, by)) in steps.iter_mut().zip(found.steps.iter().zip(by)) {
        *step = own + by;
    }
    rows.push(own.with(found.segment as usize - 1, steps));
    revision.error_budget_ulp = 1e6;
    let beside = design.revised(revision).ok()?;
    let last = |design: &Design| design.datapath().formats().polynomial.unwrap().last();
    (last(&beside) == last(design)).then_some(beside)
}

#[test]
fn nothing_is_worse_and_what_is_said_is_so() {
    let mut better = 0;
    for design in designs() {
        let refined = refined(&design);
        for found in &refined.found {
            let address = design.rom().address_of(found.n);
            assert_eq!(worst(&design, address, found.segment), found.before, "{found:?}");
            assert_eq!(worst(&refined.design, address, found.segment), found.after, "{found:?}");
            assert!(found.after <= found.before, "{found:?}");
            better += u32::from(found.after < found.before);
        }
        assert_eq!(refined.design.widths(), design.widths());
        assert_eq!(refined.design.rom().layout(), design.rom().layout());
    }
    assert!(better > 3, "{better} are better");
}

#[test]
fn no_neighbour_is_better() {
    let mut tried = 0;
    for design in designs() {
        let refined = refined(&design);
        for found in &refined.found {
            let address = design.rom().address_of(found.n);
            let first = i32::from(found.segment == 2);
            for code in 0..81 {
                let by: [i32; 4] = std::array::from_fn(|i| code / 3_i32.pow(i as u32) % 3 - 1);
                let single = by.iter().filter(|step| **step != 0).count() == 1;
                // c0 of a first segment is no ROM field here: 1 in the centred form.
                let fixed = refined.design.is_centred() && first == 0 && by[0] != 0;
                let reached = (0..4).any(|i| (found.steps[i] + by[i]).abs() > OPTIONS.reach);
                if fixed || reached || (!single && found.n > 4.0) {
                    continue;
                }
                if let Some(beside) = beside(&refined.design, found, by) {
                    let error = worst(&beside, address, found.segment);
                    assert!(error >= found.after, "{by:?} is better: {error} {found:?}");
                    tried += 1;
                }
            }
        }
    }
    assert!(tried > 300, "{tried} tried");
}

#[test]
fn the_configuration_carries_the_result() {
    for design in designs() {
        let once = refined(&design);
        let again = Design::new(Config::from_json(&once.config().to_json()).unwrap()).unwrap();
        assert_eq!(again.rom(), once.design.rom());
        assert_ne!(again.rom(), design.rom());
        comparison::rom(&again).unwrap_or_else(|complaint| panic!("{complaint}"));
        let mut comparison = Comparison::new(&again);
        let xs: Vec<i64> = (0..1024).collect();
        for address in 0..again.rom().depth() as u32 {
            let compared = comparison.inputs(address, &xs);
            assert!(compared.unwrap_or_else(|complaint| panic!("{complaint}")) >= 1024);
        }
        // Refined again, it starts where it ended.
        for (twice, once) in refined(&again).found.iter().zip(&once.found) {
            assert_eq!((twice.n, twice.segment, twice.before), (once.n, once.segment, once.after));
            assert!(twice.after <= twice.before);
        }
    }
}

/// What the steps add is within the bound that the design proves.
#[test]
fn the_bound_holds_with_steps() {
    for design in designs() {
        let design = refined(&design).design;
        let ulp = design.config().output.ulp();
        for (address, row) in design.rows().iter().enumerate() {
            let bound = design.bounds()[address].total();
            assert!(bound <= design.config().error_budget_ulp);
            for x in row.cut..=design.config().input.one() {
                let shown = design.datapath().passage(address as u32, x);
                let shown = shown.last().unwrap().intensity as f64 * ulp;
                let s = (design.config().input.one() - x) as f64 * design.config().input.ulp();
                let error = (shown - row.value_at_s(s, true)).abs() / ulp;
                assert!(error <= bound + 1e-9, "n = {}, x = {x}: {error} {bound}", row.exponent);
            }
        }
    }
}

#[test]
fn steps_that_cannot_be_are_refused() {
    let design = small(1, "centred");
    let refusal = |steps: serde_json::Value, widths: bool| {
        let mut config: serde_json::Value = serde_json::from_str(&design.config().to_json()).unwrap();
        config["coefficient_steps"] = steps;
        config["error_budget_ulp"] = json!(1e6);
        if widths {
            config["widths"] = serde_json::to_value(design.widths()).unwrap();
        }
        let made = Config::from_json(&config.to_string()).map_err(|error| error.to_string());
        made.and_then(|config| Design::new(config).map_err(|error| error.to_string()))
            .map(|_| ())
            .expect_err("it is refused")
    };
    for (steps, widths, words) in [
        (json!([{"n": 5, "c1": 1}]), false, vec!["coefficient_steps", "n = 5", "1,4,7.5,12"]),
        (json!([{"n": 4, "c1": 1}, {"n": 4, "c2": 1}]), false, vec!["n = 4", "twice"]),
        (json!([{"n": 4, "c1_outer": 1}]), false, vec!["n = 4", "there is no c1_outer", "\"segments\" is 1"]),
        (json!([{"n": 4, "c1": 70_000}]), false, vec!["n = 4", "70000 steps of c1", "65536"]),
        (json!([{"n": 4, "c4": 1}]), false, vec!["n = 4", "there is no c4", "\"degree\" 3"]),
        (json!([{"c3": 1}]), false, vec!["missing field `n`"]),
        (json!([{"n": 4, "c1": 0.5}]), false, vec!["0.5", "i32"]),
        (json!([{"n": 4, "c1": 60_000}]), true, vec!["register c1", "n = 4", "could overflow"]),
        (json!([{"n": 4, "c0": -3}]), true, vec!["register c0", "n = 4", "could overflow"]),
    ] {
        let message = refusal(steps.clone(), widths);
        for word in words {
            assert!(message.contains(word), "{steps}: {word:?} is not in {message:?}");
        }
    }
    let schlick = r#"{"name": "s", "method": "schlick", "tail": "rational", "exponents": "1..=4",
        "input": "UQ1.10", "output": "UQ1.9", "coefficient_steps": [{"n": 2, "c1": 1}]}"#;
    let message = Config::from_json(schlick).unwrap_err().to_string();
    assert!(message.contains("no polynomial"), "{message}");
}

/// A budget that steps exceed is not silently broken.
#[test]
fn steps_count_against_the_budget() {
    let design = small(1, "centred");
    let mut revision = design.revision();
    revision.widths = design.widths();
    revision.coefficient_steps = vec![CoefficientSteps::none(4.0).with(0, [0, 40, 0, 0, 0])];
    let message = design.revised(revision).unwrap_err().to_string();
    assert!(message.contains("error budget") && message.contains("n = 4"), "{message}");
}
