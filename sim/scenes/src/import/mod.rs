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
mod wish;

pub use error::ImportError;
pub use gltf::gltf;
pub use material::Treated;
pub use obj::{Library, obj};
pub use wish::{Imported, UpAxis, Wish};
