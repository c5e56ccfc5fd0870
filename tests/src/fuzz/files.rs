//! Targets that read files: stimulus, logs, memory files, manifests and bundles.

use std::fs;
use std::path::Path;

use hw_model::design::Design;
use serde_json::Value;
use sim::agreement::compare;
use sim::pipeline::Pipeline;
use sim::run::{StimulusCycle, run};
use vectors::checksum::checksum;
use vectors::manifest::MANIFEST;
use vectors::memory_file::{parse, read_words};
use vectors::stimulus_file::parse_stimulus;
use vectors::{check, verify};

use super::readers::evaluate;
use super::{Outcome, Place, archive};

/// A stimulus, run to its end.
pub fn stimulus(bytes: &[u8], place: &Place) -> Outcome {
    let design = &place.design;
    let input = design.config().input;
    let Ok(cycles) = parse_stimulus(bytes, Path::new("in.csv"), design.rom(), input) else {
        return Outcome::Refused;
    };
    let rows = cycles.iter().map(|line| Ok::<_, ()>(StimulusCycle::from(line)));
    let counts = run(&mut Pipeline::new(design.datapath()), rows, |_| Ok(())).expect("nobody fails");
    assert!(counts.cycles >= cycles.len() as u64 && counts.results <= counts.requests, "{counts:?}");
    Outcome::Accepted
}

/// A log of answers against the right bundle.
pub fn answers(bytes: &[u8], place: &Place) -> Outcome {
    let verdict = check(place.bundle(), &place.file("dut.csv", bytes));
    if let Ok(verdict) = &verdict {
        assert!(verdict.failing() <= verdict.vectors && verdict.holds() == (verdict.failing() == 0));
    }
    Outcome::of(&verdict)
}

/// A log of registers.
pub fn registers(bytes: &[u8], place: &Place) -> Outcome {
    Outcome::of(&compare(place.design.datapath(), bytes))
}

/// A memory file: read whole, and as words of several sizes.
pub fn memory(bytes: &[u8], place: &Place) -> Outcome {
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = parse(text, Path::new("rom.mem"));
    }
    let path = place.file("rom.mem", bytes);
    let mut outcome = Outcome::Refused;
    for (width, depth) in [(0, 1), (8, 4), (16, 12), (39, 4), (64, 65536), (u32::MAX, 4), (39, usize::MAX)] {
        if let Ok(words) = read_words(&path, width, depth) {
            assert_eq!(words.len(), depth);
            outcome = Outcome::Accepted;
        }
    }
    outcome
}

/// A manifest in the right bundle, whose checksums are made right.
pub fn manifest(bytes: &[u8], place: &Place) -> Outcome {
    let right = fs::read_dir(place.bundle()).expect("the bundle is there").flatten();
    let mut files: Vec<(String, Vec<u8>)> = right
        .map(|entry| (entry.file_name(), fs::read(entry.path())))
        .filter_map(|(name, contents)| Some((name.into_string().ok()?, contents.ok()?)))
        .filter(|(name, _)| name != MANIFEST)
        .collect();
    files.push((MANIFEST.to_owned(), bytes.to_vec()));
    with_checksums(&mut files);
    judged(&files, place)
}

/// A whole bundle, its checksums made right for what was altered.
pub fn bundle(bytes: &[u8], place: &Place) -> Outcome {
    let mut files = archive::unpack(bytes);
    with_checksums(&mut files);
    judged(&files, place)
}

/// Reads a bundle and, where that can be done, judges the log in it, and makes its hardware.
fn judged(files: &[(String, Vec<u8>)], place: &Place) -> Outcome {
    let directory = place.files(files);
    let bundle = verify(&directory);
    let Ok(verified) = &bundle else { return Outcome::Refused };
    let log = directory.join("dut.csv");
    let log = if log.exists() { log } else { place.file("dut.csv", b"intensity\n0\n") };
    let _ = check(&directory, &log);
    let config = verified.manifest.configuration.clone();
    if config.exponents.len() <= 16
        && let Ok(design) = Design::new(config)
    {
        evaluate(&design);
    }
    Outcome::Accepted
}

fn with_checksums(files: &mut [(String, Vec<u8>)]) {
    let sums: Vec<(String, Value)> = files
        .iter()
        .filter_map(|(name, contents)| {
            let sum = serde_json::to_value(checksum(contents.as_slice()).ok()?).ok()?;
            Some((name.clone(), sum))
        })
        .collect();
    let Some((_, manifest)) = files.iter_mut().find(|(name, _)| name == MANIFEST) else { return };
    let Ok(mut value) = serde_json::from_slice::<Value>(manifest) else { return };
    let Some(listed) = value.get_mut("files").and_then(Value::as_object_mut) else { return };
    for (name, sum) in sums {
        if let Some(listed) = listed.get_mut(&name) {
            *listed = sum;
        }
    }
    *manifest = serde_json::to_vec_pretty(&value).unwrap_or_default();
}
