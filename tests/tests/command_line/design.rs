//! `blysk design`: what is written keeps the error, and every witness says why no bit can be spared. All of it
//! is tried here again, through designs made from the written configuration.

use std::collections::BTreeMap;

use blysk_tests::bench;
use blysk_tests::cli::{Bench, csv_rows, number};
use hw_model::config::Config;
use hw_model::datapath::Signals;
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::highlight::phong;
use hw_model::registers::Register;

const ASKED: [(&str, f64); 10] = [
    ("--exponents 1..=12 --input UQ1.10 --output UQ1.10 --error 0.0067 --range all", 0.0067),
    ("--exponents 2,5,8.5,16 --input UQ1.10 --output UQ1.8 --error 0.008 --range epicentre", 0.008),
    ("--exponents 1..=8 --input UQ0.9 --output UQ0.9 --error 0.02 --range 0.1", 0.02),
    ("--exponents 1..=6 --input UQ1.10 --output UQ1.8 --error 0.2", 0.2),
    // A cut in fewer bits, far below where the fit ends.
    ("--exponents 40 --input UQ1.10 --output UQ1.8 --error 0.02", 0.02),
    ("--exponents 3,30 --input UQ1.8 --output UQ1.10 --error 0.03", 0.03),
    // Cuts in fewer bits, down at 0: then the polynomial waits for no x, or only for one below 0.
    ("--exponents 1..=6 --input UQ0.9 --output UQ0.9 --error 0.004 --range 0.1", 0.004),
    ("--exponents 1.1,1.9 --input Q1.6 --output UQ1.8 --error 0.03", 0.03),
    // A second segment without an x, and a row without one in the range.
    ("--exponents 7,300 --input UQ1.6 --output UQ1.8 --error 0.1", 0.1),
    ("--exponents 1.5,100 --input UQ0.9 --output UQ1.8 --error 0.2 --range 0.9", 0.2),
];

/// Prints the witnesses and writes the configuration.
fn designed(bench: &Bench, asked: &str) -> (Design, Vec<BTreeMap<String, String>>) {
    let text = bench.good(&format!("design {asked} --out designed.json --format csv"));
    let config = Config::from_json(&bench.text("designed.json")).unwrap();
    (Design::new(config).unwrap(), csv_rows(&text))
}

fn error(design: &Design, address: u32, x: i64) -> f64 {
    let config = design.config();
    let shown = design.datapath().passage(address, x).last().unwrap().intensity as f64;
    let n = design.rows()[address as usize].exponent;
    (shown * config.output.ulp() - phong(n, x as f64 * config.input.ulp())).abs()
}

/// Every x where x^n is at least the level.
fn worst(design: &Design, level: f64) -> f64 {
    let input = design.config().input;
    let greatest = design.datapath().front_end().greatest;
    let mut worst = 0.0_f64;
    for (address, row) in (0..).zip(design.rows()) {
        for x in 0..=greatest {
            if phong(row.exponent, x as f64 * input.ulp()) >= level {
                worst = worst.max(error(design, address, x));
            }
        }
    }
    worst
}

fn level(asked: &str) -> f64 {
    match asked.split_once("--range ").map(|(_, range)| range) {
        Some("epicentre") => 0.5,
        Some("all") | None => 0.0,
        Some(level) => level.parse().unwrap(),
    }
}

#[test]
fn the_error_is_kept_at_every_x() {
    let bench = bench!();
    for (asked, allowed) in ASKED {
        let (design, _) = designed(&bench, asked);
        let worst = worst(&design, level(asked));
        assert!(worst <= allowed && worst > 0.3 * allowed, "{asked}: {worst}");
    }
}

/// What a register holds after the front end; of a coefficient and of a hand-over those of every segment in the fetched
/// word.
fn held(register: &str, passage: &[Signals]) -> Vec<i64> {
    let fetched = |name| passage[0].row.get(name);
    let named = if register == "u" { Register::V } else { Register::named(register).unwrap() };
    match named {
        Register::V => vec![passage[1].v],
        Register::T(stage) => vec![passage[stage + 1].t[stage - 1]],
        Register::Divisor => vec![passage[2].division.divisor],
        Register::C(_, power) => (0..8).map(|segment| fetched(Register::C(segment, power))).collect(),
        Register::HandOver(_) => (1..8).map(|segment| fetched(Register::HandOver(segment))).collect(),
        field => vec![passage[1].row.get(field)],
    }
}

