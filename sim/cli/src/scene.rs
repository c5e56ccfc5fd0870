//! `blysk scene`: look at a scene without rendering it, and the schema of scenes.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::{Args as ClapArgs, Subcommand};
use vectors::text_file::{self, MESH, SCENE};

use super::out::{Out, Outcome};
use super::scene_import;
use super::table::{Cell, Format, Rows, counted, write_folded};
use scenes::scene::{Scene, Shape, schema};

/// Check a scene and list its materials, or print the JSON schema of scenes.
///
/// The scene is read as `blysk render` reads it, meshes included; what it would refuse is refused here. For every
/// material the table has its exponent and how many spheres, planes and triangles are made of it. `blysk scene import`
/// makes a scene of a model.
#[derive(ClapArgs)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
#[command(after_help = "Examples: blysk scene scene.json\n          blysk scene --schema > schema.json\n          \
                        blysk scene import model.obj --out scene.json")]
pub(super) struct Args {
    #[command(subcommand)]
    action: Option<Action>,
    /// The scene, as JSON.
    #[arg(value_name = "FILE", required_unless_present = "schema")]
    scene: Option<PathBuf>,
    /// Print the JSON schema of scenes.
    #[arg(long, conflicts_with_all = ["scene", "format"])]
    schema: bool,
    /// How to print the materials.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// What else can be done with scenes. What each does is said at its arguments.
#[derive(Subcommand)]
enum Action {
    Import(scene_import::Args),
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    if let Some(Action::Import(args)) = &args.action {
        return scene_import::run(args, out);
    }
    let Some(path) = &args.scene else {
        out.write_all(schema().as_bytes())?;
        return Ok(Outcome::Good);
    };
    let scene = load(path)?.scene;
    rows(&scene).print(out, args.format, 6)?;
    if matches!(args.format, Format::Table) {
        let (image, lights) = (&scene.image, scene.lights.len());
        let said = format!(
            "{}: {} × {} pixels of {} bits, {}, {}",
            scene.name,
            image.width,
            image.height,
            image.display_bits,
            counted(lights, "light"),
            counted(scene.surfaces.len(), "surface"),
        );
        writeln!(out)?;
        write_folded(out, &said)?;
    }
    Ok(Outcome::Good)
}

fn rows(scene: &Scene) -> Rows {
    let mut rows = Rows::new(&["material", "n", "spheres", "planes", "triangles"]);
    for (index, material) in scene.materials.iter().enumerate() {
        let mut counts = [0; 3];
        for surface in scene.surfaces.iter().filter(|s| usize::from(s.material) == index) {
            counts[match surface.shape {
                Shape::Sphere { .. } => 0,
                Shape::Plane { .. } => 1,
                Shape::Triangle(_) => 2,
            }] += 1;
        }
        let mut cells = vec![material.name.as_str().into(), Cell::Exponent(material.exponent)];
        cells.extend(counts.map(Cell::Integer));
        rows.push(cells);
    }
    rows
}

/// A scene that was read.
pub(super) struct Loaded {
    pub(super) scene: Scene,
    /// The files that it was read from: its own, and those of its meshes.
    pub(super) files: Vec<PathBuf>,
}

/// Reads a scene. Paths of meshes start at its directory.
pub(super) fn load(path: &Path) -> anyhow::Result<Loaded> {
    let shown = path.display();
    let text = text_file::read(path, SCENE)?;
    let directory = path.parent().unwrap_or(Path::new(""));
    let mut files = vec![path.to_owned()];
    let scene = Scene::from_json(&text, &mut |file| {
        let mesh = directory.join(file);
        files.push(mesh.clone());
        Ok(text_file::text(&mesh, MESH)?)
    });
    Ok(Loaded { scene: scene.with_context(|| shown.to_string())?, files })
}

/// The scene in another size.
pub(super) fn resized(scene: &mut Scene, size: Option<(u32, u32)>) -> anyhow::Result<()> {
    if let Some((width, height)) = size
        && let Err(problem) = scene.resize(width, height)
    {
        bail!("--size {width}x{height}: {problem}");
    }
    Ok(())
}
