//! Bounds that are proved: interval arithmetic, and certificates that can be checked without the search that made them.
//!
//! [`interval`] holds sets of reals that are known to hold a number. [`certify`] bounds the error of methods over the
//! continuous x with them, and checks the bounds of configurations, which a sweep over every x finds. [`seal`] is how
//! certificates are written, here and wherever else there are some.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

pub mod certify;
pub mod interval;
pub mod seal;
