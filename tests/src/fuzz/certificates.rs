//! Certificates: what is accepted, altered or not, must be true by other means than the checker's.
//!
//! An altered certificate is tried as it is, and once more sealed again, as an attacker would who wants it believed.
//! Truth is found without intervals, runs or blocks: real errors in f64 for methods, and every x through the data path
//! by the scalar way for hardware. What is too much work for one run is left out.

use std::sync::atomic::AtomicU64;

use analysis::approximation::{Extent as Interval, approximation};
use bounds::certify::certificate::{Certificate, Claim};
use bounds::certify::check::check;
use bounds::certify::claim::{ExponentClaim, Finding, Stretch};
use bounds::certify::hardware::{HardwareClaim, Worst};
use hw_model::config::Config;
use hw_model::datapath::Status;
use hw_model::design::Design;
use hw_model::fit::{Levels, fit};
use hw_model::highlight::phong;
use hw_model::quantise::real;
use scenes::render::Codes;
use scenes::scene::Image;
use scenes::specialise::{self, Asked, Certificate as Specialised, Part, Proved, Refused, Served};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use vectors::checksum::checksum;

use super::{Outcome, Place};

/// Inputs (x times rows) that a run goes through.
const MOST_POINTS: u64 = 1 << 14;
/// Claims about methods that a run looks at.
const MOST_CLAIMS: usize = 8;
/// What rounding may do to an error that was computed in f64, as a share of it and beside it.
const SLACK: (f64, f64) = (1e-6, 1e-11);

/// A certificate of `blysk certify`.
pub fn certify(bytes: &[u8], _: &Place) -> Outcome {
    let statement = |certificate: &Certificate| Some(certificate.claim().statement());
    let texts = [std::str::from_utf8(bytes).ok().map(str::to_owned), sealed(bytes, statement)];
    let mut outcome = Outcome::Refused;
    for text in texts.into_iter().flatten() {
        let Ok(certificate) = Certificate::parse(&text) else { continue };
        if is_little(certificate.claim()) && check(&certificate, &text, &AtomicU64::new(0)).is_ok() {
            demand_truth(certificate.claim());
            outcome = Outcome::Accepted;
        }
    }
    outcome
}

/// The text of a sealed file with its seal made right for what stands in it; none where it cannot be read.
pub(super) fn sealed<T: Serialize + DeserializeOwned>(
    bytes: &[u8],
    statement: impl Fn(&T) -> Option<String>,
) -> Option<String> {
    let mut value: Value = serde_json::from_slice(bytes).ok()?;
    value.as_object_mut()?.insert("sha256".to_owned(), Value::from(""));
    let read: T = serde_json::from_value(value.clone()).ok()?;
    if let Some(statement) = statement(&read) {
        value.as_object_mut()?.insert("statement".to_owned(), Value::from(statement));
    }
    let read: T = serde_json::from_value(value).ok()?;
    let text = serde_json::to_string_pretty(&read).ok()? + "\n";
    let (before, after) = text.rsplit_once("\"sha256\": \"\"")?;
    let digest = checksum(text.as_bytes()).ok()?.sha256;
    Some(format!("{before}\"sha256\": \"{digest}\"{after}"))
}

fn points(config: &Config) -> u64 {
    (config.exponents.len() as u64) << config.input.fraction_bits().min(40)
}

fn is_little(claim: &Claim) -> bool {
    match claim {
        Claim::Exponents(claims) => claims.claims.len() <= MOST_CLAIMS,
        Claim::EveryExponent(claims) => claims.claims.len() <= MOST_CLAIMS,
        Claim::Hardware(claim) => points(&claim.configuration) <= MOST_POINTS,
    }
}

fn demand_truth(claim: &Claim) {
    match claim {
        Claim::Exponents(claims) => {
            claims.claims.iter().for_each(|claim| method_is_so(claim, claims.levels));
        }
        // The greatest error of some exponents is a lower bound of that of all.
        Claim::EveryExponent(claims) => {
            for claim in &claims.claims {
                for n in [1.0, 1.5, 2.5, 4.0, 8.5, 64.0, 1e4] {
                    let found = errors(claim.method, n, Stretch::Epicentre, claims.levels);
                    let bounds = [claim.absolute.upper, claim.relative.upper];
                    for (found, bound) in found.into_iter().zip(bounds) {
                        assert!(found <= within(bound), "{claim:?}: {found} at n = {n}");
                    }
                }
            }
        }
        Claim::Hardware(claim) => hardware_is_so(claim),
    }
}

