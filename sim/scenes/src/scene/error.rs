//! Why a scene is refused, and where in it.

use std::io;

use thiserror::Error;
use vectors::text_file::TextProblem;

/// Why a scene is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// Not JSON, an unknown or missing field, or a value of the wrong kind.
    #[error("{}{source}{hint}", at(path))]
    Json {
        /// The way to the value: `geometry[2].sphere`. Empty for the whole.
        path: String,
        /// What is wrong, with line and column.
        source: serde_json::Error,
        /// What would be right, where it is known.
        hint: String,
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
        /// The path of the mesh, as the scene names it.
        file: String,
        /// What is wrong with it.
        source: MeshError,
    },
}

/// Why a mesh is refused. The texts follow the name of the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The file cannot be read.
    #[error("{}{}", .0.after_name(), where_paths_start(.0))]
    Read(TextProblem),
    /// A line of it.
    #[error(":{line}: {problem}")]
    Line {
        /// The number of the line, counted from 1.
        line: usize,
        /// What is wrong, and what would be right.
        problem: String,
    },
}

fn at(path: &str) -> String {
    if path.is_empty() { String::new() } else { format!("at `{path}`: ") }
}

fn where_paths_start(problem: &TextProblem) -> &'static str {
    match problem {
        TextProblem::Io(error) if error.kind() == io::ErrorKind::NotFound => "; paths start at the scene's directory",
        _ => "",
    }
}
