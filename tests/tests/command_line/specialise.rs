//! `blysk specialise`: what is left out, what the certificate is worth, and what happens outside the domain.

use std::path::{Path, PathBuf};

use blysk_tests::bench;
use blysk_tests::cli::{Bench, csv_rows, number};
use hw_model::config::Config;
use hw_model::datapath::Status;
use hw_model::design::Design;
use hw_model::presets;
use naive::{Naive, OUT_OF_DOMAIN};
use num_bigint::BigInt;
use vectors::checksum::checksum;

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scenes").join(format!("{name}.json"))
}

fn specialised(bench: &Bench, name: &str, more: &[&str]) -> String {
    let path = scene(name);
    let list = [&["specialise", path.to_str().unwrap()], more].concat();
    let run = bench.run_list(&list);
    assert!(run.status == 0 && run.stderr.is_empty(), "{run:#?}");
    assert!(run.stdout.lines().all(|line| line.chars().count() <= 100), "{run:#?}");
    run.stdout
}

fn design(bench: &Bench, file: &str) -> Design {
    Design::new(Config::from_json(&bench.text(file)).unwrap()).unwrap()
}

fn part(bench: &Bench, table: &str, name: &str) -> [f64; 2] {
    let rows = csv_rows(&bench.text(table));
    let row = rows.iter().find(|row| row["part"] == name).unwrap();
    [number(row, "before"), number(row, "after")]
}

#[test]
fn the_close_up_keeps_one_row_and_no_tail() {
    let bench = bench!();
    let said = specialised(&bench, "close_up", &["--preset", "paper", "--out", "small"]);
    assert!(said.contains("proved bit-identical over "), "{said}");
    assert_eq!(part(&bench, "small/left_out.csv", "ROM words"), [256.0, 1.0]);
    assert_eq!(part(&bench, "small/left_out.csv", "divider ranks"), [9.0, 0.0]);
    assert_eq!(part(&bench, "small/left_out.csv", "address bits"), [9.0, 1.0]);
    assert!(said.contains("Software sends 172800 of the 172800 samples"), "{said}");
    // Every x, by the naive model of the small one and the data path of the whole one.
    let small = design(&bench, "small/configuration.json");
    let whole = Design::new(presets::find("paper").unwrap().config().unwrap()).unwrap();
    let naive = Naive::new(&small);
    let one = whole.config().input.one();
    let (mut inside, mut outside) = (0, 0);
    for x in (0..=one).rev().step_by(37) {
        let answer = naive.answer(0, x);
        let found = small.datapath().evaluate(0, x);
        let (intensity, status) = (found.intensity, found.status);
        assert_eq!((answer.intensity, answer.status), (intensity.into(), status.bits()), "{x}");
        if status.contains(Status::OUT_OF_DOMAIN) {
            assert_eq!((intensity, answer.status), (0, OUT_OF_DOMAIN));
            outside += 1;
        } else {
            assert_eq!(BigInt::from(whole.datapath().evaluate(63, x).intensity), intensity.into());
            inside += 1;
        }
    }
    assert!(inside > 1000 && outside > 100_000, "{inside} {outside}");
    // No exponent is not a matter of the domain.
    assert_eq!(small.datapath().evaluate(1, 5).status, Status::NO_WORD);
}

/// What Yosys counts, of the whole and of what is left.
#[test]
fn synthesis_counts_both() {
    let bench = bench!();
    let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples/small.json");
    let options = ["--config", whole.to_str().unwrap(), "--count", "1", "--synth", "--out", "small"];
    let said = specialised(&bench, "low_exponents", &options);
    assert!(said.trim_end().ends_with(", rtl, source_rtl"), "{said}");
    for name in ["LUTs", "flip-flops"] {
        let [before, after] = part(&bench, "small/left_out.csv", name);
        assert!(before > after && after > 0.0, "{name}: {before} {after}");
    }
    for place in ["rtl", "source_rtl"] {
        assert!(bench.text(&format!("small/{place}/blysk_pkg.sv")).contains("package blysk_pkg"));
    }
}

