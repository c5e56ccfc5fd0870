//! A bundle is written as promised, comes back, and is refused when it is not what was written.

mod common;

use std::fs;
use std::path::Path;

use hw_model::design::Design;
use hw_model::format::QFormat;
use vectors::bundle::{MAX_VECTORS, file_paths};
use vectors::manifest::{EXPECTED, FAULTS, MANIFEST, NEGATIVE_CONTROL, ROM, STIMULUS, TABLE};
use vectors::reference::Expected;
use vectors::{Bundle, BundleError, Case, Strategy, VerifyError, verify};

fn write(design: &Design, strategy: Strategy, count: u64, directory: &Path) {
    let bundle = Bundle::new(design, strategy, count, 1, "blysk vectors").unwrap();
    let manifest = bundle.write_to(directory).unwrap();
    assert_eq!(manifest.counts.vectors, bundle.vector_count());
}

#[test]
fn the_same_command_gives_the_same_bytes() {
    let place = tempfile::tempdir().unwrap();
    let design = common::small();
    for strategy in [Strategy::Mixed, Strategy::Random] {
        let [one, two] = ["one", "two"].map(|name| place.path().join(name));
        write(&design, strategy, 100, &one);
        write(&design, strategy, 100, &two);
        for (one, two) in file_paths(&one).iter().zip(file_paths(&two)) {
            let bytes = fs::read(one).unwrap();
            assert!(bytes == fs::read(two).unwrap(), "{}", one.display());
            assert_eq!(bytes.last(), Some(&b'\n'), "{}", one.display());
        }
    }
}

#[test]
fn what_is_read_back_is_the_golden_model() {
    let place = tempfile::tempdir().unwrap();
    for (design, strategy, count) in [
        (common::small(), Strategy::Exhaustive, 0),
        (common::centred(), Strategy::Exhaustive, 0),
        (common::below_one(), Strategy::Exhaustive, 0),
        (common::preset("paper"), Strategy::Mixed, 4096),
    ] {
        write(&design, strategy, count, place.path());
        let read = verify(place.path()).unwrap();
        let chosen: Vec<_> = Bundle::new(&design, strategy, count, 1, "").unwrap().samples().collect();
        assert_eq!(read.vectors.len(), chosen.len());
        for ((index, row), sample) in (0..).zip(&read.vectors).zip(&chosen) {
            assert_eq!((row.index, row.case), (index, sample.case));
            assert_eq!(row.kind, sample.kind.to_string());
            assert_eq!(row.expected, Expected::of(design.datapath(), sample.case));
        }
        let layout = design.rom().layout();
        let rows: Vec<_> = read.rom.iter().map(|word| layout.unpack(word)).collect();
        assert_eq!(rows, design.rom().rows());
        assert_eq!(read.manifest.configuration, *design.config());
        assert_eq!(read.manifest.hardware.latency as usize, design.datapath().rank_count());
        assert_eq!(read.manifest.counts.kinds.values().sum::<u64>(), chosen.len() as u64);
    }
}

/// The packing as stated: {address, x} and {status, intensity}, x in two's complement.
#[test]
fn words_are_packed_as_the_header_says() {
    let place = tempfile::tempdir().unwrap();
    let design = common::small();
    write(&design, Strategy::Exhaustive, 0, place.path());
    let line = |name: &str, index: usize| {
        let text = fs::read_to_string(place.path().join(name)).unwrap();
        let words: Vec<&str> = text.lines().filter(|line| !line.starts_with("//")).collect();
        u64::from_str_radix(words[index], 16).unwrap()
    };
    // Address 2, x = −1: 3 address bits above 10 x bits.
    let index = 2 * 1024 + 511;
    assert_eq!(line(STIMULUS, index), 2 << 10 | 0x3ff);
    let last = design.datapath().evaluate(2, -1);
    assert_eq!((last.status.bits(), last.intensity), (4, 0));
    assert_eq!(line(EXPECTED, index), 4 << 8);
    let one = 2 * 1024 + 512 + 256;
    assert_eq!(line(EXPECTED, one), 0x80);
    let header = fs::read_to_string(place.path().join(STIMULUS)).unwrap();
    assert!(header.contains("\n//   [12:10] address UQ3.0\n//   [9:0] x Q2.8\n"), "{header:.400}");
}

