//! Certified bounds against what the model fits, against 20 digits of mpmath, and against forgery.

use std::sync::atomic::AtomicU64;

use analysis::approximation::{self, approximation};
use analysis::hardware_claim::certify_hardware;
use blysk_tests::cli::SMALL;
use blysk_tests::reference;
use bounds::certify::certificate::{Certificate, Claim};
use bounds::certify::check::check;
use bounds::certify::claim::{Claims, Enclosure, Finding, Stretch};
use bounds::certify::curve::{Curve, Logs, reciprocal};
use bounds::certify::fault::Fault;
use bounds::certify::hardware::{HardwareClaim, Worst};
use bounds::certify::search::{claim_every_exponent, claim_exponent};
use bounds::interval::{Interval, Slopes};
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::fit::{Levels, Method, fit};
use proptest::prelude::*;

fn exponents() -> impl Strategy<Value = f64> {
    prop_oneof![(0.0_f64..12.0).prop_map(|e| 10.0_f64.powf(e)), (1_u32..=1024).prop_map(f64::from)]
}

fn levels() -> impl Strategy<Value = Levels> {
    prop_oneof![
        Just(Levels::default()),
        (0.1_f64..0.9, 0.05_f64..0.8).prop_map(|(q, part)| Levels::new(q, q * part).unwrap()),
    ]
}

proptest! {
    /// Two formulas, two arithmetics: the enclosures hold what the fit rounds, and are narrow.
    #[test]
    fn coefficients_are_those_of_the_fit(n in exponents(), levels in levels()) {
        for method in [Method::Hermite, Method::ThreePoint, Method::Tangent, Method::Quadratic] {
            let logs = Logs::new(levels);
            let curve = Curve::new(method, Stretch::Epicentre, &logs, reciprocal(n));
            let fitted = fit(method, n, levels).unwrap().cubic().unwrap().centred;
            let own = curve.centred().unwrap();
            let size = [n, n * n, n * n * n];
            for ((own, fitted), size) in own.iter().zip([fitted.k1, fitted.k2, fitted.k3]).zip(size) {
                let (low, high) = (fitted.next_down(), fitted.next_up());
                prop_assert!(own.low() <= high && low <= own.high(), "{method} {n}: {own:?} {fitted}");
                prop_assert!(own.high() - own.low() <= 1e-11 * size, "{method} {n}: {own:?} is wide");
            }
        }
    }

    /// The mean value theorem: f(b) − f(a) is a slope of the box times b − a, for both variables.
    #[test]
    fn slopes_hold_differences(
        which in 0_usize..8, h in 0.0_f64..0.9, sigma in 0.0_f64..3.0, dh in 1e-6_f64..0.1, ds in 1e-6_f64..0.5,
    ) {
        let method = Method::ALL[which];
        // `minimax` has no formula in h.
        prop_assume!(method != Method::Minimax);
        let logs = Logs::new(Levels::default());
        let region = *Stretch::of(method).last().unwrap();
        let exactly = Interval::exactly;
        let at = |h: f64, sigma: f64| {
            Curve::new(method, region, &logs, exactly(h)).value(exactly(sigma))
        };
        let (h_box, sigma_box) = (Interval::new(h, h + dh), Interval::new(sigma, sigma + ds));
        let curve = Curve::new(method, region, &logs, Slopes::<2>::variable(0, h_box));
        let over = curve.value(Slopes::variable(1, sigma_box));
        let meet = |a: Interval, b: Interval| a.low() <= b.high() && b.low() <= a.high();
        let corner = at(h, sigma);
        prop_assert!(meet(over.value, corner));
        let h_step = exactly(h + dh) - exactly(h);
        let sigma_step = exactly(sigma + ds) - exactly(sigma);
        prop_assert!(meet(over.slopes[0] * h_step, at(h + dh, sigma) - corner), "{method} in h");
        prop_assert!(meet(over.slopes[1] * sigma_step, at(h, sigma + ds) - corner), "{method} in σ");
    }

    /// The maxima that the report measures lie within, but for its noise.
    #[test]
    fn enclosures_hold_the_measured_maxima(which in 0_usize..8, n in exponents(), levels in levels()) {
        let method = Method::ALL[which];
        let fitted = fit(method, n, levels).unwrap();
        for &region in Stretch::of(method) {
            let measured = approximation(&fitted, n, match region {
                Stretch::Epicentre => approximation::Extent::epicentre(&fitted),
                Stretch::Tail => approximation::Extent::tail(&fitted),
            });
            let claim = claim_exponent(method, n, region, levels).unwrap();
            let within = |found: &Finding, error: f64| {
                let noise = 1e-14 + 1e-9 * error;
                found.lower() <= error + noise && error <= found.upper() + noise
            };
            prop_assert!(within(&claim.absolute, measured.absolute.error), "{claim:?} {measured:?}");
            if let Some(relative) = &claim.relative {
                prop_assert!(within(relative, measured.relative.unwrap().error), "{claim:?}");
            }
        }
    }
}

