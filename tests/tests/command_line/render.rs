//! `blysk render`, `blysk scene` and `blysk mesh`: pictures, figures, and the same bytes every time.

use std::path::{Path, PathBuf};

use blysk_tests::bench;
use blysk_tests::cli::{Bench, csv_rows, number};
use serde_json::Value;

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scenes").join(format!("{name}.json"))
}

fn good(bench: &Bench, arguments: &[&str]) -> String {
    let run = bench.run_list(arguments);
    assert!(run.status == 0 && run.stderr.is_empty(), "{run:#?}");
    let text = !arguments.contains(&"--format");
    assert!(!text || run.stdout.lines().all(|line| line.chars().count() <= 100), "{run:#?}");
    run.stdout
}

fn rendered(bench: &Bench, name: &str, more: &[&str]) -> String {
    let path = scene(name);
    good(bench, &[&["render", path.to_str().unwrap()], more].concat())
}

const FILES: [&str; 7] =
    ["difference.png", "methods.png", "pipeline.png", "reference.png", "render.csv", "render.json", "render.sha256"];

struct Png {
    width: usize,
    height: usize,
    samples: Vec<u16>,
    wide: bool,
}

fn png(bytes: &[u8]) -> Png {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut buffer).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    let wide = info.bit_depth == png::BitDepth::Sixteen;
    let samples = match wide {
        true => buffer.as_chunks::<2>().0.iter().map(|&pair| u16::from_be_bytes(pair)).collect(),
        false => buffer.iter().map(|&byte| byte.into()).collect(),
    };
    Png { width: info.width as usize, height: info.height as usize, samples, wide }
}

/// Files are the same whatever the number of threads, run after run, and hold no time.
#[test]
fn the_same_command_writes_the_same_bytes() {
    let bench = bench!();
    let path = scene("torus_knot");
    let mut trees = Vec::new();
    for (threads, directory) in [("1", "one"), ("3", "three"), ("1", "again")] {
        let arguments = ["render", path.to_str().unwrap(), "--preset", "paper"];
        let size = ["--size", "200x113", "--out", directory];
        let mut command = bench.command(&[&arguments[..], &size[..]].concat());
        let output = command.env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        trees.push(bench.tree(directory));
    }
    let names: Vec<_> = trees[0].keys().map(|name| name.to_str().unwrap()).collect();
    assert_eq!(names, FILES);
    assert!(trees[0] == trees[1] && trees[0] == trees[2]);
    let json = bench.text("one/render.json");
    assert!(!json.contains("time") && !json.contains("seconds\""), "{json}");
}

#[test]
fn figures_are_those_of_the_pictures() {
    let bench = bench!();
    for (name, preset) in [("one_material", "paper"), ("low_exponents", "compact")] {
        let more = ["--preset", preset, "--size", "120x90", "--out", "r", "--clock-mhz", "50"];
        let text = rendered(&bench, name, &more);
        let [one, other] = ["pipeline", "reference"].map(|n| png(&bench.read(&format!("r/{n}.png"))));
        let figures: Value = serde_json::from_str(&bench.text("r/render.json")).unwrap();
        let of = |pointer: &str| figures.pointer(pointer).unwrap().as_f64().unwrap();
        let greatest = f64::from((1_u32 << figures["display_bits"].as_u64().unwrap()) - 1);
        assert_eq!(one.wide, figures["display_bits"] != 8);
        let full = if one.wide { 65_535.0 } else { 255.0 };
        let code = |sample: u16| (f64::from(sample) * greatest / full).round();
        let pairs = one.samples.iter().zip(&other.samples);
        let errors: Vec<f64> = pairs.map(|(&a, &b)| (code(a) - code(b)).abs()).collect();
        assert_eq!((one.width, one.height, errors.len()), (120, 90, 120 * 90 * 3));
        let count = errors.len() as f64;
        assert_eq!(of("/picture/greatest"), errors.iter().fold(0.0, |a: f64, &b| a.max(b)));
        assert!((of("/picture/mean") - errors.iter().sum::<f64>() / count).abs() < 1e-12);
        let square = errors.iter().map(|e| e * e).sum::<f64>() / count;
        assert!((of("/picture/psnr") - 20.0 * (greatest / square.sqrt()).log10()).abs() < 1e-9);
        let rows = csv_rows(&bench.text("r/render.csv"));
        let sum = |column: &str| rows.iter().map(|row| number(row, column)).sum::<f64>();
        let parts = ["epicentre", "below_epicentre", "zero", "facing_away"].map(sum);
        assert_eq!(parts.iter().sum::<f64>(), sum("samples"));
        assert_eq!(sum("samples") + of("/background_pixels"), 120.0 * 90.0);
        assert_eq!(of("/every/requests"), sum("samples"));
        assert_eq!(of("/needed/requests"), sum("epicentre") + sum("below_epicentre"));
        let latency = of("/needed/cycles") - of("/needed/requests");
        assert!((6.0..40.0).contains(&latency), "{latency}");
        assert!((of("/needed/frames_per_second") * of("/needed/cycles") - 50e6).abs() < 1.0);
        assert!(text.contains("every bit is the same"), "{text}");
        // The same figures on standard output.
        let json = rendered(&bench, name, &[&more[..4], &more[6..], &["--format", "json"]].concat());
        assert_eq!(json, bench.text("r/render.json"));
        let csv = rendered(&bench, name, &[&more[..4], &["--format", "csv"]].concat());
        assert_eq!(csv, bench.text("r/render.csv"));
    }
}