/// Each computed register has its two columns, and they are the golden model's.
#[test]
fn the_table_shows_every_stage() {
    let place = tempfile::tempdir().unwrap();
    let design = common::small();
    write(&design, Strategy::Mixed, 200, place.path());
    let mut reader = csv::Reader::from_path(place.path().join(TABLE)).unwrap();
    let header = reader.headers().unwrap().clone();
    let datapath = design.datapath();
    let column = |name: &str| header.iter().position(|field| field == name);
    let mut compared = 0;
    for record in reader.records().map(Result::unwrap) {
        let field = |name: &str| &record[column(name).unwrap()];
        let (address, x) = (field("address").parse().unwrap(), field("x_bits").parse().unwrap());
        let passage = datapath.passage(address, x);
        for (rank, held) in passage.iter().enumerate() {
            for register in datapath.registers(rank).iter().filter(|register| register.computed) {
                let name = datapath.register_name(rank, register);
                if column(&name).is_none() {
                    let port = ["address", "x", "intensity", "status"].contains(&register.name());
                    assert!(port && (rank == 0 || rank + 1 == passage.len()), "{name}");
                    continue;
                }
                let bits = register.bits(held);
                assert_eq!(field(&name), bits.to_string(), "{name}");
                let hex = field(&format!("{name}_hex")).strip_prefix("0x").unwrap();
                let format: QFormat = register.format;
                assert_eq!(hex.len() as u32, format.width().div_ceil(4));
                let word = u64::from_str_radix(hex, 16).unwrap();
                assert_eq!(format.from_word(word), bits, "{name}");
                compared += 1;
            }
        }
        let last = passage.last().unwrap();
        assert_eq!(field("flags"), last.status.to_string());
        let output = design.config().output;
        let intensity: f64 = field("intensity_real").parse().unwrap();
        assert_eq!(intensity, last.intensity as f64 * output.ulp());
        if let Ok(n) = field("n").parse::<f64>() {
            let x: f64 = field("x_real").parse::<f64>().unwrap();
            let power: f64 = field("reference").parse().unwrap();
            assert!((power - x.clamp(0.0, 1.0).powf(n)).abs() < 1e-14, "{n} {x}");
            let error: f64 = field("error_ulp").parse().unwrap();
            assert!((error - (intensity - power) / output.ulp()).abs() < 1e-6);
        } else {
            assert_eq!((field("reference"), field("error_ulp")), ("", ""));
        }
    }
    assert!(compared > 2000, "{compared}");
}

#[test]
fn a_changed_bundle_is_refused() {
    let design = common::small();
    for (index, name) in [ROM, STIMULUS, EXPECTED, NEGATIVE_CONTROL, TABLE].into_iter().enumerate() {
        let place = tempfile::tempdir().unwrap();
        write(&design, Strategy::Mixed, 50, place.path());
        verify(place.path()).unwrap();
        let path = place.path().join(name);
        let bytes = fs::read(&path).unwrap();

        let mut flipped = bytes.clone();
        let middle = bytes.len() / 2 + index;
        flipped[middle] ^= 1;
        fs::write(&path, &flipped).unwrap();
        let error = verify(place.path()).unwrap_err();
        assert!(matches!(&error, VerifyError::Checksum { path, .. } if path.ends_with(name)), "{error}");

        fs::write(&path, &bytes[..bytes.len() - 1]).unwrap();
        let error = verify(place.path()).unwrap_err();
        assert!(matches!(&error, VerifyError::Checksum { path, .. } if path.ends_with(name)), "{error}");

        fs::remove_file(&path).unwrap();
        let error = verify(place.path()).unwrap_err();
        assert!(matches!(&error, VerifyError::Io { path, .. } if path.ends_with(name)), "{error}");
    }
}

