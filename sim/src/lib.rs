//! The clocked highlight pipeline, its analyses, and the `blysk` command.

pub mod agreement;
pub mod analysis;
pub mod cmd;
pub mod document;
pub mod evaluate;
pub mod pipeline;
pub mod render;
pub mod report;
pub mod run;
pub mod scene;
pub mod specialise;
pub mod stream;
pub mod trace;
pub mod waves;
