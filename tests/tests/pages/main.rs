//! The pages of the tree, README and docs/: the files they name are there, the commands of README work as printed, and
//! no line of the tree is too long to read.

mod book;
mod lines;
mod paths;
mod presets;
mod readme;
mod tree;