fn within(bound: f64) -> f64 {
    bound * (1.0 + SLACK.0) + SLACK.1
}

/// The absolute and the relative error of a method, in f64.
fn errors(method: hw_model::fit::Method, n: f64, region: Stretch, levels: Levels) -> [f64; 2] {
    let fit = fit(method, n, levels).expect("an exponent that was accepted");
    let interval = match region {
        Stretch::Epicentre => Interval::epicentre(&fit),
        Stretch::Tail => Interval::tail(&fit),
    };
    let found = approximation(&fit, n, interval);
    [found.absolute.error, found.relative.map_or(0.0, |peak| peak.error)]
}

fn method_is_so(claim: &ExponentClaim, levels: Levels) {
    let [absolute, relative] = errors(claim.method, claim.n, claim.region, levels);
    let is_so = |finding: &Finding, found: f64| {
        let so = found <= within(finding.upper()) && finding.lower() <= within(found);
        assert!(so, "{claim:?}: {found}");
    };
    is_so(&claim.absolute, absolute);
    if let Some(finding) = &claim.relative {
        is_so(finding, relative);
    }
}

fn hardware_is_so(claim: &HardwareClaim) {
    let config = &claim.configuration;
    let design = Design::new(config.clone()).expect("a configuration that was accepted");
    let greatest = design.datapath().front_end().greatest;
    let mut overall = [0.0_f64; 2];
    for (address, row) in (0..).zip(&claim.rows) {
        let error = |x: i64| {
            let intensity = real(design.datapath().evaluate(address, x).intensity, config.output);
            (intensity - phong(row.n, real(x, config.input))).abs()
        };
        let from = design.rows()[address as usize].first_of_epicentre(config);
        let worst = |from: i64| (from..=greatest).map(error).fold(0.0, f64::max);
        let found = [worst(from.max(0)), worst(0)];
        for ((claimed, found), overall) in [row.epicentre, row.full_range].into_iter().zip(found).zip(&mut overall) {
            let Worst { lower, upper, .. } = claimed;
            assert!(lower <= within(found) && found <= within(upper), "{row:?}: {found}");
            *overall = overall.max(found);
        }
    }
    assert_eq!(claim.points, (greatest as u64 + 1) * claim.rows.len() as u64);
    assert_eq!(claim.rows.len(), design.rom().depth());
    for (claimed, found) in [claim.epicentre, claim.full_range].into_iter().zip(overall) {
        assert!(claimed.lower <= within(found) && found <= within(claimed.upper), "{claimed:?}");
    }
}

/// A certificate of `blysk specialise`.
pub fn specialised(bytes: &[u8], _: &Place) -> Outcome {
    let as_it_is = std::str::from_utf8(bytes).ok().map(str::to_owned);
    let mut texts = vec![as_it_is, sealed::<Specialised>(bytes, |_| None)];
    let mut outcome = Outcome::Refused;
    while let Some(text) = texts.pop() {
        let Some(text) = text else { continue };
        let Ok(certificate) = Specialised::parse(&text) else { continue };
        if points(&certificate.source).max(points(&certificate.specialised)) > MOST_POINTS {
            continue;
        }
        match specialise::check(&text, Asked::default(), &AtomicU64::new(0)) {
            Ok(_) => {
                specialised_is_so(&certificate);
                outcome = Outcome::Accepted;
            }
            // Who lies about numbers lies about the words for them as well.
            Err(Refused::Found { field, found, .. }) if field == "statement" => {
                let found: Option<String> = serde_json::from_str(&found).ok();
                texts.push(sealed::<Specialised>(text.as_bytes(), |_| found.clone()));
            }
            Err(_) => {}
        }
    }
    outcome
}

fn specialised_is_so(certificate: &Specialised) {
    let design = |config: &Config| Design::new(config.clone()).expect("it was accepted");
    let designs = [design(&certificate.source), design(&certificate.specialised)];
    let display = certificate.display;
    let codes = Codes::new(&Image { width: 1, height: 1, display_bits: display.bits, transfer: display.transfer });
    for part in &certificate.parts {
        let again = part_again(&designs, part, &codes, certificate.proved);
        assert_eq!(&again, part, "every x says otherwise");
    }
    let numbers = |design: &Design| design.rom().exponents().len();
    let mut rows: Vec<f64> = certificate.parts.iter().map(|part| part.served.map_or(part.n, |of| of.row)).collect();
    rows.sort_by(f64::total_cmp);
    rows.dedup();
    assert_eq!(numbers(&designs[1]), rows.len());
}

