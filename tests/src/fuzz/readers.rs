//! Targets that read text: configurations, lists of exponents, scenes, meshes, tables.

use std::io;

use analysis::pareto::synthesis;
use analysis::report::pareto as tables;
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::exponents::{Exponents, parse_exponent};
use hw_model::fit::Method;
use hw_model::format::QFormat;
use scenes::render::{ScenePipeline, Which, samples};
use scenes::scene::{Normals, Scene, triangles};
use scenes::specialise::demands;
use vectors::Strategy;

use super::{Outcome, Place};

/// Hardware of more rows is not made: that takes its time, and finds nothing that fewer do not.
const MOST_ROWS: usize = 16;
/// x that are evaluated in every row.
const SOME_X: i64 = 16;

/// A configuration: checked, written and read again, and made into hardware.
pub fn configuration(bytes: &[u8], _: &Place) -> Outcome {
    let Ok(text) = std::str::from_utf8(bytes) else { return Outcome::Refused };
    let Ok(config) = Config::from_json(text) else { return Outcome::Refused };
    let again = Config::from_json(&config.to_json());
    assert_eq!(again.ok().as_ref(), Some(&config), "what was written is read again");
    if config.exponents.len() <= MOST_ROWS
        && let Ok(design) = Design::new(config)
    {
        evaluate(&design);
    }
    Outcome::Accepted
}

/// Some x in every row, and where there is no row; 0 and 1 among them.
pub fn evaluate(design: &Design) {
    let input = design.config().input;
    let (low, high) = (i128::from(input.min_bits()), i128::from(input.max_bits()));
    let one = design.datapath().output_one();
    for address in 0..=design.rom().depth() as u32 {
        for step in 0..=SOME_X {
            let x = low + (high - low) * i128::from(step) / i128::from(SOME_X);
            let intensity = design.datapath().evaluate(address, x as i64).intensity;
            assert!((0..=one).contains(&intensity), "n {address}, x {x}: {intensity}");
        }
    }
}

/// What is written on the command line: lists of exponents, exponents, formats, methods, strategies.
pub fn exponents(bytes: &[u8], _: &Place) -> Outcome {
    let Ok(text) = std::str::from_utf8(bytes) else { return Outcome::Refused };
    let mut outcome = Outcome::Refused;
    for line in text.lines() {
        if let Ok(list) = line.parse::<Exponents>() {
            assert_eq!(list.to_string().parse::<Exponents>().as_ref(), Ok(&list));
            outcome = Outcome::Accepted;
        }
        if let Ok(format) = line.parse::<QFormat>() {
            assert_eq!(format.to_string().parse::<QFormat>().as_ref(), Ok(&format));
            assert!(format.holds(format.min_bits().into()) && format.holds(format.max_bits().into()));
        }
        let _ = parse_exponent(line);
        let _ = line.parse::<Method>();
        let _ = line.parse::<Strategy>();
    }
    outcome
}

const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";

/// A scene: checked, made small, seen, bounded, and its highlights computed.
pub fn scene(bytes: &[u8], place: &Place) -> Outcome {
    let Ok(text) = std::str::from_utf8(bytes) else { return Outcome::Refused };
    let mesh = &mut |name: &str| match name.len() {
        1..=100 => Ok(MESH.to_owned()),
        _ => Err(io::Error::from(io::ErrorKind::NotFound)),
    };
    let Ok(mut scene) = Scene::from_json(text, mesh) else { return Outcome::Refused };
    if scene.resize(6, 4).is_err() || scene.surfaces.len() * scene.lights.len() > 16 {
        return Outcome::Accepted;
    }
    let found = samples(&scene, &std::sync::atomic::AtomicU64::new(0));
    for demand in demands(&scene) {
        assert!(demand.least <= demand.greatest, "{demand:?}");
    }
    if let Ok(pipeline) = ScenePipeline::new(&place.design, &scene) {
        let _ = pipeline.answers(&found, Which::Needed);
    }
    Outcome::Accepted
}

/// A mesh, smooth and flat.
pub fn obj(bytes: &[u8], _: &Place) -> Outcome {
    let text = String::from_utf8_lossy(bytes);
    let flat = triangles(&text, Normals::Flat);
    let smooth = triangles(&text, Normals::Smooth);
    for triangle in flat.iter().chain(&smooth).flatten() {
        assert!(triangle.plane_normal().length() > 0.0, "{triangle:?}");
    }
    Outcome::of(&flat)
}

/// The tables that `blysk pareto` reads again.
pub fn pareto(bytes: &[u8], _: &Place) -> Outcome {
    let Ok(text) = std::str::from_utf8(bytes) else { return Outcome::Refused };
    let (table, synthesis) = (tables::read(text), synthesis::read(text));
    match table.is_ok() || synthesis.is_ok() {
        true => Outcome::Accepted,
        false => Outcome::Refused,
    }
}
