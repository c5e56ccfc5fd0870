//! What a terminal shows of work that takes a while: bars that count, and beside them a clock.
//!
//! Both are on standard error, where that is a terminal, and leave nothing behind. What can be counted has a [`Bar`].
//! The clock ([`Clock`]) is for everything else: whatever a command does, after two seconds it shows that it works.

use std::io::{IsTerminal, Read};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, MultiProgress, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use vectors::progress::Progress;

/// What is shown, line by line; everything that is drawn is drawn here, so that no line breaks another.
static SHOWN: LazyLock<MultiProgress> = LazyLock::new(|| {
    MultiProgress::with_draw_target(match std::io::stderr().is_terminal() {
        true => ProgressDrawTarget::stderr(),
        false => ProgressDrawTarget::hidden(),
    })
});

/// The clock of this run.
static CLOCK: Mutex<Option<Clock>> = Mutex::new(None);

/// Work that takes longer shows that it goes on.
const PATIENCE: Duration = Duration::from_secs(2);

/// How often the clock moves.
const TICK: Duration = Duration::from_millis(100);

/// A progress bar on standard error, where that is a terminal.
pub(super) struct Bar(ProgressBar);

impl Bar {
    pub(super) fn new(samples: Option<u64>) -> Self {
        Self::counting(samples, "samples")
    }

    /// A bar that counts up to a number of things; none where the number is not known.
    pub(super) fn counting(count: Option<u64>, what: &str) -> Self {
        let Some(count) = count else { return Self(ProgressBar::hidden()) };
        let style = ProgressStyle::with_template(&format!(
            "{{bar:40}} {{percent:>3}} %  {{human_pos}} of {{human_len}} {what}{{left}}",
        ));
        let left = |state: &ProgressState, text: &mut dyn std::fmt::Write| {
            if let Some(left) = left(state.elapsed(), state.fraction()) {
                let _ = write!(text, ", {:#} left", HumanDuration(left));
            }
        };
        let bar = ProgressBar::new(count);
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar()).with_key("left", left);
        Self(SHOWN.add(bar.with_style(style)))
    }

    /// The same reader, whose bytes count.
    pub(super) fn reading<R: Read>(&self, reader: R) -> impl Read + use<R> {
        self.0.wrap_read(reader)
    }

    /// The work is done: nothing of the bar stays.
    pub(super) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

/// How long the rest takes at the rate so far. Nothing is said in the first seconds, in which caches are cold and a few
/// samples would stand for all.
fn left(elapsed: Duration, fraction: f32) -> Option<Duration> {
    let told = elapsed >= PATIENCE && (f32::EPSILON..1.0).contains(&fraction);
    let left = elapsed.as_secs_f64() * (1.0 / f64::from(fraction) - 1.0);
    told.then(|| Duration::try_from_secs_f64(left.round()).unwrap_or(Duration::MAX))
}

impl Drop for Bar {
    fn drop(&mut self) {
        // An error in the middle of the work leaves no half of a bar above its message.
        self.finish();
    }
}

impl Progress for Bar {
    fn advance(&self, samples: u64) {
        self.0.inc(samples);
    }
}

/// Shows after a while how long a command has been at work.
struct Clock {
    stop: Sender<()>,
    thread: JoinHandle<()>,
}

impl Clock {
    fn start() -> Self {
        let (stop, stopped) = channel();
        let thread = thread::spawn(move || {
            let begun = Instant::now();
            if stopped.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let style = ProgressStyle::with_template("{spinner} at work for {msg} s");
            let clock = SHOWN.insert(0, ProgressBar::no_length());
            clock.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
            loop {
                clock.set_message(begun.elapsed().as_secs().to_string());
                clock.tick();
                if stopped.recv_timeout(TICK) != Err(RecvTimeoutError::Timeout) {
                    return clock.finish_and_clear();
                }
            }
        });
        Self { stop, thread }
    }

    fn stop(self) {
        // A clock that has stopped by itself does not listen any more.
        let _ = self.stop.send(());
        let _ = self.thread.join();
    }
}

/// From now on work that takes long is seen to go on.
pub(super) fn begin() {
    if std::io::stderr().is_terminal() {
        *clock() = Some(Clock::start());
    }
}

/// Nothing more is shown: the results come.
pub(super) fn end() {
    if let Some(clock) = clock().take() {
        clock.stop();
    }
}

fn clock() -> MutexGuard<'static, Option<Clock>> {
    CLOCK.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::left;
    use std::time::Duration;

    #[test]
    fn the_rest_is_told_once_it_is_known() {
        let seconds = Duration::from_secs;
        assert_eq!(left(Duration::from_millis(1900), 0.5), None);
        assert_eq!(left(seconds(3), 0.0), None);
        assert_eq!(left(seconds(3), 1.0), None);
        assert_eq!(left(seconds(3), 0.25), Some(seconds(9)));
        assert_eq!(left(seconds(60), 0.5), Some(seconds(60)));
    }
}