/// Checksums that were made to fit do not help a bundle whose files disagree.
#[test]
fn files_that_disagree_are_refused() {
    let design = common::small();
    let place = tempfile::tempdir().unwrap();
    write(&design, Strategy::Mixed, 50, place.path());
    let change = |name: &str, from: &str, to: &str| {
        let path = place.path().join(name);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{name} has no {from:?}");
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        text
    };
    let manifest_path = place.path().join(MANIFEST);
    let reseal = |name: &str| {
        let mut manifest: vectors::Manifest =
            serde_json::from_str(&fs::read_to_string(&manifest_path).unwrap()).unwrap();
        let file = fs::File::open(place.path().join(name)).unwrap();
        manifest.files.insert(name.to_owned(), vectors::checksum::checksum(file).unwrap());
        fs::write(&manifest_path, manifest.to_json()).unwrap();
    };
    change(EXPECTED, "\n080\n", "\n07f\n");
    reseal(EXPECTED);
    let error = verify(place.path()).unwrap_err();
    assert!(matches!(&error, VerifyError::Disagree { path, index: 15, .. } if path.ends_with(EXPECTED)), "{error}");
    change(EXPECTED, "\n07f\n", "\n");
    reseal(EXPECTED);
    let error = verify(place.path()).unwrap_err().to_string();
    assert!(error.contains("expected.mem: the word at address 49 is missing"), "{error}");

    let text = change(MANIFEST, "\"vectors\": 50", "\"vectors\": 51");
    let error = verify(place.path()).unwrap_err();
    assert!(matches!(error, VerifyError::Count { found: 50, expected: 51, .. }), "{error}");
    fs::write(&manifest_path, &text).unwrap();
    change(MANIFEST, "\"vectors\": 50", "\"vectors\": 0");
    assert!(matches!(verify(place.path()).unwrap_err(), VerifyError::Empty(_)));
    fs::write(&manifest_path, &text).unwrap();
    change(MANIFEST, "\"format_version\": 2", "\"format_version\": 1");
    assert!(matches!(verify(place.path()).unwrap_err(), VerifyError::Version { found: 1, .. }));
    fs::write(&manifest_path, text.replace("\"rom.mem\"", "\"ram.mem\"")).unwrap();
    assert!(matches!(verify(place.path()).unwrap_err(), VerifyError::NotListed { name: ROM, .. }));
    fs::write(&manifest_path, &text[..text.len() / 2]).unwrap();
    let error = verify(place.path()).unwrap_err();
    assert!(matches!(&error, VerifyError::Manifest { .. }), "{error}");
    fs::remove_file(&manifest_path).unwrap();
    assert!(matches!(verify(place.path()).unwrap_err(), VerifyError::Io { .. }));
}

#[test]
fn a_bundle_that_fails_half_way_leaves_nothing() {
    let design = common::small();
    let place = tempfile::tempdir().unwrap();
    // The table cannot have its name; by then three files are under way.
    fs::create_dir(place.path().join(TABLE)).unwrap();
    let bundle = Bundle::new(&design, Strategy::Mixed, 50, 1, "c").unwrap();
    let error = bundle.write_to(place.path()).unwrap_err();
    assert!(matches!(error, BundleError::Output(_)) && error.to_string().contains(TABLE), "{error}");
    let left: Vec<_> = fs::read_dir(place.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left, [TABLE]);
}

#[test]
fn counts_that_make_no_sense_are_refused() {
    let design = common::preset("paper");
    let refused = |strategy, count| Bundle::new(&design, strategy, count, 1, "").unwrap_err();
    assert!(matches!(refused(Strategy::Mixed, 0), BundleError::NoVectors));
    let error = refused(Strategy::Exhaustive, 0).to_string();
    assert!(error.contains("8589934592 vectors") && error.contains("narrower"), "{error}");
    let error = refused(Strategy::Random, MAX_VECTORS + 1).to_string();
    assert!(error.contains("4194305") && error.contains("lower count"), "{error}");
}

#[test]
fn the_manifest_says_what_was_left_out() {
    let design = common::small();
    let few = Bundle::new(&design, Strategy::Corners, 40, 1, "").unwrap();
    let all = Bundle::new(&design, Strategy::Corners, 100_000, 1, "").unwrap();
    let available = all.vector_count();
    assert!(available > 40 && few.vector_count() == 40);
    let note = few.notes().join("\n");
    assert!(note.contains(&format!("40 of the design's {available} corners")), "{note}");
    let note = all.notes().join("\n");
    assert!(note.starts_with("100000 vectors were asked for"), "{note}");
    let even = Bundle::new(&design, Strategy::Even, 40, 1, "").unwrap();
    assert!(even.notes().is_empty());
}

#[test]
fn an_exponent_without_a_word_has_an_address_and_a_reference() {
    let design = common::small();
    let case = Case::of(design.rom(), 64.0, 255);
    assert_eq!(case.address, 4);
    assert_eq!(Expected::of(design.datapath(), case), Expected { intensity: 0, status: 1 });
}

fn words(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().filter(|line| !line.starts_with("//")).map(str::to_owned).collect()
}

