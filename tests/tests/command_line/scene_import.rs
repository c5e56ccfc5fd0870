//! `blysk scene import`: models as people have them become scenes that render.

use blysk_tests::bench;
use blysk_tests::cli::{Bench, csv_rows};

const MODEL: &str = "mtllib materials/own.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl Dull steel\nf 1 3 2\n\
                     f 1 2 4\nusemtl chalk\nf 1 4 3\nusemtl gold\nf 2 3 4\n";
const LIBRARY: &str = "newmtl Dull steel\nNs 3.4\nKd 0.2 0.2 0.2\nKs 0.9 0.9 0.9\nnewmtl chalk\nNs 0\nKs 1 1 1\n";

fn prepared() -> Bench {
    let bench = bench!();
    for directory in ["models", "models/materials"] {
        std::fs::create_dir(bench.path(directory)).unwrap();
    }
    bench.write("models/a b.obj", MODEL);
    bench.write("models/materials/own.mtl", LIBRARY);
    bench
}

fn import(bench: &Bench, more: &[&str]) -> blysk_tests::cli::Run {
    let words = ["scene", "import", "models/a b.obj", "--size", "64x48", "--out", "scenes/a.json", "--format", "csv"];
    bench.run_list(&[&words, more].concat())
}

#[test]
fn a_model_with_its_libraries_becomes_a_scene() {
    let bench = prepared();
    let run = import(&bench, &[]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    let rows = csv_rows(&run.stdout);
    let column = |name: &str| rows.iter().map(|row| row[name].clone()).collect::<Vec<String>>();
    assert_eq!(column("material"), ["Dull steel", "chalk", "gold"]);
    assert_eq!(column("n").iter().map(|n| n.parse::<f64>().unwrap()).collect::<Vec<f64>>(), [3.4, 1.0, 1.0]);
    assert_eq!(column("triangles"), ["2", "1", "1"]);
    let remarks = column("remarks");
    assert!(remarks[0].is_empty() && remarks[1].contains("exponent of 0") && remarks[2].contains("no library"));

    // A library that is not there is named with the line that names it, and so is what presets have no row for.
    bench.write("models/a b.obj", MODEL.replace("own.mtl", "lost.mtl"));
    let said =
        bench.run_list(&["scene", "import", "models/a b.obj", "--mtl", "models/materials/own.mtl", "--out", "b.json"]);
    for says in ["line 1: the library \"materials/lost.mtl\"", "1 of 3 exponents is no whole number", "(line 11)"] {
        assert!(said.stdout.replace("\n", " ").contains(says), "{says}: {}", said.stdout);
    }

    // The ROM has no word for 3.4: the nearest by ratio is that of 3.
    let refused = bench.run_list(&["render", "scenes/a.json", "--config", "small.json"]);
    assert_eq!(refused.status, 2);
    assert!(refused.stderr.contains("--nearest"), "{}", refused.stderr);
    let rendered = bench.run_list(&["render", "scenes/a.json", "--config", "small.json", "--nearest"]);
    assert_eq!(rendered.status, 0, "{}", rendered.stderr);
    assert!(rendered.stdout.contains("Dull steel (n = 3.4) by the row of 3"), "{}", rendered.stdout);
}

#[test]
fn a_library_of_ones_own_counts_first() {
    let bench = prepared();
    bench.write("own.mtl", "newmtl Dull steel\nNs 2\nKs 1 1 1\n");
    let run = import(&bench, &["--mtl", "own.mtl"]);
    assert_eq!(csv_rows(&run.stdout)[0]["n"], "2", "{}", run.stderr);
}

#[test]
fn what_cannot_be_read_is_named_and_nothing_is_written() {
    let bench = prepared();
    bench.write("wrong.mtl", "newmtl Dull steel\nNs three\n");
    bench.write("model.stl", "solid\n");
    bench.write("broken.glb", "glTF");
    bench.write("flat.obj", "v 0 0 0\nf 1 1 1\n");
    for (words, says) in [
        (vec!["models/a b.obj", "--mtl", "wrong.mtl"], "wrong.mtl:2: \"three\" is not a number"),
        (vec!["models/a b.obj", "--mtl", "none.mtl"], "none.mtl"),
        (vec!["model.stl"], ".obj, .gltf or .glb"),
        (vec!["broken.glb"], "broken.glb"),
        (vec!["broken.glb", "--mtl", "wrong.mtl"], "has its materials in itself"),
        (vec!["flat.obj"], "flat.obj:2"),
        (vec!["none.obj"], "none.obj"),
    ] {
        let before = bench.tree("");
        let run = bench.run_list(&[&["scene", "import"], &words[..], &["--out", "new/scene.json"]].concat());
        assert_eq!(run.status, 2, "{words:?}");
        assert!(run.stderr.contains(says), "{words:?}: {}", run.stderr);
        assert!(bench.tree("") == before, "{words:?}");
    }
    let run = bench.run_list(&["scene", "import", "models/a b.obj", "--out", "-"]);
    assert_eq!(run.status, 2);
}