/// Every integer to 64, and a few beyond: a relative width of 10⁻⁶, and a certificate that is accepted.
#[test]
fn integer_exponents_are_enclosed_to_a_millionth() {
    let levels = Levels::default();
    let mut claims = Vec::new();
    for method in Method::ALL {
        for &region in Stretch::of(method) {
            for n in (1..=64).chain([255, 256, 257, 1000, 1023, 1024]).map(f64::from) {
                claims.push(claim_exponent(method, n, region, levels).unwrap());
            }
        }
    }
    let mut enclosures = 0;
    for claim in &claims {
        for found in [Some(&claim.absolute), claim.relative.as_ref()].into_iter().flatten() {
            if let Finding::Enclosed(found) = found {
                assert!(found.relative_width() <= 1e-6, "{claim:?}");
                enclosures += 1;
            }
        }
    }
    assert_eq!(enclosures, 17 * 70 - 37);
    let certificate = Certificate::new(Claim::Exponents(Claims { levels, claims }));
    let checked = check(&certificate, &certificate.to_json(), &AtomicU64::new(0)).unwrap();
    assert_eq!(checked.enclosures, 17 * 70);
}

/// Twenty digits, from arithmetic with sixty.
#[test]
fn enclosures_hold_the_table() {
    let mut compared = 0;
    for row in reference::rows() {
        let method: Method = row.method.parse().unwrap();
        for (region, column) in [(Stretch::Epicentre, "epi_abs"), (Stretch::Tail, "tail_abs")] {
            let Some(wanted) = row.value(column) else { continue };
            if !Stretch::of(method).contains(&region) {
                continue;
            }
            let claim = claim_exponent(method, row.exponent, region, Levels::default()).unwrap();
            let (lower, upper) = (claim.absolute.lower(), claim.absolute.upper());
            assert!(lower <= wanted && wanted <= upper, "{wanted} {claim:?}");
            let relative = row.value("epi_rel").zip(claim.relative);
            if let Some((wanted, found)) = relative {
                assert!(found.lower() <= wanted && wanted <= found.upper(), "{wanted} {found:?}");
                compared += 1;
            }
            compared += 1;
        }
    }
    assert!(compared >= 300, "{compared} maxima compared");
}

fn every(method: Method) -> Claim {
    let levels = Levels::default();
    Claim::EveryExponent(Claims { levels, claims: vec![claim_every_exponent(method, levels).unwrap()] })
}

fn single(method: Method, n: f64, region: Stretch) -> Claim {
    let levels = Levels::default();
    let claims = vec![claim_exponent(method, n, region, levels).unwrap()];
    Claim::Exponents(Claims { levels, claims })
}