#[test]
fn exponents_up_to_three_need_a_multiplier_less_and_every_x() {
    let bench = bench!();
    let said = specialised(&bench, "low_exponents", &["--preset", "paper", "--out", "small"]);
    assert!(said.contains("Every x from 0 to 1 is answered as before"), "{said}");
    let [before, after] = part(&bench, "small/left_out.csv", "multipliers");
    assert!(after < before, "{said}");
    assert!(design(&bench, "small/configuration.json").config().domain.is_empty());
}

#[test]
fn codes_that_may_differ_save_bits() {
    let bench = bench!();
    let more = ["--preset", "paper", "--allow-codes", "1", "--out", "small"];
    let said = specialised(&bench, "close_up", &more);
    assert!(said.contains("proved within 1 display code over "), "{said}");
    let [before, after] = part(&bench, "small/left_out.csv", "intensity bits");
    assert!(before == 16.0 && after < 12.0, "{said}");
    let held = bench.good("specialise --check small/certificate.json");
    assert!(held.contains("certificate.json holds: "), "{held}");
}

#[test]
fn a_certificate_is_checked_and_a_wrong_one_refused() {
    let bench = bench!();
    specialised(&bench, "close_up", &["--preset", "paper", "--out", "small"]);
    let path = scene("close_up");
    let check = |file: &str| bench.run_list(&["specialise", path.to_str().unwrap(), "--check", file]);
    assert_eq!(check("small/certificate.json").status, 0);
    let text = bench.text("small/certificate.json");
    for (wrong, from, to) in [
        ("digit", "\"points\": 5", "\"points\": 6"),
        ("space", "\n", "\n\n"),
        ("least", "\"least\": 0.993", "\"least\": 0.992"),
        ("fields", "\"version\": 2,", ""),
    ] {
        assert!(text.contains(from), "{wrong}: {text}");
        bench.write("wrong.json", text.replacen(from, to, 1));
        let run = check("wrong.json");
        assert_eq!(run.status, 1, "{wrong}: {run:#?}");
        assert!(run.stdout.contains("does not hold: "), "{wrong}: {run:#?}");
    }
    // The configuration beside it is another, though the list of files was written again.
    let list = bench.text("small/specialise.sha256");
    let honest = bench.text("small/configuration.json");
    let other = honest.replacen("\"error_budget_ulp\"", "\"error_budget_ulp\" ", 1);
    let other = other.replacen("\"description\": \"", "\"description\": \"x", 1);
    let digest = |text: &str| checksum(text.as_bytes()).unwrap().sha256;
    bench.write("small/specialise.sha256", list.replace(&digest(&honest), &digest(&other)));
    bench.write("small/configuration.json", &other);
    let run = check("small/certificate.json");
    assert!(run.status == 1 && run.stdout.contains("is not the certificate's"), "{run:#?}");
    bench.write("small/specialise.sha256", list);
    bench.write("small/configuration.json", honest);
    // Another scene is not the one it was made for.
    let other = scene("one_material");
    let run = bench.run_list(&["specialise", other.to_str().unwrap(), "--check", "small/certificate.json"]);
    assert!(run.status == 1 && run.stdout.contains("scene: "), "{run:#?}");
}

#[test]
fn the_same_command_writes_the_same_bytes() {
    let bench = bench!();
    for directory in ["one", "two"] {
        specialised(&bench, "many_materials", &["--preset", "compact", "--out", directory]);
    }
    assert!(bench.tree("one") == bench.tree("two"));
    let held = bench.good("specialise --check one/certificate.json");
    assert!(held.contains("the same bits"), "{held}");
}