/// Where a witness is to be looked at: its row, or an address without a word.
fn asked_of(design: &Design, row: &BTreeMap<String, String>) -> (u32, i64) {
    match row["n"].as_str() {
        "" => (design.rom().depth() as u32, 0),
        _ => (design.rom().address_of(number(row, "n")), number(row, "x_bits") as i64),
    }
}

/// The design with a fraction bit less in a register (or none), and integer bits enough in all of them.
fn with_room(design: &Design, register: Option<&str>) -> Design {
    let with = |room: i32| {
        let mut config = serde_json::to_value(design.config()).unwrap();
        config["error_budget_ulp"] = 1e6.into();
        for (name, format) in config["widths"].as_object_mut().unwrap() {
            let own: QFormat = format.as_str().unwrap().parse().unwrap();
            let less = u32::from(register == Some(name));
            let fraction = own.fraction_bits() - less;
            let roomy = match name.as_str() {
                "cut" | "hand_over" => QFormat::unsigned(1, fraction).unwrap(),
                _ => QFormat::signed(own.integer_bits() + room, fraction).unwrap(),
            };
            *format = roomy.to_string().into();
        }
        Design::new(Config::from_json(&config.to_string()).unwrap())
    };
    // An end in fewer bits can change a shift, and with it the coefficients.
    with(3).or_else(|_| with(16)).unwrap()
}

#[test]
fn every_witness_testifies() {
    let bench = bench!();
    let (mut errors, mut overflows) = (0, 0);
    for (asked, allowed) in ASKED {
        let (design, rows) = designed(&bench, asked);
        let stated = serde_json::to_value(design.widths()).unwrap();
        let stated = stated.as_object().unwrap();
        let (rows, following): (Vec<_>, Vec<_>) =
            rows.into_iter().partition(|row| stated.contains_key(&row["register"]));
        assert_eq!(rows.len(), 2 * stated.len(), "{asked}: two for each register");
        follow(&design, &following);
        for row in &rows {
            let (register, fraction) = (row["register"].as_str(), row["fewer"] == "fraction");
            assert_eq!(stated[register], row["format"], "{row:?}");
            if row["n"].is_empty() && row["overflows"].is_empty() {
                // Only a bit that is not there needs no witness, or one of the divider's that has to be.
                let own: QFormat = row["format"].parse().unwrap();
                let divider = ["tail_a", "tail_b", "divisor"].contains(&register);
                // Or that would make the ROM wider: the same integer in every row takes no place in it.
                let rom = row["rom_bits"].parse().is_ok_and(|bits: u64| bits > design.rom().bits());
                let none = own.fraction_bits() == 0 || own.width() == 1;
                assert!(none || divider || rom, "{row:?}");
                continue;
            }
            let narrower = with_room(&design, fraction.then_some(register));
            let (address, x) = asked_of(&narrower, row);
            if row["overflows"].is_empty() {
                let error = error(&narrower, address, x);
                assert_eq!(error, number(row, "error"), "{row:?}");
                assert!(fraction && error > allowed, "{row:?}");
                errors += 1;
            } else {
                let passage = narrower.datapath().passage(address, x);
                let bits = number(row, "bits") as i64;
                assert!(held(&row["overflows"], &passage).contains(&bits), "{row:?}");
                let format: QFormat = row["in_format"].parse().unwrap();
                let own: QFormat = row["format"].parse().unwrap();
                let alone = own.width() == 1 && format == own;
                assert!(alone || !format.holds(bits.into()), "{row:?}");
                overflows += 1;
            }
        }
    }
    assert!(errors > 15 && overflows > 15, "{errors} errors, {overflows} overflows");
}