/// One word is another, in one bit of the intensity, and the manifest says which.
#[test]
fn the_negative_control_is_wrong_once() {
    let place = tempfile::tempdir().unwrap();
    let design = common::small();
    let mut flips = std::collections::BTreeSet::new();
    for (seed, count) in (0..24).map(|seed| (seed, 50)).chain([(1, 1)]) {
        let bundle = Bundle::new(&design, Strategy::Mixed, count, seed, "c").unwrap();
        let record = bundle.write_to(place.path()).unwrap().negative_control;
        let right = words(&place.path().join(EXPECTED));
        let wrong = words(&place.path().join(NEGATIVE_CONTROL));
        assert_eq!(right.len(), wrong.len());
        let differing: Vec<usize> = (0..right.len()).filter(|&index| right[index] != wrong[index]).collect();
        assert_eq!(differing, [record.vector as usize]);
        assert_eq!((&right[differing[0]], &wrong[differing[0]]), (&record.expected, &record.corrupted));
        let [expected, corrupted] =
            [&record.expected, &record.corrupted].map(|word| u64::from_str_radix(word, 16).unwrap());
        assert_eq!(expected ^ corrupted, 1 << record.bit);
        // The intensity is the lowest 8 bits of the word.
        assert!(record.bit < 8);
        verify(place.path()).unwrap();
        flips.insert((record.vector, record.bit));
    }
    assert!(flips.len() > 15, "{flips:?}");
}

/// A control that is right everywhere, wrong twice, or wrong elsewhere is refused.
#[test]
fn a_negative_control_that_controls_nothing_is_refused() {
    let place = tempfile::tempdir().unwrap();
    let design = common::small();
    write(&design, Strategy::Mixed, 50, place.path());
    let path = |name: &str| place.path().join(name);
    let manifest: vectors::Manifest = serde_json::from_str(&fs::read_to_string(path(MANIFEST)).unwrap()).unwrap();
    let refused = |control: &str, found: usize| {
        fs::write(path(NEGATIVE_CONTROL), control).unwrap();
        let mut manifest = manifest.clone();
        let file = fs::File::open(path(NEGATIVE_CONTROL)).unwrap();
        let checksum = vectors::checksum::checksum(file).unwrap();
        manifest.files.insert(NEGATIVE_CONTROL.to_owned(), checksum);
        fs::write(path(MANIFEST), manifest.to_json()).unwrap();
        let error = verify(place.path()).unwrap_err();
        assert!(matches!(&error, VerifyError::Control { differing, .. } if *differing == found), "{error}");
    };
    let right = words(&path(EXPECTED));
    let wrong = words(&path(NEGATIVE_CONTROL));
    refused(&right.join("\n"), 0);
    let other = (manifest.negative_control.vector as usize + 1) % right.len();
    let flip = |word: &str| format!("{:03x}", u64::from_str_radix(word, 16).unwrap() ^ 1);
    let mut twice = wrong.clone();
    twice[other] = flip(&wrong[other]);
    refused(&twice.join("\n"), 2);
    let mut elsewhere = right.clone();
    elsewhere[other] = flip(&right[other]);
    refused(&elsewhere.join("\n"), 1);
}

#[test]
fn the_compact_bundle_says_what_it_kills() {
    let place = tempfile::tempdir().unwrap();
    let design = common::small();
    write(&design, Strategy::Compact, 0, place.path());
    let read = verify(place.path()).unwrap();
    let faults = read.manifest.faults.unwrap();
    let mut reader = csv::Reader::from_path(place.path().join(FAULTS)).unwrap();
    let lines: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(lines.len() as u64, faults.faults);
    let vectors = read.vectors.len();
    let mut equivalent = 0;
    for line in &lines {
        match (&line[1], line[2].parse::<usize>()) {
            ("killed", Ok(vector)) => assert!(vector < vectors),
            ("equivalent", Err(_)) => equivalent += 1,
            _ => panic!("{line:?}"),
        }
    }
    assert_eq!(equivalent, faults.equivalent);
    assert!(faults.lower_bound <= vectors as u64);
    assert_eq!(faults.inputs, 4 * 257);
    let notes = read.manifest.notes.join("\n");
    assert!(notes.contains(&format!("{equivalent} are equivalent")), "{notes}");
    let error = Bundle::new(&common::wide(), Strategy::Compact, 0, 1, "").unwrap_err().to_string();
    assert!(error.contains("narrower input"), "{error}");
    fs::remove_file(place.path().join(FAULTS)).unwrap();
    assert!(matches!(verify(place.path()).unwrap_err(), VerifyError::Io { .. }));
}