/// The scene of the close-up with its ball made of triangles: a patch of 6.8 degrees around the axis.
fn close_up_of_a_mesh(bench: &Bench) {
    let side = 17_u32;
    let mut mesh = String::new();
    for (row, column) in (0..side).flat_map(|row| (0..side).map(move |column| (row, column))) {
        let [x, y] = [column, row].map(|step| 0.24 * (f64::from(step) / f64::from(side - 1) - 0.5));
        let length = (x * x + y * y + 1.0).sqrt();
        let [x, y, z] = [x, y, 1.0].map(|part| part / length);
        mesh += &format!("v {} {} {}\nvn {x} {y} {z}\n", 20.0 * x, 20.0 * y, 20.0 * z);
    }
    for (row, column) in (1..side).flat_map(|row| (1..side).map(move |column| (row, column))) {
        let corners = [(row - 1, column - 1), (row - 1, column), (row, column), (row, column - 1)];
        let corners = corners.map(|(row, column)| row * side + column + 1).map(|index| format!("{index}//{index}"));
        mesh += &format!("f {}\n", corners.join(" "));
    }
    bench.write("patch.obj", mesh);
    let text = std::fs::read_to_string(scene("close_up")).unwrap();
    let ball = r#"{"sphere": {"centre": [0, 0, 0], "radius": 20, "material": "lacquer"}}"#;
    assert!(text.contains(ball), "{text}");
    bench.write("patch.json", text.replace(ball, r#"{"mesh": {"file": "patch.obj", "material": "lacquer"}}"#));
}

/// Triangles are bounded as balls are: the tail goes, and the checker bounds them again.
#[test]
fn a_close_up_of_a_mesh_has_no_tail() {
    let bench = bench!();
    close_up_of_a_mesh(&bench);
    let said = bench.good("specialise patch.json --preset paper --out small");
    assert!(said.contains("proved bit-identical over "), "{said}");
    assert_eq!(part(&bench, "small/left_out.csv", "divider ranks"), [9.0, 0.0]);
    let held = bench.good("specialise patch.json --preset paper --check small/certificate.json");
    assert!(held.contains("certificate.json holds: "), "{held}");
    // A scene that sees more of the mesh asks for more.
    bench.write("wide.json", bench.text("patch.json").replace("0.136", "0.2"));
    let run = bench.run("specialise wide.json --check small/certificate.json");
    assert!(run.status == 1 && run.stdout.contains("the scene asks x from"), "{run:#?}");
}

/// Eight materials as files of people have them, for most of which the configuration has no word.
const EXPONENTS: [f64; 8] = [3.4, 10.0, 10.2, 10.25, 33.1, 33.3, 96.078431, 97.5];
const FEW_ROWS: &str = r#"{"name": "few", "method": "minimax", "segments": 2, "cut": "balanced",
    "exponents": "1..=16", "input": "UQ1.14", "output": "UQ1.12"}"#;

fn balls(bench: &Bench) {
    bench.write("few.json", FEW_ROWS);
    let (mut materials, mut geometry) = (Vec::new(), Vec::new());
    for (place, n) in EXPONENTS.into_iter().enumerate() {
        materials
            .push(format!(r#"{{"name": "m{place}", "exponent": {n}, "diffuse": [0, 0, 0], "specular": [1, 1, 1]}}"#));
        geometry.push(format!(
            r#"{{"sphere": {{"centre": [{}, 0, 0], "radius": 1, "material": "m{place}"}}}}"#,
            2.5 * (place as f64 - 3.5)
        ));
    }
    // A material that nothing is made of.
    materials.push(r#"{"name": "spare", "exponent": 7, "diffuse": [0, 0, 0], "specular": [1, 1, 1]}"#.to_owned());
    bench.write(
        "balls.json",
        format!(
            r#"{{"name": "balls", "image": {{"width": 80, "height": 20}}, "camera": {{"position": [0, 0, 30],
            "look_at": [0, 0, 0], "field_of_view_degrees": 10}}, "lights": [{{"directional":
            {{"towards": [1, 2, 3], "colour": [1, 1, 1]}}}}], "materials": [{}], "geometry": [{}]}}"#,
            materials.join(", "),
            geometry.join(", ")
        ),
    );
}