/// The same part as every x says it, one by one.
fn part_again(designs: &[Design; 2], part: &Part, codes: &Codes, proved: Proved) -> Part {
    let row = part.served.map_or(part.n, |served| served.row);
    let address = |design: &Design, n: f64| design.rom().exponents().position(n).expect("a word for it") as u32;
    let addresses = [address(&designs[0], part.n), address(&designs[1], row)];
    let mut codes_apart = 0;
    let answer = |which: usize, x: i64| {
        let signals = designs[which].datapath().evaluate(addresses[which], x);
        (real(signals.intensity, designs[which].config().output), signals.status)
    };
    let mut again = Part { points: 0, differing: 0, greatest: 0.0, refused: 0, ..part.clone() };
    for x in part.first..=part.last {
        let [(wanted, flags), (got, same)] = [answer(0, x), answer(1, x)];
        again.points += 1;
        again.differing += u64::from(wanted != got || flags != same);
        again.greatest = again.greatest.max((wanted - got).abs());
        let apart = codes.of(wanted).abs_diff(codes.of(got));
        codes_apart = codes_apart.max(apart);
        match proved {
            Proved::BitIdentical => assert_eq!((wanted, flags), (got, same), "x = {x}"),
            Proved::Codes { allowed, .. } => assert!(apart <= allowed, "x = {x}: {apart} codes"),
        }
    }
    // A row that serves several exponents refuses what lies below the least x of all.
    for x in 0..part.refused as i64 {
        assert_eq!(answer(1, x), (0.0, Status::default().with(Status::OUT_OF_DOMAIN, true)));
        again.refused += 1;
    }
    assert!(part.served.is_some() || part.refused == part.first as u64);
    again.served = part.served.map(|_| Served { row, codes: codes_apart });
    again
}

#[cfg(test)]
mod tests {
    use std::panic::catch_unwind;

    use super::*;

    fn from_corpus(path: &[&str]) -> Vec<u8> {
        let root = [env!("CARGO_MANIFEST_DIR"), "fuzz", "corpus"];
        let path: std::path::PathBuf = root.iter().chain(path).collect();
        std::fs::read(path).unwrap()
    }

    /// A certificate of the corpus with a number made another one, sealed again.
    fn altered(name: &str, pointer: &str, factor: f64) -> Certificate {
        let mut value: Value = serde_json::from_slice(&from_corpus(&["certificate", name])).unwrap();
        let number = value.pointer_mut(pointer).unwrap();
        *number = Value::from(number.as_f64().unwrap() * factor);
        let statement = |certificate: &Certificate| Some(certificate.claim().statement());
        let text = sealed(value.to_string().as_bytes(), statement).unwrap();
        let certificate = Certificate::parse(&text).unwrap();
        assert!(certificate.check_seal(&text).is_ok());
        certificate
    }

    #[test]
    fn a_claim_that_is_not_so_is_found() {
        for (name, pointer, factor) in [
            ("hardware.json", "/claim/hardware/rows/2/full_range/upper", 0.9),
            ("hardware.json", "/claim/hardware/epicentre/upper", 0.9),
            ("hardware.json", "/claim/hardware/rows/1/epicentre/lower", 1.1),
            ("exponents.json", "/claim/exponents/claims/1/absolute/enclosed/upper", 0.99),
            ("exponents.json", "/claim/exponents/claims/1/relative/enclosed/lower", 1.01),
            ("tail.json", "/claim/exponents/claims/0/absolute/enclosed/upper", 0.99),
            ("every.json", "/claim/every_exponent/claims/0/absolute/upper", 0.5),
        ] {
            let so = |factor| catch_unwind(|| demand_truth(altered(name, pointer, factor).claim())).is_ok();
            assert!(so(1.0), "{name} is so");
            assert!(!so(factor), "{name} with {pointer} times {factor} is not so");
        }
    }

    #[test]
    fn specialised_hardware_that_answers_otherwise_is_found() {
        let text = String::from_utf8(from_corpus(&["specialised", "differing.json"])).unwrap();
        let right = Specialised::parse(&text).unwrap();
        specialised_is_so(&right);
        let mut wrong = [right.clone(), right.clone(), right];
        wrong[0].parts[0].points -= 1;
        wrong[1].proved = Proved::BitIdentical;
        wrong[2].parts[0].greatest /= 2.0;
        for wrong in wrong {
            assert!(catch_unwind(|| specialised_is_so(&wrong)).is_err(), "{wrong:?}");
        }
    }
}
