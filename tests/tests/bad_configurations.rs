//! Configurations that cannot be, or only just can: each is refused with words that help, or makes
//! hardware that agrees with the naive model. Never a panic.

use hw_model::config::{Config, Form, Tail};
use hw_model::design::Design;
use hw_model::presets;
use hw_model::rounding::Rounding;
use naive::comparison::{self, Comparison};
use naive::configurations::{self, Random};
use proptest::prelude::*;
use serde_json::{Value, json};

/// A configuration that works, to be spoiled.
fn good() -> Value {
    json!({
        "name": "good", "method": "hermite", "exponents": "1..=8,64", "input": "UQ1.14",
        "output": "UQ1.8", "form": "centred", "tail": "rational", "cut": "epicentre"
    })
}

/// `good` with some fields replaced, and null meaning that the field is left out.
fn spoiled(changes: &Value) -> String {
    let mut config = good();
    let fields = config.as_object_mut().expect("an object");
    for (name, value) in changes.as_object().expect("an object") {
        if value.is_null() {
            fields.remove(name);
        } else {
            fields.insert(name.clone(), value.clone());
        }
    }
    config.to_string()
}

fn made(text: &str) -> Result<Design, String> {
    let config = Config::from_json(text).map_err(|refusal| refusal.to_string())?;
    Design::new(config).map_err(|refusal| refusal.to_string())
}

/// Hardware that was made agrees with the naive model, in a few hundred inputs.
fn agrees(design: &Design) -> u64 {
    let mut random = Random::new(17, 0);
    let depth = design.rom().depth() as u32;
    comparison::rom(design).unwrap_or_else(|complaint| panic!("{complaint}"));
    let mut comparison = Comparison::new(design);
    let mut compared = 0;
    for address in [0, depth / 2, depth - 1, depth] {
        let cut = design.rows().get(address as usize).map_or(0, |row| row.cut);
        let xs = configurations::inputs(&mut random, design.datapath(), cut, 60);
        compared += comparison
            .inputs(address, &xs)
            .unwrap_or_else(|complaint| panic!("{complaint}\n{}", design.config().to_json()));
    }
    compared
}

fn refused(changes: &Value, words: &[&str]) {
    let text = spoiled(changes);
    let message = match made(&text) {
        Ok(_) => panic!("{changes} was not refused"),
        Err(message) => message,
    };
    for word in words {
        assert!(message.contains(word), "{changes}: {word:?} is not in {message:?}");
    }
}

#[test]
fn the_configuration_to_be_spoiled_is_good() {
    assert!(agrees(&made(&good().to_string()).unwrap()) > 200);
}

#[test]
fn text_that_is_no_configuration_is_refused_with_its_place() {
    let good = good().to_string();
    for (text, word) in [
        (String::new(), "line 1"),
        ("{".to_owned(), "line 1"),
        ("[]".to_owned(), "line 1"),
        ("null".to_owned(), "line 1"),
        (good.replace("\"UQ1.8\"", "UQ1.8"), "line 1"),
        (good.replace("\"UQ1.8\"", "NaN"), "expected value"),
        (good.replace('}', ",\"q\":1e999}"), "out of range"),
        (good.replace('}', ",\"q\":NaN}"), "expected value"),
        (good.replace('}', ",\"q\":Infinity}"), "expected value"),
        (good.replace('}', ",\"name\":\"again\"}"), "duplicate field `name`"),
        (good.clone() + "{}", "trailing"),
        (good.replace('}', ""), "EOF"),
    ] {
        let message = Config::from_json(&text).unwrap_err().to_string();
        assert!(message.contains(word), "{text}: {message}");
    }
    assert!(Config::from_json(&"[".repeat(100_000)).is_err());
}

