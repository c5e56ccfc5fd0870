//! Designs that the tests share.
#![allow(dead_code, reason = "each test file uses some of them")]

use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::presets;

/// Few enough x that a test can look at all of them: 4 rows, a divider, the power form, signed x.
pub fn small() -> Design {
    design(
        r#"{"name": "small", "method": "hermite", "exponents": "1,2,3.5,8", "input": "Q2.8",
            "output": "UQ1.7", "form": "power", "tail": "rational", "cut": "epicentre",
            "widths": {"t1": "Q5.6"}, "error_budget_ulp": 8}"#,
    )
}

/// The centred form without a tail, and u rounded to fewer bits than x has.
pub fn centred() -> Design {
    design(
        r#"{"name": "centred", "method": "hermite", "exponents": "1..=5", "input": "UQ1.8",
            "output": "UQ1.7", "form": "centred", "tail": "zero", "cut": "minimum",
            "widths": {"u": "UQ2.6"}, "error_budget_ulp": 8}"#,
    )
}

/// An input format that does not reach 1, and the divider everywhere.
pub fn below_one() -> Design {
    design(
        r#"{"name": "below_one", "method": "schlick", "exponents": "2,64", "input": "UQ0.9",
            "output": "UQ0.8", "tail": "rational"}"#,
    )
}

pub fn all_small() -> [Design; 3] {
    [small(), centred(), below_one()]
}

/// A polynomial that dips below 0, rounded to even.
pub fn dips() -> Design {
    design(
        r#"{"name": "dips", "method": "hermite", "exponents": "2,3,9", "input": "Q2.8",
            "output": "UQ1.7", "form": "centred", "tail": "zero", "cut": "minimum",
            "rounding": "nearest_even", "error_budget_ulp": 4}"#,
    )
}

/// A polynomial that rises above 1, rounded towards zero, beside a divider with ranks of three bits.
pub fn rises() -> Design {
    design(
        r#"{"name": "rises", "method": "three_point", "exponents": "2,3,9", "input": "UQ1.9",
            "output": "UQ1.7", "form": "power", "tail": "rational", "cut": "epicentre",
            "rounding": "toward_zero", "quotient_bits_per_stage": 3, "error_budget_ulp": 8}"#,
    )
}

/// More inputs than anyone can go through.
pub fn wide() -> Design {
    design(
        r#"{"name": "wide", "method": "hermite", "exponents": "1,2,64", "input": "UQ1.40",
            "output": "UQ1.15", "form": "centred", "tail": "zero", "cut": "minimum"}"#,
    )
}

/// Designs whose faults the tests can try on every input.
pub fn faulty() -> [Design; 5] {
    [small(), centred(), below_one(), dips(), rises()]
}

pub fn preset(name: &str) -> Design {
    Design::new(presets::find(name).unwrap().config().unwrap()).unwrap()
}

fn design(json: &str) -> Design {
    Design::new(Config::from_json(json).unwrap()).unwrap()
}
