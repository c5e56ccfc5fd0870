//! Jobs, plans and results of `blysk shard`: what is accepted is what this program writes.
//!
//! Nothing is built or run for an altered job: `blysk shard plan` adds the digests of programs, and without them such a
//! job is refused.

use std::path::Path;
use std::sync::OnceLock;

use bounds::seal;
use hw_model::config::Config;
use shard::job::{CertifyWork, Job, Subject, Work};
use shard::kind::Kind;
use shard::place;
use shard::plan::Plan;
use shard::result::Found;
use vectors::output_text::json;

use super::certificates::sealed;
use super::{Outcome, Place};

/// Rows of hardware of a job that is planned: more would take their time, and find nothing new.
const MOST: usize = 16;

/// A place where no program is.
fn nowhere() -> place::Place<'static> {
    place::Place(Path::new("/nowhere"))
}

/// A job: read, written and read again, and planned where that is little work.
pub fn job(bytes: &[u8], _: &Place) -> Outcome {
    let Ok(text) = std::str::from_utf8(bytes) else { return Outcome::Refused };
    let Ok(job) = Job::parse(text, Path::new("job.json")) else { return Outcome::Refused };
    let written = json(&job).expect("a job has a JSON");
    let again = Job::parse(&written, Path::new("job.json"));
    assert_eq!(again.ok().as_ref(), Some(&job), "what was written is read again");
    assert_eq!(job.digest().len(), 64);
    if is_little(&job)
        && let Ok(plan) = Plan::new(job, 1, nowhere())
    {
        assert_eq!(plan.pieces_of(0).expect("one shard"), 0..plan.pieces());
        assert!(plan.pieces_of(1).is_err());
    }
    Outcome::Accepted
}

fn is_little(job: &Job) -> bool {
    let little = |subject: &Subject| match subject {
        Subject::Inline(config) => is_little_hardware(config),
        Subject::Preset(_) => false,
        Subject::File(_) => true,
    };
    match &job.work {
        Work::Errors(work) => little(&work.configuration),
        Work::Rtl(work) => little(&work.configuration),
        Work::Certify(CertifyWork::Hardware(subject)) => little(subject),
        Work::Certify(_) | Work::Program(_) => true,
    }
}

fn is_little_hardware(config: &Config) -> bool {
    config.exponents.len() <= MOST
}

/// A plan, as it is and sealed again.
pub fn plan(bytes: &[u8], _: &Place) -> Outcome {
    let texts = [std::str::from_utf8(bytes).ok().map(str::to_owned), sealed::<Plan>(bytes, |_| None)];
    let mut outcome = Outcome::Refused;
    for text in texts.into_iter().flatten() {
        let Ok(read) = seal::parse::<Plan>(&text) else { continue };
        if !is_little(read.job()) {
            continue;
        }
        if let Ok((plan, kind)) = Plan::parse(&text, nowhere()) {
            let mut next = 0;
            for index in 0..plan.shards() {
                let pieces = plan.pieces_of(index).expect("a shard of the plan");
                assert_eq!(pieces.start, next, "shards follow each other");
                next = pieces.end;
            }
            assert_eq!(next, kind.pieces());
            outcome = Outcome::Accepted;
        }
    }
    outcome
}

/// The plans that results of the corpus are of: one for each kind that can be planned without a program.
fn plans() -> &'static [(Plan, Box<dyn Kind>)] {
    static PLANS: OnceLock<Vec<(Plan, Box<dyn Kind>)>> = OnceLock::new();
    PLANS.get_or_init(|| {
        let plans = super::Target::find("plan").expect("a target").corpus();
        let texts = plans.into_iter().filter_map(|bytes| String::from_utf8(bytes).ok());
        texts.filter_map(|text| Plan::parse(&text, nowhere()).ok()).collect()
    })
}

/// A result, as it is and sealed again, beside the plans of the corpus.
pub fn result(bytes: &[u8], _: &Place) -> Outcome {
    let texts = [std::str::from_utf8(bytes).ok().map(str::to_owned), sealed::<Found>(bytes, |_| None)];
    let mut outcome = Outcome::Refused;
    for text in texts.into_iter().flatten() {
        for (plan, kind) in plans() {
            let Ok(found) = Found::parse(&text, plan, &**kind) else { continue };
            let pieces = found.pieces();
            assert!(pieces.start < pieces.end && pieces.end <= plan.pieces(), "{pieces:?}");
            assert_eq!(found.to_json(), text, "what is believed is what would be written");
            if pieces == (0..plan.pieces()) {
                // A whole result is merged: with values that were altered the report is another, and no panic.
                let _ = kind.merged(found.into_parts());
            }
            outcome = Outcome::Accepted;
        }
    }
    outcome
}