#[test]
fn fields_that_cannot_be_used_are_named() {
    for (changes, words) in [
        (json!({"colour": 1}), vec!["unknown field `colour`", "exponents"]),
        (json!({"widths": {"t4": "Q1.2"}}), vec!["unknown field `t4`", "t1"]),
        (json!({"method": null}), vec!["missing field `method`"]),
        (json!({"exponents": null}), vec!["missing field `exponents`"]),
        (json!({"name": ""}), vec!["`name`", "letters"]),
        (json!({"name": "../x"}), vec!["`name`", "letters"]),
        (json!({"method": "cubic"}), vec!["cubic", "hermite", "schlick"]),
        (json!({"method": "composite"}), vec!["`method`", "hermite", "\"tail\": \"rational\""]),
        (json!({"method": "rational"}), vec!["`method`", "schlick"]),
        (json!({"method": "schlick", "tail": "zero"}), vec!["`tail`", "rational"]),
        (json!({"cut": "minimum"}), vec!["`cut`", "epicentre"]),
        (json!({"form": "centered"}), vec!["centered", "centred"]),
        (json!({"widths": {"cut": "Q1.4"}}), vec!["`widths.cut`", "give an unsigned format"]),
        (json!({"widths": {"cut": "UQ1.40"}}), vec!["`widths.cut`", "no more fraction bits"]),
        (json!({"widths": {"cut": "UQ2.2"}}), vec!["`widths.cut`", "at most one integer bit"]),
        (json!({"widths": {"hand_over": "UQ1.2"}}), vec!["`widths.hand_over`", "two segments"]),
        (json!({"rounding": "up"}), vec!["up", "nearest_up", "toward_zero"]),
        (json!({"q": "half"}), vec!["string \"half\"", "f64"]),
        (json!({"q": 1.0}), vec!["`q, g`", "q = 1", "0 < g < q < 1"]),
        (json!({"q": 1.5}), vec!["`q, g`", "0 < g < q < 1"]),
        (json!({"q": 0.0}), vec!["`q, g`", "0 < g < q < 1"]),
        (json!({"q": -0.5}), vec!["`q, g`", "0 < g < q < 1"]),
        (json!({"q": 0.05}), vec!["`q, g`", "g = 0.05555", "0 < g < q < 1"]),
        (json!({"q": 0.3, "g": 0.3}), vec!["`q, g`", "0 < g < q < 1"]),
        (json!({"g": 0.0}), vec!["`q, g`", "g = 0", "0 < g < q < 1"]),
        (json!({"g": 1e-320}), vec!["`q, g`", "0 < g < q < 1"]),
        (json!({"exponents": ""}), vec!["missing", "1..=256"]),
        (json!({"exponents": []}), vec!["expected a string"]),
        (json!({"exponents": "0.999"}), vec!["0.999", "from 1 to 1e15"]),
        (json!({"exponents": "0"}), vec!["0", "from 1 to 1e15"]),
        (json!({"exponents": "-3"}), vec!["-3", "from 1 to 1e15"]),
        (json!({"exponents": "NaN"}), vec!["NaN", "from 1 to 1e15"]),
        (json!({"exponents": "inf"}), vec!["inf", "from 1 to 1e15"]),
        (json!({"exponents": "1e16"}), vec!["1e16", "from 1 to 1e15"]),
        (json!({"exponents": "8,4"}), vec!["4 follows 8", "increasing"]),
        (json!({"exponents": "4,4"}), vec!["4", "twice"]),
        (json!({"exponents": "1..=1e9"}), vec!["65536 exponents"]),
        (json!({"input": "1.14"}), vec!["1.14", "Qm.n", "UQ1.15"]),
        (json!({"input": "Q-3.2"}), vec!["Q-3.2", "-1 bits", "1 to 63"]),
        (json!({"input": "UQ1.63"}), vec!["UQ1.63", "64 bits", "1 to 63"]),
        (json!({"input": "UQ4.0"}), vec!["`input`", "UQ1.n"]),
        (json!({"input": "Q0.8"}), vec!["`input`", "Q2.n"]),
        (json!({"input": "UQ-2.8"}), vec!["`input`", "UQ1.n"]),
        (json!({"input": "UQ0.63"}), vec!["`input`", "62"]),
        (json!({"output": "Q1.15"}), vec!["`output`", "unsigned"]),
        (json!({"output": "UQ2.0"}), vec!["`output`", "UQ1.n"]),
        (json!({"output": "UQ-1.8"}), vec!["`output`", "UQ1.n"]),
        (json!({"output": "UQ0.63"}), vec!["`output`", "62"]),
        (json!({"quotient_bits_per_stage": 0}), vec!["`quotient_bits_per_stage`", "1 to 8"]),
        (json!({"quotient_bits_per_stage": 9}), vec!["`quotient_bits_per_stage`", "1 to 8"]),
        (json!({"quotient_bits_per_stage": -1}), vec!["-1", "u32"]),
        (json!({"quotient_bits_per_stage": 2.5}), vec!["2.5", "u32"]),
        (json!({"multiplier_operand_bits": 7}), vec!["`multiplier_operand_bits`", "8 to 63"]),
        (json!({"multiplier_operand_bits": 64}), vec!["`multiplier_operand_bits`", "8 to 63"]),
        (
            json!({"multiplier_operand_bits": 9, "output": "UQ1.15"}),
            vec!["cannot be kept", "multiplier_operand_bits", "n = "],
        ),
        (
            json!({"multiplier_operand_bits": 10, "widths": {"t1": "UQ3.9"}}),
            vec!["t1", "UQ3.9", "12 bits", "multiplier_operand_bits = 10"],
        ),
        (json!({"error_budget_ulp": 0.0}), vec!["`error_budget_ulp`", "above 0"]),
        (json!({"error_budget_ulp": -1.0}), vec!["`error_budget_ulp`", "above 0"]),
        (json!({"error_budget_ulp": 1e7}), vec!["`error_budget_ulp`", "1e6"]),
        (json!({"form": "power", "widths": {"u": "UQ1.8"}}), vec!["`widths.u`", "centred"]),
        (json!({"tail": "zero", "widths": {"divisor": "UQ10.10"}}), vec!["`widths`", "no divider", "rational"]),
        (
            json!({"method": "schlick", "tail": "rational", "widths": {"t1": "UQ1.8"}}),
            vec!["`widths`", "no polynomial", "t1"],
        ),
    ] {
        refused(&changes, &words);
    }
}

