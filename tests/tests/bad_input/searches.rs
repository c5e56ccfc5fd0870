//! Searches for hardware and for ROM integers that cannot begin.

use blysk_tests::bench;

#[test]
fn a_design_that_would_be_too_fine_or_never_end() {
    let bench = bench!();
    // An error of 0.01 is less than 2.5e5 ulp of 24 fraction bits, and more of 25.
    bench.refused(
        "design --exponents 1..=8 --input UQ1.10 --output UQ1.30 --error 0.01 --out new.json",
        &["--output", "UQ1.30", "at most 24 fraction bits"],
    );
    // 2^24 x and more for each of 2048 exponents.
    bench.refused(
        "design --exponents 1..=2048 --input UQ1.24 --output UQ1.15 --error 0.01 --out new.json",
        &["samples", "17179869184", "narrower --input", "fewer --exponents"],
    );
}

#[test]
fn a_refinement_of_nothing() {
    let bench = bench!();
    bench.refused("refine --preset schlick --out new.json", &["schlick", "no polynomial", "coefficients"]);
    bench.refused("refine --config small.json --exponents 9 --out new.json", &["n = 9", "1..=8"]);
    for reach in ["-1", "257"] {
        bench.refused(
            &format!("refine --config small.json --reach {reach} --out new.json"),
            &["--reach", reach, "0..=256"],
        );
    }
}
