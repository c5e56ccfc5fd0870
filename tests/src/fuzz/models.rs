//! Targets that read models as people have them: libraries of materials, and glTF.

use std::io;

use scenes::import::{Imported, Library, UpAxis, Wish, gltf as of_gltf, obj as of_obj};
use scenes::scene::Scene;
use vectors::output_text::json;

use super::{Outcome, Place};

/// A model whose faces have the materials that libraries of the corpus tell of.
const MODEL: &str = "mtllib library.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nusemtl steel\nf 1 2 4\n\
                     usemtl dull brass\nf 2 3 4\n";

fn wish() -> Wish {
    Wish { name: "model".into(), mesh: "model.obj".into(), size: (6, 4), up: UpAxis::Y }
}

/// A library of materials beside a model.
pub fn mtl(bytes: &[u8], _: &Place) -> Outcome {
    let text = String::from_utf8_lossy(bytes).into_owned();
    let own = Library { name: "own.mtl".into(), text: text.clone() };
    let named = of_obj(&wish(), MODEL, &[], &mut |_| Ok(text.clone()));
    let given = of_obj(&wish(), MODEL, &[own], &mut |_| Err(io::ErrorKind::NotFound.into()));
    assert_eq!(named.is_ok(), given.is_ok(), "a library is the same wherever it comes from");
    if let Ok(imported) = &named {
        is_a_scene(imported, MODEL);
    }
    Outcome::of(&named)
}

/// A document of glTF, as JSON or binary.
pub fn gltf(bytes: &[u8], _: &Place) -> Outcome {
    let imported = of_gltf(&wish(), bytes, &mut |_| Err(io::ErrorKind::NotFound.into()));
    if let Ok(imported) = &imported {
        is_a_scene(imported, imported.mesh.as_deref().unwrap_or_default());
    }
    Outcome::of(&imported)
}

/// What was made is read as `blysk render` reads it, and every material has its row of the table.
fn is_a_scene(imported: &Imported, mesh: &str) {
    let text = json(&imported.description).expect("a scene is JSON");
    let scene = Scene::from_json(&text, &mut |_| Ok(mesh.to_owned())).expect("a scene that can be read");
    assert_eq!(scene.materials.len(), imported.treated.len());
}
