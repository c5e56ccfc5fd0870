//! Pipelines that are clocked by hand, a few of them.

use std::collections::VecDeque;
use std::ops::Deref;
use std::sync::{Arc, Mutex, PoisonError};

use hw_model::datapath::Datapath;
use sim::pipeline::Clocked;
use vectors::limits::MOST_SERVED_SESSIONS;

use crate::known::Known;
use crate::refusal::Refusal;

/// A design that a pipeline keeps.
#[derive(Debug, Clone)]
pub(crate) struct Shared(pub(crate) Arc<Known>);

impl Deref for Shared {
    type Target = Datapath;

    fn deref(&self) -> &Datapath {
        self.0.datapath()
    }
}

/// A pipeline that is clocked by hand.
#[derive(Debug)]
pub(crate) struct Session {
    /// The pipeline.
    pub(crate) pipeline: Clocked<Shared>,
    /// Cycles so far.
    pub(crate) cycles: u64,
}

/// The last pipelines, the one that was clocked last at the end.
#[derive(Debug, Default)]
pub(crate) struct Sessions(Mutex<Kept>);

#[derive(Debug, Default)]
struct Kept {
    sessions: VecDeque<(u64, Arc<Mutex<Session>>)>,
    opened: u64,
}

impl Sessions {
    /// An empty pipeline, and its number. Where there are many, the one that was not clocked for longest goes.
    pub(crate) fn open(&self, known: Arc<Known>) -> u64 {
        let session = Session { pipeline: Clocked::new(Shared(known)), cycles: 0 };
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.sessions.len() == MOST_SERVED_SESSIONS {
            kept.sessions.pop_front();
        }
        kept.opened += 1;
        let number = kept.opened;
        kept.sessions.push_back((number, Arc::new(Mutex::new(session))));
        number
    }

    /// Does something with a pipeline.
    ///
    /// # Errors
    /// When it is not kept any more; those of `work`.
    pub(crate) fn with<T>(
        &self,
        number: u64,
        work: impl FnOnce(&mut Session) -> Result<T, Refusal>,
    ) -> Result<T, Refusal> {
        let session = self.find(number).ok_or_else(|| {
            Refusal::unusable(format!(
                "the pipeline {number} is not kept any more, as {MOST_SERVED_SESSIONS} others were clocked since; \
                 begin with a new one"
            ))
        })?;
        let mut session = session.lock().unwrap_or_else(PoisonError::into_inner);
        work(&mut session)
    }

    fn find(&self, number: u64) -> Option<Arc<Mutex<Session>>> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = kept.sessions.iter().position(|(own, _)| *own == number)?;
        let found = kept.sessions.remove(place)?;
        let session = Arc::clone(&found.1);
        kept.sessions.push_back(found);
        Some(session)
    }
}
