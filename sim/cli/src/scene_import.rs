//! `blysk scene import`: a scene of a model that people have.

use std::io::Write;
use std::path::{Component, Path, PathBuf};

use anyhow::{anyhow, bail};
use clap::{Args as ClapArgs, ValueEnum};
use vectors::Staging;
use vectors::output_text::json;
use vectors::text_file::{self, MATERIALS, MESH, MODEL};

use super::out::{Out, Outcome};
use super::output::is_standard_output;
use super::picture_size::size;
use super::table::{Cell, Format, Rows, counted, write_folded};
use scenes::import::{Imported, Library, UpAxis, Wish, gltf, obj};
use scenes::scene::Scene;

/// Make a scene of a model: Wavefront OBJ with its MTL libraries, or glTF 2.0.
///
/// Every material keeps the exponent that the file says (Ns, or 2/α² − 2 with α = roughness²); where the scene has
/// something otherwise than the file, the table says so. The camera is put where the model fills the picture, with
/// one light over its shoulder; both can be edited in the scene. Of a glTF file the triangles go to an OBJ file
/// beside the scene. Exponents that a ROM has no word for: see --nearest of `blysk render`.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk scene import model.obj --out results/model.json\n          \
                        blysk scene import model.glb --size 1920x1080 --out results/model.json")]
pub(super) struct Args {
    /// The model: a file that ends in .obj, .gltf or .glb.
    #[arg(value_name = "MODEL")]
    model: PathBuf,
    /// A library of materials, before those that an OBJ file names itself; may be repeated.
    #[arg(long, value_name = "FILE")]
    mtl: Vec<PathBuf>,
    /// Write the scene to this file.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// The size of the picture in pixels.
    #[arg(long, value_name = "SIZE", value_parser = size, default_value = "1280x720")]
    size: (u32, u32),
    /// The axis of the model that is upwards in the picture.
    #[arg(long, value_enum, default_value_t)]
    up: Up,
    /// How to print the materials.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Up {
    #[default]
    Y,
    Z,
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let shown = args.model.display();
    if is_standard_output(&args.out) {
        bail!("--out -: the paths in a scene start at its directory; give a file (./- where it has that name)");
    }
    let directory = args.out.parent().unwrap_or(Path::new(""));
    let beside = args.out.with_extension("obj");
    let is_obj = extension(&args.model)?;
    let mut inputs = vec![args.model.clone()];
    inputs.extend(args.mtl.iter().cloned());
    let mut staging = Staging::apart_from(&inputs);
    let scene_draft = staging.begin_file(&args.out)?;
    let mesh_draft = if is_obj { None } else { Some(staging.begin_file(&beside)?) };
    let mesh = if is_obj { relative(directory, &args.model)? } else { file_name(&beside) };
    let up = match args.up {
        Up::Y => UpAxis::Y,
        Up::Z => UpAxis::Z,
    };
    let wish = Wish { name: label(&args.model), mesh, size: args.size, up };
    let imported = if is_obj { import_obj(args, &wish)? } else { import_gltf(args, &wish)? };
    let text = json(&imported.description)?;
    // What is written can be read: by the same reader, with the same mesh.
    let scene = Scene::from_json(&text, &mut |_| match &imported.mesh {
        Some(mesh) => Ok(mesh.clone()),
        None => Ok(text_file::text(&args.model, MESH)?),
    })
    .map_err(|error| anyhow!("{shown}: {error}"))?;
    let drafts = [(Some(scene_draft), Some(&text)), (mesh_draft, imported.mesh.as_ref())];
    for (draft, text) in drafts {
        let (Some(mut draft), Some(text)) = (draft, text) else { continue };
        draft.write_all(text.as_bytes()).map_err(|cause| draft.error(cause))?;
        staging.keep(draft)?;
    }
    let written = staging.commit()?;
    print(&imported, &scene, args.format, out)?;
    if matches!(args.format, Format::Table) {
        let names: Vec<String> = written.iter().map(|path| path.display().to_string()).collect();
        write_folded(out, &format!("written to {}", names.join(" and ")))?;
    }
    Ok(Outcome::Good)
}

/// Whether the model is an OBJ file, and no glTF.
fn extension(model: &Path) -> anyhow::Result<bool> {
    match model.extension().map(|extension| extension.to_string_lossy().to_lowercase()).as_deref() {
        Some("obj") => Ok(true),
        Some("gltf" | "glb") => Ok(false),
        _ => bail!("{}: the name ends in no format that is read; use .obj, .gltf or .glb", model.display()),
    }
}

