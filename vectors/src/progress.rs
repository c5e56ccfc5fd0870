//! How far a long piece of work has come.

use std::sync::atomic::{AtomicU64, Ordering};

/// Counts inputs as they are done, from any thread: a progress bar, a counter in a test. [`limits`](crate::limits) says
/// how many there will be.
pub trait Progress: Sync {
    /// `inputs` more are done.
    fn advance(&self, inputs: u64);
}

impl Progress for AtomicU64 {
    fn advance(&self, inputs: u64) {
        self.fetch_add(inputs, Ordering::Relaxed);
    }
}