/// The last stage's result, whose last place is the output's, and the shifts, which are counts: their first bits are
/// needed.
fn follow(design: &Design, rows: &[BTreeMap<String, String>]) {
    let datapath = design.datapath();
    let last =
        datapath.formats().polynomial.as_ref().map(|formats| (Register::T(formats.degree()), formats.last(), "output"));
    let shifts = (0..datapath.segment_count()).filter_map(|segment| {
        let register = Register::Shift(segment);
        Some((register, design.rom().layout().field(register)?.format, ""))
    });
    let expected: Vec<(Register, QFormat, &str)> = last.into_iter().chain(shifts).collect();
    assert_eq!(rows.len(), 2 * expected.len(), "{rows:?}");
    for (pair, (register, format, place)) in rows.chunks(2).zip(expected) {
        let [last, first] = pair else { panic!("two for each") };
        let name = register.name();
        assert_eq!((last["register"].as_str(), last["asked_by"].as_str()), (name, place));
        assert_eq!((first["register"].as_str(), &first["format"]), (name, &format.to_string()));
        if first["n"].is_empty() && first["overflows"].is_empty() {
            // All rows have a 0 there, or the range that was proved is wider than what is taken.
            assert!(matches!(register, Register::T(_)) || format.width() == 1, "{first:?}");
            continue;
        }
        let (address, x) = asked_of(design, first);
        let passage = datapath.passage(address, x);
        let bits = match register {
            Register::T(stage) => passage[stage + 1].t[stage - 1],
            shift => passage[0].row.get(shift),
        };
        let less: QFormat = first["in_format"].parse().unwrap();
        assert_eq!(bits as f64, number(first, "bits"), "{first:?}");
        assert!(!less.holds(bits.into()) || less == format && bits != 0, "{first:?}");
    }
}

#[test]
fn the_ranking_says_what_was_considered_and_why_not() {
    let bench = bench!();
    let (asked, _) = ASKED[0];
    let text = bench.good(&format!("design {asked}"));
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    for word in ["hermite", "three_point", "tangent", "quadratic", "minimax", "schlick"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    for word in ["too far", "proved", "narrowed", "multiplier bits", "a bit less"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert_eq!(text, bench.good(&format!("design {asked}")));
}

#[test]
fn what_cannot_be_had_is_refused() {
    let bench = bench!();
    bench.refused(
        "design --exponents 100 --input UQ0.9 --output UQ1.8 --error 0.3 --range 0.9 --out x.json",
        &["no exponent has an x in the range", "UQ0.9", "larger range"],
    );
    let design = "design --exponents 1..=8 --input UQ1.10 --out x.json";
    bench.refused(
        &format!("{design} --output UQ1.10 --error 0.0001"),
        &["nothing keeps an error of 0.0001", "minimax", "allow more"],
    );
    bench.refused(&format!("{design} --output Q1.10 --error 0.01"), &["`output`", "unsigned"]);
    bench.refused(&format!("{design} --output UQ1.8 --error 2"), &["--error", "at most 1"]);
    bench.refused(&format!("{design} --output UQ1.8 --error 0.01 --range 1.5"), &["--range", "epicentre"]);
}

/// The one that is printed is marked in the ranking, and the configuration has a name after what was asked.
#[test]
fn the_chosen_one_is_marked_and_named() {
    let bench = bench!();
    let text = bench.good("design --exponents 1..=8 --input UQ1.10 --output UQ1.10 --error 0.01 --out new.json");
    let chosen: Vec<&str> = text.lines().filter(|line| line.ends_with("CHOSEN")).collect();
    assert_eq!(chosen.len(), 1, "{text}");
    assert_eq!(text.lines().nth(1), Some(chosen[0]), "{text}");
    let config = Config::from_json(&bench.text("new.json")).unwrap();
    assert_eq!(config.name, "designed_UQ1p10_UQ1p10_0p01");
    assert!(chosen[0].starts_with(&config.method.to_string()), "{text}");
    let bits = chosen[0].split_whitespace().rev().nth(3).unwrap();
    let flat = text.replace('\n', " ");
    assert!(flat.contains(&format!(": {bits} multiplier bits, ")), "{bits}: {text}");
    for column in
        text.lines().next().unwrap().split_whitespace().filter(|word| !["method", "form", "verdict"].contains(word))
    {
        assert!(flat.contains(&format!("{column}: ")) || flat.contains(&format!("{column}, ")), "{column}: {text}");
    }
}