/// The highlight of a ball under a light is round, and nothing shines on the far side.
#[test]
fn the_highlight_of_a_ball_is_round_and_alone() {
    let bench = bench!();
    let text = std::fs::read_to_string(scene("one_material")).unwrap();
    // Lit from the camera, with nothing but the highlight to be seen, in codes that are light.
    let alone = text
        .replace("[-0.5, 0.6, 0.9]", "[0, 0, 1]")
        .replace("[0.03, 0.012, 0.008]", "[0, 0, 0]")
        .replace("[0.35, 0.14, 0.09]", "[0, 0, 0]")
        .replace("\"height\": 360", "\"height\": 360, \"transfer\": \"linear\"");
    bench.write("alone.json", &alone);
    for preset in ["paper", "compact", "precise"] {
        let more = ["render", "alone.json", "--preset", preset, "--size", "101x101", "--out", "r"];
        let _said = good(&bench, &more);
        let picture = png(&bench.read("r/pipeline.png"));
        let at = |column: usize, row: usize| picture.samples[3 * (row * picture.width + column)];
        let mut last = at(50, 50);
        assert!(last > 150, "{preset}: {last}");
        for step in 0..=50 {
            let here = at(50 + step, 50);
            for (column, row) in [(50 - step, 50), (50, 50 + step), (50, 50 - step)] {
                assert!(at(column, row).abs_diff(here) <= 1, "{preset}: not round at {step}");
            }
            assert!(here <= last + 1, "{preset}: brighter again at {step}");
            last = here;
        }
        assert_eq!(at(0, 0), 0);
        // From behind, the ball has no highlight at all.
        bench.write("behind.json", alone.replace("\"towards\": [0, 0, 1]", "\"towards\": [0, 0, -1]"));
        let _said = good(&bench, &["render", "behind.json", "--preset", preset, "--out", "r"]);
        assert!(png(&bench.read("r/pipeline.png")).samples.iter().all(|&code| code == 0));
    }
}