/// Seals what was altered again, and tells what the content is refused for.
fn fault(claim: Claim) -> Option<Fault> {
    let certificate = Certificate::new(claim);
    let text = certificate.to_json();
    let parsed = Certificate::parse(&text).expect("it is sealed");
    let refused = check(&parsed, &text, &AtomicU64::new(0)).err()?;
    assert_eq!(refused.seal, None, "it is sealed: {refused}");
    refused.content
}

/// The part of a claim that the forgeries below are about.
fn enclosure(claim: &mut Claim) -> &mut Enclosure {
    match claim {
        Claim::EveryExponent(claims) => &mut claims.claims[0].absolute,
        Claim::Exponents(claims) => match &mut claims.claims[0].absolute {
            Finding::Enclosed(found) => found,
            Finding::Exact => panic!("it is enclosed"),
        },
        Claim::Hardware(_) => panic!("it is about a method"),
    }
}

type Forgery = fn(&mut Enclosure);

/// A certificate that is sealed anew is refused for what it says.
#[test]
fn sealed_forgeries_are_refused_for_their_content() {
    let forgeries: [(Forgery, &str); 12] = [
        (|e| e.upper = e.lower * (1.0 + 1e-12), "absolute.upper"),
        (|e| e.upper = e.lower * 0.5, "absolute.lower"),
        (|e| e.lower = e.upper, "absolute.lower"),
        (|e| e.lower = -e.lower, "absolute.lower"),
        (|e| e.lower *= 1.0 + 1e-9, "absolute.lower"),
        (|e| e.witness.sigma *= 0.9, "absolute."),
        (|e| e.witness.sigma = -1e-3, "absolute.witness.sigma"),
        (|e| e.partition = "0".to_owned(), "absolute.upper"),
        (|e| e.partition.truncate(e.partition.len() - 1), "absolute.partition"),
        (|e| e.partition.push('0'), "absolute.partition"),
        (|e| e.partition.replace_range(0..1, "3"), "absolute.partition"),
        (|e| e.witness.h = if e.witness.h.is_some() { None } else { Some(0.5) }, "absolute.witness.h"),
    ];
    for claim in [
        every(Method::Hermite),
        every(Method::ThreePoint),
        single(Method::Hermite, 4.0, Stretch::Epicentre),
        single(Method::Tangent, 2.5, Stretch::Epicentre),
        single(Method::Rational, 64.0, Stretch::Tail),
    ] {
        assert_eq!(fault(claim.clone()), None);
        for (index, (forge, field)) in forgeries.iter().enumerate() {
            let mut forged = claim.clone();
            forge(enclosure(&mut forged));
            let fault = fault(forged).unwrap_or_else(|| panic!("forgery {index} is accepted"));
            assert!(fault.field.contains(field), "forgery {index}: {fault}");
        }
    }
}

#[test]
fn another_subject_or_region_is_refused() {
    let tail = single(Method::Composite, 8.0, Stretch::Tail);
    for far in [None, Some(0.5), Some(1.0), Some(f64::MAX)] {
        let mut forged = tail.clone();
        enclosure(&mut forged).far = far;
        let found = fault(forged).unwrap_or_else(|| panic!("far = {far:?} is accepted"));
        assert!(found.field.contains("absolute."), "{found}");
    }
    let good = single(Method::Hermite, 4.0, Stretch::Epicentre);
    let mut forged = good.clone();
    enclosure(&mut forged).far = Some(1.0);
    assert!(fault(forged).unwrap().field.ends_with("absolute.far"));
    let Claim::Exponents(claims) = &good else { panic!("it is about exponents") };
    let refused = |alter: fn(&mut bounds::certify::claim::ExponentClaim), field: &str| {
        let mut forged = claims.clone();
        alter(&mut forged.claims[0]);
        let found = fault(Claim::Exponents(forged)).expect("it is a forgery");
        assert!(found.field.contains(field), "{found}");
    };
    refused(|claim| claim.n = 5.0, "absolute.");
    refused(|claim| claim.n = 0.5, "n");
    refused(|claim| claim.method = Method::Quadratic, "absolute.");
    refused(|claim| claim.region = Stretch::Tail, "region");
    refused(|claim| claim.absolute = Finding::Exact, "absolute");
    refused(|claim| claim.relative = Some(Finding::Exact), "relative");
    refused(|claim| claim.relative = None, "relative");
    let mut other = claims.clone();
    other.levels = Levels::new(0.4, 0.05).unwrap();
    assert!(fault(Claim::Exponents(other)).is_some());
    let none = Claims { levels: Levels::default(), claims: Vec::new() };
    assert_eq!(fault(Claim::Exponents(none)).unwrap().field, "claims");
}

