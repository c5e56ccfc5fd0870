//! Meshes as exporters write them (`tests/data/meshes`): read, and the same picture as the plain file's.

use std::fs;
use std::path::{Path, PathBuf};

use blysk_tests::bench;
use blysk_tests::cli::{Bench, csv_rows, number};

const SCENE: &str = r#"{
  "name": "probe",
  "image": {"width": 96, "height": 72},
  "camera": {"position": [0, 0, 6], "look_at": [0, 0, 0], "field_of_view_degrees": 40},
  "lights": [{"directional": {"towards": [0.3, 0.4, 0.9], "colour": [1, 1, 1]}}],
  "materials": [
    {"name": "m", "exponent": 8, "diffuse": [0.2, 0.2, 0.2], "specular": [1, 1, 1]}
  ],
  "geometry": [{"mesh": {"file": "m.obj", "material": "m"}}]
}
"#;

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/meshes")
}

/// The samples that show the mesh, and the picture of x^n.
fn picture(bench: &Bench, mesh: impl AsRef<[u8]>) -> (f64, Vec<u8>) {
    bench.write("m.obj", mesh);
    bench.write("scene.json", SCENE);
    let said = bench.good("render scene.json --config small.json --out out --format csv");
    let rows = csv_rows(&said);
    (number(&rows[0], "samples"), bench.read("out/reference.png"))
}

fn mesh(name: &str) -> Vec<u8> {
    fs::read(data().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Every file of the directory is one square, or one L, and must look like it.
#[test]
fn what_exporters_write_is_one_square() {
    let bench = bench!();
    let square = picture(&bench, mesh("quad.obj"));
    let l = picture(&bench, mesh("L_quads.obj"));
    assert!(square.0 > l.0 && l.0 > 100.0, "{} {}", square.0, l.0);
    let mut names: Vec<String> =
        fs::read_dir(data()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names.len(), 26, "{names:?}");
    for name in names {
        let wanted = if name.starts_with("L_") { &l } else { &square };
        let found = picture(&bench, mesh(&name));
        assert!(found == *wanted, "{name}: {} samples, not {}", found.0, wanted.0);
    }
}

/// The vertex behind a mark counts: with a vertex to spare its loss would draw another triangle.
#[test]
fn a_mark_takes_no_vertex() {
    let bench = bench!();
    let spare = b"v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\n".to_vec();
    let marked = [&b"\xef\xbb\xbf"[..], &spare].concat();
    assert_eq!(picture(&bench, spare), picture(&bench, marked));
}

#[test]
fn groups_cut_no_normals() {
    let bench = bench!();
    let _made = bench.good("mesh --along 24 --sides 8 --out knot.obj");
    let plain = bench.text("knot.obj");
    let faces: Vec<usize> = plain.match_indices("\nf ").map(|(place, _)| place).collect();
    let grouped = |line: &str| {
        let mut text = plain.clone();
        for &place in faces.iter().rev().step_by(40) {
            text.insert_str(place, &format!("\n{line}"));
        }
        text
    };
    let wanted = picture(&bench, &plain);
    for line in ["g part", "o part", "usemtl part", "s 1", "g"] {
        assert!(picture(&bench, grouped(line)) == wanted, "{line}");
    }
}