#[test]
fn a_struct_is_checked_like_a_file() {
    let spoil = |change: fn(&mut Config)| {
        let mut config = configurations::plain();
        change(&mut config);
        Design::new(config).unwrap_err().to_string()
    };
    for (message, word) in [
        (spoil(|config| config.q = f64::NAN), "0 < g < q < 1"),
        (spoil(|config| config.g = f64::NAN), "0 < g < q < 1"),
        (spoil(|config| config.q = f64::INFINITY), "0 < g < q < 1"),
        (spoil(|config| config.error_budget_ulp = f64::NAN), "`error_budget_ulp`"),
        (spoil(|config| config.error_budget_ulp = f64::INFINITY), "`error_budget_ulp`"),
        (spoil(|config| config.quotient_bits_per_stage = u32::MAX), "1 to 8"),
        (spoil(|config| config.name = "a/b".to_owned()), "`name`"),
    ] {
        assert!(message.contains(word), "{message}");
    }
}

#[test]
fn a_budget_that_cannot_be_kept_says_what_is_reached_where() {
    for (changes, words) in [
        // Rounding down loses up to one output ulp in the last line alone.
        (
            json!({"rounding": "floor", "error_budget_ulp": 1.0}),
            vec!["budget of 1 ulp cannot be kept", "n = ", "round to nearest"],
        ),
        (json!({"error_budget_ulp": 0.4}), vec!["budget of 0.4 ulp cannot be kept", "n = ", "raise error_budget_ulp"]),
        (
            json!({"widths": {"t2": "UQ1.7"}, "error_budget_ulp": 0.9}),
            vec!["cannot be kept", "stated widths", "n = ", "allow wider formats"],
        ),
        (
            json!({"form": "power", "exponents": "1e15"}),
            vec!["cannot be kept", "generous widths", "n = 1000000000000000"],
        ),
        (
            json!({"form": "power", "exponents": "2000000", "input": "UQ1.23", "output": "UQ1.15"}),
            vec!["cannot be kept", "generous widths", "n = 2000000"],
        ),
        (
            json!({"method": "schlick", "exponents": "1e15", "output": "UQ1.15"}),
            vec!["cannot be kept", "divider", "n = 1000000000000000"],
        ),
    ] {
        refused(&changes, &words);
    }
}