fn import_obj(args: &Args, wish: &Wish) -> anyhow::Result<Imported> {
    let text = text_file::read(&args.model, MESH)?;
    let library =
        |path: &PathBuf| Ok(Library { name: path.display().to_string(), text: text_file::read(path, MATERIALS)? });
    let libraries = args.mtl.iter().map(library).collect::<anyhow::Result<Vec<Library>>>()?;
    let directory = args.model.parent().unwrap_or(Path::new(""));
    let imported = obj(wish, &text, &libraries, &mut |name| Ok(text_file::text(&directory.join(name), MATERIALS)?));
    imported.map_err(|error| error_of(&args.model, &error))
}

fn import_gltf(args: &Args, wish: &Wish) -> anyhow::Result<Imported> {
    if !args.mtl.is_empty() {
        bail!("--mtl: glTF has its materials in itself; leave the option out");
    }
    let bytes = text_file::bytes(&args.model, MODEL);
    let bytes = bytes.map_err(|problem| anyhow!("{}{}", args.model.display(), problem.after_name()))?;
    let directory = args.model.parent().unwrap_or(Path::new(""));
    let imported = gltf(wish, &bytes, &mut |name| Ok(text_file::bytes(&directory.join(name), MODEL)?));
    imported.map_err(|error| error_of(&args.model, &error))
}

/// Texts about the model follow its name; a library has a name of its own.
fn error_of(model: &Path, error: &scenes::import::ImportError) -> anyhow::Error {
    match error {
        scenes::import::ImportError::Library { .. } => anyhow!("{error}"),
        _ => anyhow!("{}{error}", model.display()),
    }
}

fn print(imported: &Imported, scene: &Scene, format: Format, out: &mut Out) -> anyhow::Result<()> {
    let mut rows = Rows::new(&["material", "file says", "n", "triangles", "remarks"]);
    for (index, (material, treated)) in scene.materials.iter().zip(&imported.treated).enumerate() {
        let triangles = scene.surfaces.iter().filter(|surface| usize::from(surface.material) == index).count();
        rows.push(vec![
            material.name.as_str().into(),
            treated.said.as_str().into(),
            Cell::Exponent(material.exponent),
            Cell::Integer(triangles as i64),
            treated.remarks.join("; ").into(),
        ]);
    }
    rows.print(out, format, 6)?;
    if matches!(format, Format::Table) {
        writeln!(out)?;
        for remark in &imported.remarks {
            write_folded(out, remark)?;
        }
        let (materials, surfaces) = (scene.materials.len(), scene.surfaces.len());
        write_folded(out, &format!("{}, {}", counted(materials, "material"), counted(surfaces, "triangle")))?;
    }
    Ok(())
}

/// The model's name without what a scene's name may not have.
fn label(model: &Path) -> String {
    let stem = model.file_stem().unwrap_or_default().to_string_lossy();
    let kept = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let label: String = stem.chars().map(|c| if kept(c) { c } else { '_' }).take(100).collect();
    let label = label.trim_start_matches('-');
    if label.is_empty() { "model".to_owned() } else { label.to_owned() }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The path of a file from a directory, which need not be there yet.
fn relative(directory: &Path, file: &Path) -> anyhow::Result<String> {
    // The directory of a mere name is the empty path.
    let directory = if directory.as_os_str().is_empty() { Path::new(".") } else { directory };
    let [from, to] = [directory, file].map(std::path::absolute);
    let (from, to) = (plain(&from?), plain(&to?));
    let shared = from.iter().zip(&to).take_while(|(one, other)| one == other).count();
    let up = from.iter().skip(shared).map(|_| "..".to_owned());
    let down = to.iter().skip(shared).cloned();
    Ok(up.chain(down).collect::<Vec<String>>().join("/"))
}

/// The names on an absolute path, `..` followed as text.
fn plain(path: &Path) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for component in path.components() {
        match component {
            Component::ParentDir => drop(names.pop()),
            Component::Normal(name) => names.push(name.to_string_lossy().into_owned()),
            _ => {}
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_starts_at_the_scenes_directory() {
        for (directory, file, wanted) in [
            ("results", "models/a b.obj", "../models/a b.obj"),
            ("", "model.obj", "model.obj"),
            ("results/../x", "x/model.obj", "model.obj"),
            ("/r", "/m/n.obj", "../m/n.obj"),
        ] {
            assert_eq!(relative(Path::new(directory), Path::new(file)).unwrap(), wanted, "{directory} {file}");
        }
    }

    #[test]
    fn a_label_is_one_that_a_scene_can_have() {
        for (model, wanted) in [("a b.obj", "a_b"), ("-x.glb", "x"), ("ü.obj", "_"), ("--.obj", "model")] {
            assert_eq!(label(Path::new(model)), wanted);
        }
    }
}
