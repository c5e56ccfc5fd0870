//! Scenes: what is seen, by which light, with which exponents.
//!
//! ```text
//! JSON ─► Description (form) ─► Scene (values checked, meshes loaded) ─► crate::render
//! ```
//!
//! Nothing here knows pixels or hardware: a [`Scene`] is camera, lights, materials and surfaces, and what it can
//! present to the pipeline follows from them alone.

mod check;
mod checked;
mod description;
mod error;
mod knot;
mod mesh;
mod obj;
mod polygon;
mod read;
mod vector;

pub(crate) use check::DISPLAY_BITS;
pub use checked::{Light, Material, Origin, Scene, Shape, Surface, View};
pub use description::{Angle, Description, Image, Normals, Transfer};
pub(crate) use description::{
    Camera, Directional, Geometry, Light as LightDescription, Material as MaterialDescription, MeshFile,
};
pub use error::{MeshError, SceneError};
pub use knot::{Knot, KnotError};
pub use mesh::{Mesh, Triangle, triangles};
pub(crate) use obj::{GREATEST_COORDINATE, MOST_TRIANGLES, MOST_VECTORS, Statements, name_behind};
pub(crate) use polygon::has_area;
pub use read::schema;
pub use vector::Vector;