#[test]
fn a_stated_width_that_could_overflow_names_register_exponent_and_need() {
    for (register, narrow) in [
        ("u", "UQ-2.12"),
        ("c3", "UQ-8.12"),
        ("c2", "UQ-8.12"),
        ("c1", "UQ0.12"),
        ("c0", "UQ0.12"),
        ("t1", "UQ-8.14"),
        ("t2", "UQ0.14"),
        ("tail_a", "UQ3.14"),
        ("tail_b", "UQ3.14"),
        ("divisor", "UQ3.14"),
    ] {
        let stated = format!("stated as {narrow}");
        let words = [register, &stated, "could overflow at n = ", "it needs", "its values reach"];
        refused(&json!({"widths": {register: narrow}}), &words);
    }
    refused(
        &json!({"method": "minimax", "tail": "zero", "segments": 2, "widths": {"hand_over": "UQ0.2"}}),
        &["register hand_over", "stated as UQ0.2", "could overflow at n = ", "it needs UQ1.2"],
    );
    refused(
        &json!({"input": "UQ1.20", "output": "UQ1.8", "widths": {"divisor": "UQ10.10"}}),
        &["register divisor", "stated as UQ10.10", "needs 11 fraction bits"],
    );
}

/// Hardware too wide for 63 bits names the register and the exponent.
#[test]
fn what_needs_more_than_63_bits_is_refused() {
    for (changes, words) in [
        (
            json!({"method": "schlick", "exponents": "1", "output": "UQ1.62", "error_budget_ulp": 1e6}),
            vec!["register digits", "n = 1", "64 bits"],
        ),
        (json!({"q": 1e-30, "g": 1e-40, "exponents": "100", "error_budget_ulp": 1e6}), vec!["n = 100", "bits"]),
    ] {
        refused(&changes, &words);
    }
}

