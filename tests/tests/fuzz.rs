//! Every reader on its corpus, and on some hundred inputs that a seed makes of it. `make fuzz` goes on from here.

use blysk_tests::fuzz::campaign::Campaign;
use blysk_tests::fuzz::{Outcome, TARGETS, Target};
use peak_alloc::PeakAlloc;

/// Counts what runs hold.
#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Altered inputs of each target.
const ALTERED: usize = 400;

fn short(name: &str) {
    let target = Target::find(name).expect("a target");
    let mut campaign = Campaign::new(target, 1);
    let corpus = campaign.corpus_len();
    let mut accepted = 0;
    for run in 0..corpus + ALTERED {
        let input = campaign.input();
        let found = campaign.run(&input).unwrap_or_else(|finding| {
            panic!("{name}, run {run}: {finding:?}\n{}", String::from_utf8_lossy(&input))
        });
        accepted += usize::from(run < corpus && found == Outcome::Accepted);
    }
    // A corpus of which nothing is read would try the first line of a reader only, and a mutation that spoils
    // nothing would be none.
    assert!(accepted > 0, "nothing of the corpus is accepted");
    assert!(campaign.figures.accepted < campaign.figures.runs, "nothing is refused");
}

macro_rules! short {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            short(stringify!($name));
        })*

        #[test]
        fn every_target_is_here() {
            let here = [$(stringify!($name)),*];
            assert!(TARGETS.iter().map(|target| target.name).eq(here));
        }
    };
}

short!(
    configuration,
    exponents,
    scene,
    obj,
    pareto,
    stimulus,
    answers,
    registers,
    memory,
    manifest,
    bundle,
    certificate,
    specialised
);

/// The seed gives the same inputs again: a finding can be made again.
#[test]
fn the_same_seed_gives_the_same_inputs() {
    for target in TARGETS {
        let [mut first, mut second] = [0, 0].map(|_| Campaign::new(target, 7));
        for _ in 0..first.corpus_len() + 50 {
            assert_eq!(first.input(), second.input(), "{}", target.name);
        }
    }
}
