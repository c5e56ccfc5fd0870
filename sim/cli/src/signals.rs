//! SIGINT and SIGTERM: what is under way goes, and the exit status says which of them it was.

/// Removes the temporary files of the process when it is asked to end. A commit under way is waited for.
#[cfg(unix)]
pub(super) fn watch() -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
        if let Some(signal) = signals.forever().next() {
            vectors::whole_file::remove_temporaries();
            // As a shell has it: 130 and 143.
            std::process::exit(128 + signal);
        }
    })?;
    Ok(())
}

/// Does nothing, as this system has no such signals.
#[cfg(not(unix))]
pub(super) fn watch() -> std::io::Result<()> {
    Ok(())
}