/// Every digit of a short certificate, and every 13th of a long one, as another digit: the seal alone
/// refuses it.
#[test]
fn the_seal_keeps_every_digit() {
    let long = every(Method::Hermite);
    for (claim, step) in [(every(Method::Schlick), 1), (long, 13)] {
        let text = Certificate::new(claim).to_json();
        assert_eq!(Certificate::parse(&text).unwrap().check_seal(&text), Ok(()));
        let digits = (0..text.len()).filter(|&at| text.as_bytes()[at].is_ascii_digit());
        let mut refused = 0;
        for at in digits.step_by(step) {
            let digit = text.as_bytes()[at] - b'0';
            let mut other = text.clone();
            other.replace_range(at..=at, &((digit + 1) % 10).to_string());
            let accepted = Certificate::parse(&other).is_ok_and(|c| c.check_seal(&other).is_ok());
            assert!(!accepted, "byte {at}");
            refused += 1;
        }
        assert!(refused > 300, "{refused}");
    }
}

type HardwareForgery = fn(&mut HardwareClaim);

#[test]
fn forged_hardware_is_refused() {
    let design = Design::new(Config::from_json(SMALL).unwrap()).unwrap();
    let good = certify_hardware(&design, &AtomicU64::new(0)).unwrap();
    assert_eq!(fault(Claim::Hardware(Box::new(good.clone()))), None);
    // Row 3 (n = 4) is the worst of none of the summaries, so that they stay as they are.
    let forgeries: [(HardwareForgery, &str); 14] = [
        (|c| c.rows[3].epicentre.upper = c.rows[3].epicentre.lower, "epicentre.upper"),
        (|c| c.rows[3].full_range.upper = c.rows[3].full_range.lower, "full_range.upper"),
        (|c| c.rows[3].full_range.lower = c.rows[3].full_range.upper, "full_range.lower"),
        (|c| c.rows[3].epicentre.upper *= 0.999, "epicentre.lower"),
        (|c| c.rows[3].epicentre.x += 1, "epicentre."),
        (|c| c.rows[3].epicentre.x = 1 << 40, "epicentre.x"),
        (|c| c.rows[3].full_range.output += 1, "full_range.output"),
        (
            |c| {
                let (upper, elsewhere) = (c.rows[3].epicentre.upper, c.rows[3].full_range);
                c.rows[3].epicentre = Worst { lower: 1e-9, upper, ..elsewhere };
            },
            "epicentre.x",
        ),
        (|c| c.rows[3].epicentre_from += 1, "epicentre_from"),
        (|c| c.rows[3].n = 4.5, "rows"),
        (|c| c.rows.truncate(7), "rows"),
        (|c| c.points += 1, "points"),
        (|c| c.epicentre.upper = c.epicentre.lower, "epicentre"),
        (|c| c.configuration.q = 0.45, "rows"),
    ];
    for (index, (forge, field)) in forgeries.iter().enumerate() {
        let mut forged = good.clone();
        forge(&mut forged);
        let found = fault(Claim::Hardware(Box::new(forged)));
        let found = found.unwrap_or_else(|| panic!("forgery {index} is accepted"));
        assert!(found.field.contains(field), "forgery {index}: {found}");
    }
}
