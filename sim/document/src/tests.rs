use std::collections::BTreeSet;

use hw_model::config::Config;
use hw_model::presets;
use hw_model::registers::Register;
use plot::texts;

use super::*;

/// The presets, and what is unlike them: short and long dividers, one row, wide words.
fn designs() -> Vec<Design> {
    let others = [
        r#"{"name": "a", "method": "hermite", "exponents": "1..=8", "input": "Q2.7", "output": "UQ1.6",
            "tail": "rational", "form": "power", "quotient_bits_per_stage": 8}"#,
        r#"{"name": "b", "method": "tangent", "exponents": "2.5", "input": "UQ0.9", "output": "UQ0.8",
            "cut": "minimum", "rounding": "floor", "error_budget_ulp": 4}"#,
        r#"{"name": "c", "method": "schlick", "exponents": "1,2,1000", "input": "Q2.30",
            "output": "UQ1.24", "tail": "rational", "quotient_bits_per_stage": 1}"#,
    ];
    let configs = presets::ALL.map(|preset| preset.config().unwrap());
    let others = others.map(|json| Config::from_json(json).unwrap());
    configs.into_iter().chain(others).map(|config| Design::new(config).unwrap()).collect()
}

/// Every word is inside the picture, and on top of no other.
fn readable(svg: &str) {
    let (found, size) = texts(svg).unwrap();
    assert!(found.len() > 10, "only {} texts", found.len());
    for (index, text) in found.iter().enumerate() {
        let inside = text.left >= 0.0 && text.top >= 0.0 && text.right <= size.0 && text.bottom <= size.1;
        assert!(inside, "{text:?} leaves the picture of {size:?}");
        for other in &found[index + 1..] {
            let apart = text.right <= other.left
                || other.right <= text.left
                || text.bottom <= other.top + 1.0
                || other.bottom <= text.top + 1.0;
            assert!(apart, "{text:?} covers {other:?}");
        }
    }
}

#[test]
fn pictures_can_be_read() {
    for design in designs() {
        readable(&block::block(&design));
        for scenario in scenario::scenarios(design.datapath()) {
            readable(&timing::timing(design.datapath(), &scenario));
        }
    }
}

/// What leaves rank 0 is on a wire of its own, or in a box of its own.
#[test]
fn the_block_diagram_shows_every_register_of_rank_0() {
    for design in designs() {
        let (found, _) = texts(&block::block(&design)).unwrap();
        for register in design.datapath().registers(0) {
            let segments = design.datapath().segment_count();
            let width = register.format.width();
            let label = match register.register {
                Register::Status => "no_word (1)".to_owned(),
                // All segments' on one wire.
                Register::C(_, power) if segments > 1 => {
                    let count = ["two", "three"][segments - 2];
                    format!("c{power} of {count} segments ({width})")
                }
                register => format!("{register} ({width})"),
            };
            let times = found.iter().filter(|text| text.words == label).count();
            assert_eq!(times, 1, "{}: {label}", design.config().name);
        }
    }
}

#[test]
fn the_runs_show_what_their_words_say() {
    for design in designs() {
        let ranks = design.datapath().rank_count();
        for scenario in scenario::scenarios(design.datapath()) {
            let samples = &scenario.samples;
            let out = |cycle: usize| samples[cycle].ranks[ranks - 1];
            match scenario.name {
                "run" => assert!((0..4).all(|index| out(ranks + 1 + index) == Some(index))),
                "stall" => {
                    let held = samples.iter().filter(|sample| !sample.in_ready).count();
                    assert_eq!(held, 1 + 3, "the reset and the stall");
                    assert!((1..=4).all(|cycle| out(ranks + cycle) == Some(0)));
                    assert_eq!(out(ranks + 5), Some(1));
                }
                "bubble" => {
                    assert!(samples[1..].iter().all(|sample| sample.in_ready));
                    assert_eq!((out(ranks + 5), out(ranks + 6)), (Some(1), Some(2)));
                }
                _ => {
                    assert!(samples[5].ranks.iter().all(Option::is_none));
                    let results: Vec<_> = (0..samples.len()).filter_map(out).collect();
                    assert_eq!(results, [3]);
                    assert!(scenario.requests[3].result.intensity > 0, "to be told from nothing");
                }
            }
        }
    }
}

/// A page shows the registers of a part that is clicked: every register is one of some part, and no part names another.
#[test]
fn every_register_stands_in_a_part_of_the_block_diagram() {
    for design in designs() {
        let svg = block::block(&design);
        let named = svg.split("data-register=\"").skip(1).filter_map(|rest| rest.split('"').next());
        let named: BTreeSet<&str> = named.flat_map(|names| names.split(' ')).collect();
        let datapath = design.datapath();
        let registers = (0..datapath.rank_count()).flat_map(|rank| datapath.registers(rank));
        let registers: BTreeSet<&str> = registers.map(|register| register.name()).collect();
        assert_eq!(named, registers, "{}", design.config().name);
    }
}

/// The page in HTML has every table row of the Markdown, its pictures, and links that lead to headings inside.
#[test]
fn the_page_in_html_has_what_the_markdown_has() {
    let design = &designs()[0];
    let scenarios = scenario::scenarios(design.datapath());
    let text = page::page(design, &scenarios, "made", "--preset a").unwrap();
    let rows = text.lines().filter(|line| line.starts_with("| ")).count();
    let name = &design.config().name;
    let pictures = vec![(format!("{name}-datapath.svg"), block::block(design))];
    let reference = html::Reference { design, text, pictures };
    let html = html::page(&reference, "# Hardware reference\n\n## Handshake\n\nRules.\n", &[], "made").unwrap();
    assert_eq!(html.matches("<tr>").count(), rows, "rows of tables, headings among them");
    assert_eq!(html.matches("<svg ").count(), 1);
    for link in ["#all-configurations", "#handshake"] {
        assert!(html.contains(&format!("href=\"{link}\"")), "{link}");
    }
}