/// With samples in a row of a pixel the picture is their mean, and every other file is as without.
#[test]
fn a_smooth_picture_for_looking() {
    let bench = bench!();
    let linear = std::fs::read_to_string(scene("one_material")).unwrap();
    let linear = linear.replace("\"height\": 360", "\"height\": 360, \"transfer\": \"linear\"");
    bench.write("linear.json", linear);
    let one = "render linear.json --preset compact --size 40x30 --out";
    let _said = bench.good(&format!("{one} one"));
    let _said = bench.good(&format!("{one} four --samples-per-pixel 4"));
    let _said = bench.good("render linear.json --preset compact --size 80x60 --out large");
    for name in FILES.iter().filter(|name| !name.ends_with("sha256")) {
        assert!(bench.read(&format!("one/{name}")) == bench.read(&format!("four/{name}")), "{name}");
    }
    let [smooth, large] = ["four/smooth.png", "large/pipeline.png"].map(|name| png(&bench.read(name)));
    assert_eq!((smooth.width, smooth.height), (40, 30));
    for (index, &code) in smooth.samples.iter().enumerate() {
        let (pixel, colour) = (index / 3, index % 3);
        let at = |row: usize, column: usize| f64::from(large.samples[3 * (row * 80 + column) + colour]);
        let (row, column) = (2 * (pixel / 40), 2 * (pixel % 40));
        let mean = (at(row, column) + at(row, column + 1) + at(row + 1, column) + at(row + 1, column + 1)) / 4.0;
        assert!((mean - f64::from(code)).abs() <= 1.0, "{index}: {mean} {code}");
    }
    bench.refused("render linear.json --preset compact --out x --samples-per-pixel 5", &["square number"]);
}

/// Several pipelines beside each other: the figures of each are those that it has alone.
#[test]
fn pipelines_are_compared() {
    let bench = bench!();
    let more = ["--compare", "paper,precise", "--size", "96x72", "--out", "both"];
    let said = rendered(&bench, "one_material", &more);
    assert!(said.contains("pipeline") && said.contains("precise"), "{said}");
    let rows = csv_rows(&bench.text("both/compare.csv"));
    assert_eq!(rows.iter().map(|row| row["configuration"].as_str()).collect::<Vec<_>>(), ["paper", "precise"]);
    for row in &rows {
        let name = row["configuration"].as_str();
        let alone = rendered(&bench, "one_material", &["--preset", name, "--size", "96x72", "--format", "json"]);
        let alone: Value = serde_json::from_str(&alone).unwrap();
        assert_eq!(number(row, "picture_greatest_codes"), alone["picture"]["greatest"].as_f64().unwrap());
        assert_eq!(number(row, "picture_pixels"), alone["picture"]["pixels"].as_f64().unwrap());
        assert!((number(row, "picture_psnr_db") - alone["picture"]["psnr"].as_f64().unwrap()).abs() < 1e-9);
        let linear = alone["materials"][0]["highlight_greatest_codes"].as_f64().unwrap();
        assert!((number(row, "highlight_greatest_linear_codes") - linear).abs() < 1e-9);
    }
    let [paper, precise] = [0, 1].map(|index| number(&rows[index], "picture_greatest_codes"));
    assert!(precise < paper, "{rows:?}");
    let sheet = png(&bench.read("both/compare.png"));
    assert!(sheet.width > 3 * 96 && sheet.height > 2 * 72);
    bench.refused_list(&["render", scene("one_material").to_str().unwrap()], &["--preset"]);
    bench.refused_list(&["render", scene("one_material").to_str().unwrap(), "--compare", "none"], &["none"]);
}

/// Frames a second follow from the clock that the ranks of each pipeline reach, or from the one that is stated.
#[test]
fn clocks_are_those_of_the_pipelines() {
    let bench = bench!();
    let least = |preset: &str, device: &str| {
        let paths = bench.good(&format!("clock --preset {preset} --device {device} --format csv"));
        csv_rows(&paths).iter().map(|row| number(row, "MHz")).fold(f64::INFINITY, f64::min)
    };
    let more = ["--compare", "compact,paper", "--size", "24x18", "--out", "r"];
    for (device, stated) in [("ecp5", None), ("up5k", None), ("ecp5", Some("70"))] {
        let how = stated.map_or(["--device", device], |mhz| ["--clock-mhz", mhz]);
        let said = rendered(&bench, "one_material", &[&more[..], &how].concat());
        let report: Value = serde_json::from_str(&bench.text("r/render.json")).unwrap();
        assert_eq!(report["clock_device"].as_str(), stated.is_none().then_some(device), "{said}");
        for (row, preset) in csv_rows(&bench.text("r/compare.csv")).iter().zip(["compact", "paper"]) {
            let mhz = stated.map_or_else(|| least(preset, device), |mhz| mhz.parse().unwrap());
            assert!((number(row, "clock_mhz") / mhz - 1.0).abs() < 1e-9, "{preset} on {device}: {row:?}, {mhz}");
            let cycles = report["needed"]["requests"].as_f64().unwrap() + number(row, "latency");
            let frames = number(row, "frames_per_second");
            // `paper` needs more samples than `compact`, whose report this is.
            assert!(preset == "paper" || (frames * cycles / (mhz * 1e6) - 1.0).abs() < 1e-9, "{row:?}, {report}");
        }
    }
    // A table of delays is read, and not written over.
    let delays = include_str!("../../../hw-model/src/clock/up5k.json");
    std::fs::create_dir(bench.path("s")).unwrap();
    bench.write("s/render.json", delays);
    let over = ["--preset", "paper", "--device", "s/render.json", "--out", "s"];
    let one_material = scene("one_material");
    bench.refused_list(
        &[&["render", one_material.to_str().unwrap()], &over[..]].concat(),
        &["render.json is an input of this command"],
    );
    assert_eq!(bench.text("s/render.json"), delays);
    let twice = "--compare paper --clock-mhz 70 --device ecp5";
    let scene = scene("one_material");
    bench.refused_list(
        &[&["render", scene.to_str().unwrap()], &twice.split(' ').collect::<Vec<_>>()[..]].concat(),
        &["--device"],
    );
}

