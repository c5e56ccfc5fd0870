//! Why a scene is refused, and where in it.

use std::io;

use thiserror::Error;

/// Why a scene is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// Not JSON, an unknown or missing field, or a value of the wrong kind.
    #[error("{}{source}", at(path))]
    Json {
        /// The way to the value: `geometry[2].sphere`. Empty for the whole.
        path: String,
        /// What is wrong, with line and column.
        source: serde_json::Error,
    },
    /// A value that cannot be used.
    #[error("at `{path}`: {problem}")]
    Value {
        /// The way to the value.
        path: String,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// A mesh that cannot be used.
    #[error("at `{path}`: {file}{source}")]
    Mesh {
        /// The way to the mesh.
        path: String,
        /// Its file.
        file: String,
        /// What is wrong.
        source: MeshError,
    },
}

/// Why a mesh is refused. The texts follow the name of the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The file cannot be read.
    #[error(" cannot be read: {0}; paths start at the scene's directory")]
    Read(io::Error),
    /// A line of it.
    #[error(":{line}: {problem}")]
    Line {
        /// From 1.
        line: usize,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// All of it.
    #[error(": {0}")]
    Whole(String),
}

fn at(path: &str) -> String {
    if path.is_empty() { String::new() } else { format!("at `{path}`: ") }
}

impl MeshError {
    /// With a line where one is known.
    pub(super) fn at(line: Option<usize>, problem: impl Into<String>) -> Self {
        let problem = problem.into();
        match line {
            Some(line) => Self::Line { line, problem },
            None => Self::Whole(problem),
        }
    }
}