#[test]
fn near_exponents_share_rows_and_the_map_is_checked() {
    let bench = bench!();
    balls(&bench);
    let refused = bench.run("specialise balls.json --config few.json");
    assert!(refused.status == 2 && refused.stderr.contains("--nearest"), "{refused:#?}");
    bench.refused("specialise balls.json --config few.json --nearest --out small", &["--allow-codes"]);
    let said = bench.good("specialise balls.json --config few.json --nearest --allow-codes 1 --count 64 --out small");
    assert!(said.contains("not seen in any light"), "{said}");
    let small = design(&bench, "small/configuration.json");
    let certificate: serde_json::Value = serde_json::from_str(&bench.text("small/certificate.json")).unwrap();
    let parts = certificate["parts"].as_array().unwrap();
    let served = |part: &serde_json::Value| {
        let codes = part["served"]["codes"].as_u64().unwrap();
        (part["n"].as_f64().unwrap(), part["served"]["row"].as_f64().unwrap(), codes)
    };
    let map: Vec<(f64, f64, u64)> = parts.iter().map(served).collect();
    let asked: Vec<f64> = map.iter().map(|one| one.0).collect();
    assert_eq!(asked, EXPONENTS);
    assert!(map.iter().all(|one| one.2 <= 1), "{map:?}");
    let mut rows: Vec<f64> = map.iter().map(|one| one.1).collect();
    rows.dedup();
    assert!(rows.len() < EXPONENTS.len(), "{map:?}");
    assert_eq!(small.rom().exponents().as_slice(), rows);
    // 3.4 has none near it.
    assert_eq!(map[0].1, 3.4);

    let check = |file: &str| {
        bench.run_list(&["specialise", "balls.json", "--config", "few.json", "--allow-codes", "1", "--check", file])
    };
    let held = check("small/certificate.json");
    assert!(held.status == 0 && held.stdout.contains("words for n = 3.4, 10.2"), "{held:#?}");
    let text = bench.text("small/certificate.json");
    for (from, to) in [("\"codes\": 1", "\"codes\": 0"), ("\"row\": 3.4", "\"row\": 10.2")] {
        assert!(text.contains(from), "{text}");
        bench.write("wrong.json", text.replacen(from, to, 1));
        assert_eq!(check("wrong.json").status, 1, "{from}");
    }
    // More codes, fewer rows.
    let said = bench.good("specialise balls.json --config few.json --nearest --allow-codes 40 --count 64 --out other");
    let fewer = design(&bench, "other/configuration.json").rom().depth();
    assert!(fewer < rows.len(), "{said}");
}

#[test]
fn what_cannot_be_specialised_is_refused() {
    let bench = bench!();
    let path = scene("close_up");
    let path = path.to_str().unwrap();
    bench.refused_list(&["specialise", path, "--config", "small.json"], &["no word for n = 64"]);
    bench.refused_list(&["specialise", path], &["--preset NAME or --config FILE"]);
    bench.refused_list(&["specialise"], &["SCENE"]);
    let domain = |rest: &str| {
        let shown = bench.good("presets show compact").replace("\"1..=256\"", "\"2,9\"");
        let end = shown.trim_end().trim_end_matches('}').trim_end().to_owned();
        bench.write("domain.json", format!("{end},\n{rest}}}"));
    };
    for (rest, said) in [
        (r#""domain": [{"n": 2, "least": 0.9}]"#, "one n and least for each exponent"),
        (r#""domain": [{"n": 2, "least": 0.9}, {"n": 9, "least": 1.5}]"#, "use a number from 0 to 1"),
        (r#""domain": [{"n": 2, "least": 0.9}, {"n": 9, "least": 0.1}]"#, "below its cut"),
    ] {
        domain(rest);
        bench.refused("rom --config domain.json", &["domain", said]);
    }
}
