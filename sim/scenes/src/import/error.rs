//! Why a model cannot be imported. The texts follow the name of a file.

use thiserror::Error;

use crate::scene::MeshError;

/// Why a model cannot be imported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The mesh.
    #[error("{0}")]
    Mesh(#[from] MeshError),
    /// A line of a library of materials.
    #[error("{library}:{line}: {problem}")]
    Library {
        /// The library, as the model names it.
        library: String,
        /// The number of the line, counted from 1.
        line: usize,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// A glTF file that cannot be used.
    #[error(": {0}")]
    Gltf(String),
    /// The model has no size, so that no camera can be placed before it.
    #[error(": all corners are in one place, so that there is nothing to see")]
    NoSize,
}
