//! glTF 2.0, as JSON or binary: its triangles become an OBJ file, and its materials those of a scene.
//!
//! | of the file | becomes |
//! |---|---|
//! | triangles, strips and fans of the scene's nodes, each in its place | faces of the OBJ file |
//! | base colour b, metallic m | diffuse b·(1 − m), specular 0.04·(1 − m) + b·m |
//! | roughness r | exponent 2/α² − 2 with α = r², that of Blinn's halfway angle for a lobe of the same width |
//! | `KHR_materials_pbrSpecularGlossiness` | its diffuse and specular colour; r = 1 − glossiness |
//!
//! Textures, lines, points, cameras, lights, skins and animations are not taken; remarks name what was there. The crate
//! `gltf` reads the document; the numbers in its buffers are read here (`accessor.rs`), as a damaged file must give an
//! error and no panic.

mod accessor;
mod buffers;
mod material;
mod obj_text;
mod walk;

use std::io;

use gltf::json::validation::Checked;

use crate::scene::{Angle, Mesh, Normals};

use super::error::ImportError;
use super::framing;
use super::material::without_rows;
use super::wish::{Imported, Wish};
use obj_text::ObjText;

/// A scene of the model in the bytes of a glTF file. `read` gives a buffer's file by the name it has there.
///
/// # Errors
/// Where the document, a buffer or the triangles cannot be used, or there are no triangles.
pub fn gltf(
    wish: &Wish,
    bytes: &[u8],
    read: &mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<Imported, ImportError> {
    let refused = |error: gltf::Error| ImportError::Gltf(error.to_string());
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice_without_validation(bytes).map_err(refused)?;
    let root = document.into_json();
    positions_exist(&root)?;
    let document = gltf::Document::from_json(root).map_err(refused)?;
    let buffers = buffers::all(&document, blob, read)?;
    let mut text = ObjText::new(&wish.name);
    let mut names = material::Names::of(&document);
    walk::scene(&document, &buffers, &mut names, &mut text)?;
    let mut remarks = text.remarks();
    remarks.extend(not_taken(&document));
    let text = text.finish();
    let mesh = Mesh::read(&text, Normals::Smooth)?;
    let drafts = mesh.materials.iter().map(|name| names.draft(name).finish());
    let (materials, treated): (Vec<_>, Vec<_>) = drafts.unzip();
    remarks.extend(without_rows(&materials));
    let corners = mesh.triangles.iter().flat_map(|triangle| triangle.corners);
    let said = format!("Imported from glTF as {}, with camera and light that were chosen", wish.mesh);
    let description = framing::scene(wish, said, corners, materials, Normals::Smooth, Angle::Blinn)?;
    Ok(Imported { description, treated, remarks, mesh: Some(text) })
}

/// What the crate's own validation takes for granted: it would panic.
fn positions_exist(root: &gltf::json::Root) -> Result<(), ImportError> {
    let positions = Checked::Valid(gltf::Semantic::Positions);
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    for index in primitives.filter_map(|primitive| primitive.attributes.get(&positions)) {
        if index.value() >= root.accessors.len() {
            let (index, count) = (index.value(), root.accessors.len());
            return Err(ImportError::Gltf(format!("accessor {index} does not exist; there are {count}")));
        }
    }
    Ok(())
}

/// What the file has and a scene has no place for.
fn not_taken(document: &gltf::Document) -> Vec<String> {
    let counts = [
        (document.animations().count(), "animations"),
        (document.skins().count(), "skins"),
        (document.cameras().count(), "cameras"),
    ];
    let there = counts.into_iter().filter(|&(count, _)| count > 0);
    there.map(|(count, what)| format!("not taken: {count} {what}")).collect()
}

#[cfg(test)]
mod tests;
