//! What is asked of an import, and what it gives.

use crate::scene::{Description, Vector};

use super::material::Treated;

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

/// The axis of a model that is upwards in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum UpAxis {
    /// y, as in glTF and in most OBJ files.
    #[default]
    Y,
    /// z, as in files for building and printing.
    Z,
}

impl UpAxis {
    /// A direction, given as from the right, from above and from the front, in the model's axes.
    pub(super) fn turn(self, [right, above, front]: [f64; 3]) -> Vector {
        match self {
            Self::Y => Vector::new(right, above, front),
            Self::Z => Vector::new(right, -front, above),
        }
    }
}
