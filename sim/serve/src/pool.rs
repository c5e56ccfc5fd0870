//! A few workers, a queue with an end, and a deadline.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::Semaphore;
use tokio::time::timeout;

use crate::refusal::Refusal;

/// Who does the work of the answers. Work cannot be broken off: what goes past its deadline is not waited for, and
/// keeps its worker until it ends.
#[derive(Debug)]
pub(crate) struct Pool {
    workers: Arc<Semaphore>,
    /// Places for requests that are worked on or wait.
    places: Semaphore,
    deadline: Duration,
}

impl Pool {
    /// So many workers, so many requests that may wait for one, and how long a request is waited for.
    pub(crate) fn new(workers: usize, waiting: usize, deadline: Duration) -> Self {
        Self { workers: Arc::new(Semaphore::new(workers)), places: Semaphore::new(workers + waiting), deadline }
    }

    /// What a job gives, on a worker.
    ///
    /// # Errors
    /// Those of the job; when no place is free, and when the deadline passes.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        job: impl FnOnce() -> Result<T, Refusal> + Send + 'static,
    ) -> Result<T, Refusal> {
        let Ok(_place) = self.places.try_acquire() else {
            return Err(Refusal::too_much("the server is busy; ask again in a moment"));
        };
        match timeout(self.deadline, self.work(job)).await {
            Ok(done) => done,
            Err(_) => Err(self.late()),
        }
    }

    async fn work<T: Send + 'static>(
        &self,
        job: impl FnOnce() -> Result<T, Refusal> + Send + 'static,
    ) -> Result<T, Refusal> {
        let worker = Arc::clone(&self.workers).acquire_owned().await.map_err(Refusal::own)?;
        let work = tokio::task::spawn_blocking(move || {
            let done = job();
            drop(worker);
            done
        });
        work.await.map_err(Refusal::own)?
    }

    fn late(&self) -> Refusal {
        Refusal::too_much(format!(
            "the answer takes longer than {} s; a configuration of fewer exponents, fewer segments or narrower formats \
             would fit, and the blysk command has no such limit",
            self.deadline.as_secs_f64()
        ))
    }
}
