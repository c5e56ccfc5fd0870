//! Every reader on its corpus, and on some hundred inputs that a seed makes of it. `make fuzz` goes on from here.

use std::sync::{PoisonError, RwLock};

use blysk_tests::fuzz::campaign::Campaign;
use blysk_tests::fuzz::mutate::Form;
use blysk_tests::fuzz::run::{Finding, run};
use blysk_tests::fuzz::{MOST_MEMORY, Outcome, Place, TARGETS, Target};
use peak_alloc::PeakAlloc;

/// Counts what runs hold.
#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Altered inputs of each target.
const ALTERED: usize = 400;

/// What is held is counted for the whole process: what holds much on purpose does so alone.
static ALONE: RwLock<()> = RwLock::new(());

fn short(name: &str) {
    let _others = ALONE.read().unwrap_or_else(PoisonError::into_inner);
    let target = Target::find(name).expect("a target");
    let mut campaign = Campaign::new(target, 1);
    let corpus = campaign.corpus_len();
    let mut accepted = 0;
    for run in 0..corpus + ALTERED {
        let input = campaign.input();
        let found = campaign
            .run(&input)
            .unwrap_or_else(|finding| panic!("{name}, run {run}: {finding:?}\n{}", String::from_utf8_lossy(&input)));
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
    mtl,
    gltf,
    pareto,
    stimulus,
    answers,
    registers,
    memory,
    manifest,
    bundle,
    certificate,
    specialised,
    job,
    plan,
    result
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

fn panics(input: &[u8], _: &Place) -> Outcome {
    assert!(input.is_empty(), "planted");
    Outcome::Accepted
}

fn holds_much(_: &[u8], _: &Place) -> Outcome {
    let much = vec![0_u8; MOST_MEMORY + 1];
    assert_eq!(much.last(), Some(&0));
    Outcome::Accepted
}

/// What nothing must do is found where something does it.
#[test]
fn planted_mistakes_are_found() {
    let _alone = ALONE.write().unwrap_or_else(PoisonError::into_inner);
    let place = Place::new();
    let planted = |run| Target { name: "planted", form: Form::Lines, run };
    assert!(run(&planted(panics), b"", &place).is_ok());
    let found = run(&planted(panics), b"x", &place).unwrap_err();
    assert!(matches!(&found, Finding::Panic(said) if said.contains("planted")), "{found:?}");
    let found = run(&planted(holds_much), b"", &place).unwrap_err();
    assert!(matches!(found, Finding::Memory(bytes) if bytes > MOST_MEMORY), "{found:?}");
}
