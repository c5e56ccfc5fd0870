//! Every step of a commit that others can see goes through here, so that a test can stop at each.

use std::io;

/// In builds with debug assertions, `BLYSK_ABORT_AT_STEP=k` ends the process before its k-th step, as a power cut
/// would, and `BLYSK_FAIL_AT_STEP=k` makes that step fail. Other builds have none of it.
///
/// # Errors
/// Where a test asks for it.
#[cfg(debug_assertions)]
pub(super) fn step() -> io::Result<()> {
    use std::sync::atomic::{AtomicU64, Ordering};
    static STEPS: AtomicU64 = AtomicU64::new(0);
    let this = STEPS.fetch_add(1, Ordering::Relaxed) + 1;
    let asked = |variable| {
        let asked = std::env::var(variable).ok().and_then(|text| text.parse::<u64>().ok());
        asked == Some(this)
    };
    if asked("BLYSK_ABORT_AT_STEP") {
        std::process::abort();
    }
    if asked("BLYSK_FAIL_AT_STEP") {
        return Err(io::ErrorKind::StorageFull.into());
    }
    Ok(())
}

/// A release takes no step: only builds with debug assertions can be told to stop at one.
///
/// # Errors
/// This one has no errors; the signature is that of builds which do.
#[cfg(not(debug_assertions))]
pub(super) const fn step() -> io::Result<()> {
    Ok(())
}
