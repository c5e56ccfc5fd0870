//! SIGINT and SIGTERM: what is under way goes, and the exit status says which of them it was.

use std::sync::OnceLock;
use std::sync::mpsc::{Receiver, Sender, channel};

/// Who ends the process in place of the watcher, where somebody does.
static HEIR: OnceLock<Sender<i32>> = OnceLock::new();

/// The exit status after a signal, as a shell has it: 130 and 143.
pub(super) const fn status(signal: i32) -> i32 {
    128 + signal
}

/// From now on the first signal comes here, and whoever asked ends the process. A second one ends it at once.
pub(super) fn handed_over() -> Receiver<i32> {
    let (heir, signals) = channel();
    // Only one command runs in a process.
    let _ = HEIR.set(heir);
    signals
}

/// Removes the temporary files of the process when it is asked to end. A commit under way is waited for.
#[cfg(unix)]
pub(super) fn watch() -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
        let mut signals = signals.forever();
        let mut first = signals.next();
        if let Some((signal, heir)) = first.zip(HEIR.get())
            && heir.send(signal).is_ok()
        {
            first = signals.next();
        }
        if let Some(signal) = first {
            vectors::whole_file::remove_temporaries();
            std::process::exit(status(signal));
        }
    })?;
    Ok(())
}

/// Does nothing, as this system has no such signals.
#[cfg(not(unix))]
pub(super) fn watch() -> std::io::Result<()> {
    Ok(())
}
