//! Scenes out of the files that people have: a Wavefront OBJ with its libraries of materials, or glTF 2.0.
//!
//! ```text
//! model.obj ─┬► materials that its faces name ─► mtl (libraries) ─► material ─┐
//!            └► places of its corners ─► framing (camera, light) ─────────────┴► Description ─► scene.json
//! model.gltf ─► gltf: triangles as OBJ, materials ─► the same
//! ```
//!
//! What a file says of a material and what the scene makes of it can differ (an exponent below 1, a colour above 1):
//! every difference is a sentence of [`Treated::remarks`]. Camera and light are proposals, to be edited.

mod error;
mod framing;
mod gltf;
mod material;
mod mtl;
mod obj;

pub use error::ImportError;
pub use framing::UpAxis;
pub use gltf::gltf;
pub use material::Treated;
pub use obj::{Library, obj};

use crate::scene::Description;

/// A scene that was made of a model, and what it took.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The scene, as its file will say it.
    pub description: Description,
    /// What became of each material, in the order of the scene's.
    pub treated: Vec<Treated>,
    /// Sentences about the whole: libraries that are not there, parts of the model that are not taken.
    pub remarks: Vec<String>,
    /// The text of the OBJ file that the scene names, where the model itself is none.
    pub mesh: Option<String>,
}

/// How a scene is to be made of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    /// The scene's name: letters, digits, - and _.
    pub name: String,
    /// What the scene calls the mesh: a path from the scene's directory.
    pub mesh: String,
    /// Pixels of the picture: width and height, 1 to 16384 each.
    pub size: (u32, u32),
    /// The axis of the model that is upwards in the picture.
    pub up: UpAxis,
}
