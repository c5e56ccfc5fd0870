//! Models that were made elsewhere (`tests/models/`): import, render, specialise.

use std::collections::BTreeMap;
use std::path::Path;

use blysk_tests::bench;
use blysk_tests::cli::{Bench, csv_rows, number};

/// Hardware with x of few bits, so that every x is tried in no time.
const SMALL: &str = r#"{"name": "little", "method": "minimax", "segments": 2, "cut": "balanced",
    "exponents": "1..=32", "input": "UQ1.12", "output": "UQ1.10"}"#;

/// Imports a model, renders it, specialises for it and checks the certificate; gives the rows of the import's table.
fn through(bench: &Bench, file: &str) -> Vec<BTreeMap<String, String>> {
    bench.write("little.json", SMALL);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(file);
    let model = path.to_str().unwrap();
    let import = ["scene", "import", model, "--size", "96x64", "--out", "scenes/model.json", "--format", "csv"];
    let imported = bench.run_list(&import);
    assert!(imported.status == 0 && imported.stderr.is_empty(), "{imported:#?}");
    let shown = bench.good("render scenes/model.json --config little.json --nearest");
    assert!(shown.contains("every bit is the same"), "{shown}");
    let specialise = "specialise scenes/model.json --config little.json --nearest --allow-codes 1";
    let said = bench.good(&format!("{specialise} --count 16 --out small"));
    assert!(said.contains("proved within 1 display code over "), "{said}");
    assert!(said.lines().all(|line| line.chars().count() <= 100), "{said}");
    let check = "specialise scenes/model.json --config little.json --allow-codes 1 --check small/certificate.json";
    let held = bench.good(check);
    assert!(held.contains("certificate.json holds: "), "{held}");
    csv_rows(&imported.stdout)
}

/// Every `Ns` of the file is 0: there is no highlight, and that is said.
#[test]
fn a_house_without_exponents() {
    let bench = bench!();
    let rows = through(&bench, "house.obj");
    assert!(rows.len() > 8, "{rows:?}");
    assert!(rows.iter().any(|row| row["material"] == "Wall-out"), "{rows:?}");
    for row in &rows {
        assert_eq!(number(row, "n"), 1.0, "{row:?}");
        assert!(row["file says"] != "Ns 0" || row["remarks"].contains("an exponent of 0"), "{row:?}");
    }
}

#[test]
fn a_cube_with_the_exponent_of_blender() {
    let bench = bench!();
    let rows = through(&bench, "cube.obj");
    let of = |name: &str| rows.iter().find(|row| row["material"] == name).unwrap();
    assert_eq!(number(of("Material"), "n"), 96.078431);
    assert!(of("None")["remarks"].contains("an exponent of 0"), "{rows:?}");
}

#[test]
fn a_hand_of_gltf() {
    let bench = bench!();
    let rows = through(&bench, "hand.glb");
    let roughness = f64::from(0.552_786_4_f32);
    let wanted = 2.0 / roughness.powi(4) - 2.0;
    assert!((number(&rows[0], "n") - wanted).abs() < 1e-4 * wanted, "{rows:?} {wanted}");
    assert!(number(&rows[0], "triangles") > 1000.0, "{rows:?}");
}

#[test]
fn a_box_with_glossiness() {
    let bench = bench!();
    let rows = through(&bench, "box.gltf");
    assert!(rows[0]["file says"].starts_with("glossiness "), "{rows:?}");
    assert!(rows[0]["remarks"].contains("textures"), "{rows:?}");
}