/// A mesh of our own in a scene of our own.
#[test]
fn a_mesh_of_our_own() {
    let bench = bench!();
    let said = bench.good("mesh --along 40 --sides 8 --out meshes/knot.obj");
    assert_eq!(said, "640 triangles, written to meshes/knot.obj\n");
    let shown = bench.good("mesh --along 40 --sides 8");
    assert_eq!(shown, bench.text("meshes/knot.obj"));
    let text = std::fs::read_to_string(scene("torus_knot")).unwrap();
    std::fs::create_dir(bench.path("scenes")).unwrap();
    // Relative to the scene, and not to where the command runs.
    bench.write("scenes/s.json", text.replace("torus_knot.obj", "../meshes/knot.obj"));
    let table = bench.good("scene scenes/s.json");
    assert!(table.contains("640") && table.contains("copper"), "{table}");
    let csv = bench.good("scene scenes/s.json --format csv");
    assert_eq!(csv.lines().nth(1), Some("copper,48,0,0,640"));
    let said = bench.good("render scenes/s.json --preset compact --size 64x36");
    assert!(said.contains("MHz, estimated for ecp5") && said.contains("torus_knot"), "{said}");
    let schema = bench.good("scene --schema");
    let kept = std::fs::read_to_string(scene("torus_knot").with_file_name("../scene.schema.json"));
    assert_eq!(schema, kept.unwrap());
}

#[test]
fn pictures_of_any_size() {
    let bench = bench!();
    for size in ["1x1", "1x700", "700x1", "3x2"] {
        let more = ["--preset", "schlick", "--size", size, "--out", size];
        let said = rendered(&bench, "one_material", &more);
        assert!(said.contains("one_material"), "{said}");
        let (width, height) = size.split_once('x').unwrap();
        let picture = png(&bench.read(&format!("{size}/reference.png")));
        assert_eq!([picture.width, picture.height].map(|n| n.to_string()), [width, height]);
    }
}

/// What `make pictures` would write is what is there.
#[test]
fn the_pictures_of_the_documents_are_current() {
    let bench = bench!();
    let documents = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/pictures");
    for (name, size, pictures) in [
        ("torus_knot", "480x270", &[("pipeline.png", "torus_knot_paper.png")][..]),
        ("one_material", "240x180", &[("methods.png", "one_material_methods.png")]),
        (
            "many_materials",
            "480x300",
            &[("pipeline.png", "many_materials_paper.png"), ("difference.png", "many_materials_difference.png")],
        ),
    ] {
        let more = ["--preset", "paper", "--size", size, "--out", name];
        let _said = rendered(&bench, name, &more);
        for (made, kept) in pictures {
            let kept_bytes = std::fs::read(documents.join(kept)).unwrap();
            assert!(bench.read(&format!("{name}/{made}")) == kept_bytes, "{kept} is stale: make pictures");
        }
    }
}
