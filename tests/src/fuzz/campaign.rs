//! Many runs of one target: inputs drawn from its corpus, altered, by a seed.

use std::time::Duration;

use super::mutate::mutate;
use super::run::{Finding, run};
use super::{Outcome, Place, Target};
use naive::configurations::Random;

/// What many runs did.
#[derive(Debug, Clone, Copy, Default)]
pub struct Figures {
    /// The number of runs.
    pub runs: u64,
    /// Of them, those whose input was accepted.
    pub accepted: u64,
    /// The processor time of the longest run.
    pub slowest: Duration,
    /// The most bytes held.
    pub memory: usize,
}

/// Runs of one target, one after the other.
#[derive(Debug)]
pub struct Campaign {
    target: Target,
    corpus: Vec<Vec<u8>>,
    place: Place,
    random: Random,
    next: usize,
    /// What they did so far.
    pub figures: Figures,
}

impl Campaign {
    /// A new one: first the corpus as it is, and then what the seed makes of it.
    #[must_use]
    pub fn new(target: Target, seed: u64) -> Self {
        let random = Random::new(seed, 0);
        let (corpus, place) = (target.corpus(), Place::new());
        Self { target, corpus, place, random, next: 0, figures: Figures::default() }
    }

    /// How many inputs the corpus has.
    #[must_use]
    pub fn corpus_len(&self) -> usize {
        self.corpus.len()
    }

    /// The next input: first every file of the corpus as it is, then files of it that are altered.
    pub fn input(&mut self) -> Vec<u8> {
        self.next += 1;
        if let Some(whole) = self.corpus.get(self.next - 1) {
            return whole.clone();
        }
        let last = self.corpus.len() as i64 - 1;
        let [first, second] = [0, 1].map(|_| self.random.integer(0, last) as usize);
        mutate(&self.corpus[first], &self.corpus[second], self.target.form, &mut self.random)
    }

    /// Runs it.
    ///
    /// # Errors
    /// What a run must not do.
    pub fn run(&mut self, input: &[u8]) -> Result<Outcome, Finding> {
        self.figures.runs += 1;
        let ran = run(&self.target, input, &self.place)?;
        self.figures.accepted += u64::from(ran.outcome == Outcome::Accepted);
        self.figures.slowest = self.figures.slowest.max(ran.time);
        self.figures.memory = self.figures.memory.max(ran.memory);
        Ok(ran.outcome)
    }
}