/// What is at the edge of the legal either agrees with the naive model or is refused by name.
#[test]
fn the_narrowest_and_the_widest_make_hardware_that_agrees() {
    let (mut made_count, mut compared, mut refusals) = (0, 0, Vec::new());
    for changes in [
        json!({"input": "UQ0.1", "exponents": "1..=4"}),
        json!({"input": "UQ1.1", "output": "UQ1.1"}),
        json!({"input": "Q1.1", "output": "UQ0.1", "exponents": "1..=4"}),
        json!({"output": "UQ0.1"}),
        json!({"output": "UQ0.2", "rounding": "floor", "error_budget_ulp": 1.5}),
        // Segments that are rounded away, and a u with more bits than x.
        json!({"method": "minimax", "tail": "zero", "cut": "balanced", "exponents": "5,400", "input": "UQ1.12",
               "widths": {"u": "UQ1.16", "cut": "UQ1.4"}}),
        json!({"method": "minimax", "tail": "zero", "segments": 2, "exponents": "40", "input": "UQ1.12",
               "widths": {"u": "UQ1.20", "cut": "UQ1.2", "hand_over": "UQ1.2"}}),
        json!({"input": "UQ1.62"}),
        json!({"input": "UQ1.62", "form": "power"}),
        json!({"input": "Q2.61", "tail": "zero", "cut": "minimum"}),
        json!({"input": "UQ0.62"}),
        json!({"input": "Q62.1"}),
        json!({"input": "UQ61.2", "output": "UQ60.3"}),
        json!({"input": "UQ1.62", "method": "schlick"}),
        json!({"method": "schlick", "exponents": "1,2", "output": "UQ1.61", "error_budget_ulp": 1e6}),
        json!({"tail": "zero", "method": "quadratic", "exponents": "2", "output": "UQ1.62",
               "error_budget_ulp": 1e6}),
        json!({"exponents": "1e15"}),
        json!({"exponents": "1e15", "input": "UQ1.60", "tail": "zero"}),
        json!({"exponents": "1,1e15", "tail": "zero", "cut": "minimum"}),
        json!({"exponents": "1"}),
        json!({"exponents": "1.0000000000000002"}),
        json!({"q": 0.999_999}),
        json!({"q": 0.999_999_999_999}),
        json!({"q": 1e-6, "g": 1e-9}),
        json!({"method": "three_point", "q": 0.5, "g": 0.499_999_999_999_999_94}),
        json!({"quotient_bits_per_stage": 1}),
        json!({"quotient_bits_per_stage": 8}),
        // A budget so large that the ratio passes 1, and one that the widths never use up.
        json!({"exponents": "7", "method": "tangent", "form": "power", "error_budget_ulp": 1e6}),
        json!({"q": 0.99, "error_budget_ulp": 40.0}),
        // Operands with few bits, all of them far behind the point: more are dropped than a narrow lane has.
        json!({"exponents": "1", "form": "power", "tail": "zero", "input": "UQ1.40",
               "widths": {"c3": "UQ-62.63", "c2": "UQ-62.63"}}),
        json!({"widths": {"u": "UQ2.40", "t1": "Q2.50", "t2": "Q3.50"}}),
    ] {
        match made(&spoiled(&changes)) {
            Ok(design) => {
                made_count += 1;
                compared += agrees(&design);
            }
            Err(message) => refusals.push(format!("{changes}: {message}")),
        }
    }
    println!("{made_count} designs, {compared} inputs");
    assert!(refusals.is_empty(), "{refusals:#?}");
    assert!(made_count >= 25 && compared > 5000, "{made_count} {compared}");
}

#[test]
fn a_configuration_comes_back_from_its_own_json() {
    let mut random = Random::new(23, 0);
    for _ in 0..2000 {
        let config = configurations::random(&mut random);
        // A method without its tail is refused by name, not read differently.
        if let Ok(back) = Config::from_json(&config.to_json()) {
            assert_eq!(back, config);
        } else {
            assert!(config.check().is_err(), "{}", config.to_json());
        }
    }
}

fn any_format() -> impl Strategy<Value = Value> {
    (any::<bool>(), -5_i32..70, -3_i32..70).prop_map(|(signed, integer, fraction)| {
        json!(format!("{}{integer}.{fraction}", if signed { "Q" } else { "UQ" }))
    })
}

fn any_value() -> impl Strategy<Value = Value> {
    let numbers = [0.0, -1.0, 0.5, 1.0, 2.0, 1e-300, 1e300, 1e6, 0.999_999, 1e-6, 17.0, 1e-9];
    let words = [
        "hermite",
        "three_point",
        "tangent",
        "quadratic",
        "rational",
        "schlick",
        "power",
        "centred",
        "zero",
        "minimum",
        "epicentre",
        "floor",
        "nearest_even",
        "toward_zero",
        "1,2,1e15",
        "1",
        "2.5,3.5",
        "1e9",
        "1e4,1e6",
        "3..=1",
        "",
        "..",
        "1..=",
    ];
    prop_oneof![
        4 => any_format(),
        2 => prop::sample::select(numbers.to_vec()).prop_map(|number| json!(number)),
        1 => (0.0_f64..2.0).prop_map(|number| json!(number)),
        1 => (0_u64..12).prop_map(|number| json!(number)),
        3 => prop::sample::select(words.to_vec()).prop_map(|word| json!(word)),
        1 => ".{0,12}".prop_map(|text| json!(text)),
        1 => prop::sample::select(vec![json!(null), json!(true), json!([]), json!({}), json!([1])]),
    ]
}

