//! The figures of a report against every x, by arithmetic that is done here.
//!
//! The intensities are the golden model's. x^n, the epicentre and the maximum are found without it: for
//! integer n from exact integers, x^n = k^n / 2^(f·n) and x^n ≥ 1/2 where 2·k^n ≥ 2^(f·n).

use blysk_tests::bench;
use blysk_tests::cli::{CONFIGURATIONS, csv_rows, number};
use dashu_int::UBig;
use hw_model::config::Config;
use hw_model::design::Design;

use super::report::parts_bound_the_total;

/// What `powf` may be off by where n is no integer.
const POWF: f64 = 1e-15;

/// x^n, and whether it is at least 1/2 (which is Q in the small configurations).
fn power(n: f64, bits: i64, fraction: u32) -> (f64, bool) {
    if n.fract() == 0.0 {
        let power = UBig::from(bits as u64).pow(n as usize);
        let one = UBig::ONE << (fraction as usize * n as usize);
        let above_q = UBig::from(2_u8) * &power >= one;
        // Correctly rounded; the scale is a power of two above the least normal number.
        let scale = (f64::from(fraction) * n).exp2();
        assert!(scale.is_finite());
        return (power.to_f64().value() / scale, above_q);
    }
    let x = bits as f64 / f64::from(fraction).exp2();
    let power = x.powf(n);
    assert!((power - 0.5).abs() > POWF, "n = {n}: cannot tell on which side of q {x} lies");
    (power, power >= 0.5)
}

/// A greatest error and where it is first.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Peak(f64, f64);

impl Peak {
    fn see(&mut self, error: f64, x: f64) {
        if error > self.0 {
            *self = Self(error, x);
        }
    }
}

/// Errors on the epicentre and on all of [0, 1], at every x.
fn every_x(design: &Design, address: u32) -> (Peak, Peak) {
    let (input, output) = (design.config().input, design.config().output);
    let n = design.rom().exponents().as_slice()[address as usize];
    let one = 1_i64 << input.fraction_bits();
    let (mut epicentre, mut all) = (Peak(0.0, 0.0), Peak(0.0, 0.0));
    for bits in 0..=one.min(input.max_bits()) {
        let (power, above_q) = power(n, bits, input.fraction_bits());
        let intensity = design.datapath().evaluate(address, bits).intensity as f64;
        let error = (intensity / f64::from(output.fraction_bits()).exp2() - power).abs();
        let x = bits as f64 / one as f64;
        all.see(error, x);
        if above_q {
            epicentre.see(error, x);
        }
    }
    (epicentre, all)
}

#[test]
fn an_exhaustive_report_is_every_x() {
    let bench = bench!();
    let mut compared = 0;
    for (file, json) in CONFIGURATIONS {
        let design = Design::new(Config::from_json(json).unwrap()).unwrap();
        let text = bench.good(&format!("report --config {file} --exhaustive --bound 1 --format csv --out {file}.out"));
        let rows = csv_rows(&text);
        assert_eq!(rows.len(), design.rom().depth());
        for (address, row) in (0..).zip(&rows) {
            let n = number(row, "n");
            let (epicentre, all) = every_x(&design, address);
            let tolerance = if n.fract() == 0.0 { 0.0 } else { POWF };
            for (peak, error, place) in [(epicentre, "total_abs", "total_x"), (all, "full_range_abs", "full_range_x")] {
                let found = Peak(number(row, error), number(row, place));
                assert!((found.0 - peak.0).abs() <= tolerance, "{file} n = {n}: {found:?} {peak:?}");
                assert_eq!(found.1, peak.1, "{file} n = {n}: {place}");
                compared += 1;
            }
            parts_bound_the_total(row);
        }
        let json: serde_json::Value =
            serde_json::from_slice(&bench.read(&format!("{file}.out/error_vs_n.json"))).unwrap();
        let input = design.config().input;
        let per_row = input.max_bits().min(1 << input.fraction_bits()) + 1;
        assert_eq!(json["samples"], per_row * rows.len() as i64, "{file}");
        assert_eq!(json["exhaustive"], true);
    }
    assert_eq!(compared, 2 * (8 + 5 + 4), "peaks compared");
}

/// Samples are some of the x: they can miss a peak, and not make one up. 14 bits of x are more than
/// a report samples.
#[test]
fn a_sampled_error_is_never_above_the_exhaustive_one() {
    let bench = bench!();
    let mut fewer = 0;
    for (file, json) in CONFIGURATIONS {
        let wide =
            ["Q2.9", "UQ1.10", "UQ0.9"].iter().fold(json.to_owned(), |json, narrow| json.replace(narrow, "UQ1.14"));
        assert_ne!(wide, json);
        bench.write(file, wide);
        let run = |more: &str, out: &str| {
            let command = format!("report --config {file} --bound 1 --format csv --out {out} {more}");
            let rows = csv_rows(&bench.good(&command));
            let json = bench.read(&format!("{out}/error_vs_n.json"));
            let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
            (rows, json["samples"].as_u64().unwrap())
        };
        let (sampled, some) = run("", "some");
        let (exhaustive, all) = run("--exhaustive", "all");
        assert!(some < all, "{file}: {some} of {all} samples");
        assert_eq!(sampled.len(), exhaustive.len());
        for (sampled, exhaustive) in sampled.iter().zip(&exhaustive) {
            for column in ["coefficient_abs", "datapath_abs", "total_abs", "full_range_abs"] {
                let (some, all) = (number(sampled, column), number(exhaustive, column));
                assert!(some <= all, "{file} n = {}: {column} {some} > {all}", sampled["n"]);
                // The corners hold the worst points of the tail and of the polynomial.
                assert!(some >= 0.5 * all, "{file} n = {}: {column} {some} of {all}", sampled["n"]);
                fewer += usize::from(some < all);
            }
            for column in ["approximation_abs", "approximation_rel", "input_abs"] {
                assert_eq!(sampled[column], exhaustive[column]);
            }
        }
    }
    println!("{fewer} sampled figures fall short of the exhaustive ones");
}
