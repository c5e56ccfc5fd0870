//! Scenes, and what the pipeline makes of them.
//!
//! [`scene`] reads what is to be seen, [`import`] makes a scene of a model that people have, [`render`] makes
//! pictures in which every highlight is an answer of the pipeline, and [`specialise`] cuts hardware down to what
//! one scene asks. [`report`] is what a picture comes with.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

pub mod import;
pub mod render;
pub mod report;
pub mod scene;
pub mod specialise;