const FIELDS: [&str; 25] = [
    "name",
    "method",
    "exponents",
    "input",
    "output",
    "description",
    "q",
    "g",
    "form",
    "tail",
    "cut",
    "rounding",
    "quotient_bits_per_stage",
    "error_budget_ulp",
    "u",
    "c3",
    "c2",
    "c1",
    "c0",
    "t1",
    "t2",
    "tail_a",
    "divisor",
    "hand_over",
    "surprise",
];

/// Sets or removes a field; the names after `error_budget_ulp` live in `widths`.
fn mutate(config: &mut Value, field: &str, value: Value, remove: bool) {
    let widths =
        !matches!(field, "surprise") && FIELDS.iter().position(|name| *name == field).is_some_and(|place| place >= 14);
    let Some(mut fields) = config.as_object_mut() else { return };
    if widths {
        let nested = fields.entry("widths").or_insert_with(|| json!({}));
        let Some(nested) = nested.as_object_mut() else { return };
        fields = nested;
    }
    if remove {
        fields.remove(field);
    } else {
        fields.insert(field.to_owned(), value);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, ..ProptestConfig::default() })]

    #[test]
    fn no_mutation_of_a_preset_panics(
        preset in prop::sample::select(presets::ALL.to_vec()),
        mutations in prop::collection::vec(
            (prop::sample::select(FIELDS.to_vec()), any_value(), prop::bool::weighted(0.08)), 0..4
        ),
    ) {
        let mut config: Value = serde_json::from_str(preset.json).unwrap();
        // Few exponents, so that thousands of designs are derived in seconds.
        config["exponents"] = json!("1..=3,7.5,64,256");
        for (field, value, remove) in mutations {
            mutate(&mut config, field, value, remove);
        }
        match made(&config.to_string()) {
            Ok(design) => prop_assert!(agrees(&design) > 50),
            Err(message) => prop_assert!(message.len() > 10, "{}", message),
        }
    }

    #[test]
    fn no_spoiled_text_panics(
        preset in prop::sample::select(presets::ALL.to_vec()),
        at in any::<prop::sample::Index>(), insert in ".{0,3}", removed in 0_usize..4,
    ) {
        let mut characters: Vec<char> = preset.json.chars().collect();
        let at = at.index(characters.len());
        let end = (at + removed).min(characters.len());
        characters.splice(at..end, insert.chars());
        let text: String = characters.into_iter().collect();
        if let Ok(config) = Config::from_json(&text) {
            prop_assert_eq!(Config::from_json(&config.to_json()).unwrap(), config);
        }
    }
}

/// The refusals counted by the random comparison are errors of these kinds and no others.
#[test]
fn every_combination_of_small_choices_is_hardware_or_a_named_refusal() {
    let (mut hardware, mut refusals) = (0, 0);
    for method in configurations::METHODS {
        for form in [Form::Power, Form::Centred] {
            for tail in [Tail::Zero, Tail::Rational] {
                for rounding in Rounding::ALL {
                    for budget in [0.45, 0.55, 1.0, 2.0, 1e6] {
                        for (input, output) in [("UQ0.3", "UQ0.1"), ("Q2.9", "UQ1.12")] {
                            let mut config = configurations::plain();
                            config.method = method;
                            config.form = form;
                            config.tail = tail;
                            config.rounding = rounding;
                            config.error_budget_ulp = budget;
                            config.input = input.parse().unwrap();
                            config.output = output.parse().unwrap();
                            config.exponents = "1,2,3,5.5".parse().unwrap();
                            match Design::new(config) {
                                Ok(design) => {
                                    hardware += 1;
                                    agrees(&design);
                                }
                                Err(refusal) => {
                                    refusals += 1;
                                    let message = refusal.to_string();
                                    assert!(
                                        message.contains("`tail`") || message.contains("ulp cannot be kept"),
                                        "{message}"
                                    );
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    println!("{hardware} designs, {refusals} refusals");
    assert!(hardware > 300 && refusals > 100, "{hardware} {refusals}");
}
