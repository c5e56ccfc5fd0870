//! The `blysk` command from outside, one file for each subject: what it prints, writes and returns.
//!
//! Nothing here looks inside the command. What is expected comes from the golden model, from the
//! table of 32-digit values, or from arithmetic done here.

mod cases;
mod certify;
mod check;
mod clock;
mod closed_output;
mod coefficients;
mod coverage;
mod design;
mod dut;
mod evaluate;
mod help;
mod manual;
mod meshes;
mod models;
mod output;
mod pareto;
mod presets;
mod progress;
mod refine;
mod render;
mod report;
mod report_against_brute_force;
mod rom;
mod rom_image;
mod rtl;
mod scene_import;
mod simulate;
mod source;
mod specialise;
mod stability;
mod streams;
mod vectors;
mod wrappers;
