//! What every way of choosing promises.

mod common;

use std::collections::HashSet;

use hw_model::design::Design;
use proptest::prelude::*;
use vectors::stimulus::Stimulus;
use vectors::{Case, Kind, Sample, Strategy};

fn samples(design: &Design, strategy: Strategy, count: u64, seed: u64) -> Vec<Sample> {
    let stimulus = Stimulus::new(design, strategy, count, seed);
    let samples: Vec<Sample> = stimulus.samples().collect();
    assert_eq!(samples.len() as u128, stimulus.len());
    samples
}

#[test]
fn names_come_back() {
    for strategy in Strategy::ALL {
        assert_eq!(strategy.to_string().parse(), Ok(strategy));
    }
    let error = "corner".parse::<Strategy>().unwrap_err().to_string();
    assert!(error.contains("corners, even"), "{error}");
}

fn counted() -> Vec<Strategy> {
    Strategy::ALL.into_iter().filter(|strategy| !strategy.counts_itself()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn every_case_is_legal_every_row_is_met_and_the_same_seed_gives_the_same(
        which in 0_usize..3, strategy in prop::sample::select(counted()),
        count in 1_u64..300, seed in any::<u64>(),
    ) {
        let design = &common::all_small()[which];
        let (rom, input) = (design.rom(), design.config().input);
        let samples = samples(design, strategy, count, seed);
        prop_assert!(samples.len() as u64 <= count);
        prop_assert!(strategy == Strategy::Corners || samples.len() as u64 == count);
        for Sample { case, .. } in &samples {
            prop_assert!(input.holds(case.x.into()) && case.address >> rom.address_width() == 0);
            prop_assert_eq!(*case, Case::at(rom, case.address, case.x));
        }
        let rows: HashSet<u32> = samples
            .iter().map(|sample| sample.case.address)
            .filter(|&address| (address as usize) < rom.depth()).collect();
        prop_assert_eq!(rows.len(), rom.depth().min(count as usize));
        prop_assert_eq!(samples, self::samples(design, strategy, count, seed));
    }
}

#[test]
fn a_seed_changes_the_random_cases_and_only_them() {
    let design = common::small();
    for (strategy, changes) in [(Strategy::Mixed, true), (Strategy::Even, false)] {
        let [one, two] = [1, 2].map(|seed| samples(&design, strategy, 64, seed));
        assert_eq!(one != two, changes, "{strategy}");
        let others = |samples: &[Sample]| -> Vec<Sample> {
            samples.iter().filter(|sample| sample.kind != Kind::Random).copied().collect()
        };
        assert_eq!(others(&one), others(&two));
    }
}

/// As many cases as rows are just enough, with any seed.
#[test]
fn a_count_of_the_depth_meets_every_row() {
    let design = common::preset("compact");
    let depth = design.rom().depth();
    for seed in 0..8 {
        let samples = samples(&design, Strategy::Random, depth as u64, seed);
        let rows: HashSet<u32> = samples.iter().map(|sample| sample.case.address).collect();
        assert_eq!(rows.len(), depth, "seed {seed}");
    }
}

#[test]
fn a_mixture_has_its_shares() {
    let design = common::preset("compact");
    let samples = samples(&design, Strategy::Mixed, 2048, 7);
    let count = |kind| samples.iter().filter(|sample| sample.kind == kind).count();
    assert_eq!((count(Kind::Even), count(Kind::Random)), (256, 256));
    let targets = count(Kind::Target);
    assert!((256..1536).contains(&targets), "{targets}");
    assert!(samples[..targets].iter().all(|sample| sample.kind == Kind::Target));
}

/// Targets come before everything else, a corner that is one of them comes once, and where there are
/// more targets than the count has room for there is nothing else.
#[test]
fn targets_come_first_and_once() {
    for design in common::all_small() {
        let all = samples(&design, Strategy::Mixed, 200, 1);
        let targets = all.iter().filter(|sample| sample.kind == Kind::Target).count();
        let fewer = samples(&design, Strategy::Mixed, targets as u64 - 1, 1);
        assert_eq!(fewer.len(), targets - 1);
        // The last round is shared over the rows, so it need not be the one with more room.
        assert!(fewer.iter().all(|sample| all[..targets].contains(sample)));
        let chosen = all.iter().filter(|s| !matches!(s.kind, Kind::Even | Kind::Random));
        let mut seen = HashSet::new();
        assert!(chosen.into_iter().all(|s| seen.insert((s.case.address, s.case.x))));
    }
}

#[test]
fn the_even_grid_is_even() {
    let design = common::preset("compact");
    let one = design.config().input.one();
    let mut xs: Vec<i64> = samples(&design, Strategy::Even, 1024, 0).iter().map(|sample| sample.case.x).collect();
    xs.sort_unstable();
    let wanted: Vec<i64> = (0..1024).map(|i| (2 * i * one + 1023) / 2046).collect();
    assert_eq!(xs, wanted);

    let row: Vec<i64> = samples(&design, Strategy::Even, 1024, 0)
        .iter()
        .filter(|sample| sample.case.address == 100)
        .map(|sample| sample.case.x)
        .collect();
    assert_eq!(row.len(), 4);
    for pair in row.windows(2) {
        assert!((pair[0] - pair[1] - one / 4).abs() < one / 1000, "{row:?}");
    }
}

#[test]
fn random_cases_reach_every_part_of_the_input() {
    let design = common::preset("paper");
    let depth = design.rom().depth() as u32;
    let samples = samples(&design, Strategy::Random, 4096, 1);
    let one = design.config().input.one();
    let count = |holds: &dyn Fn(&Case) -> bool| samples.iter().filter(|sample| holds(&sample.case)).count();
    // Expected: 1/64 without a word after the first round, 1/16 above 1, 3/8 at least above the cut.
    assert!((30..100).contains(&count(&|case| case.address >= depth)));
    assert!((180..340).contains(&count(&|case| case.x > one)));
    let cut = |case: &Case| design.rows().get(case.address as usize).map_or(one, |row| row.cut);
    assert!(count(&|case| (cut(case)..=one).contains(&case.x)) > 1200);
}

#[test]
fn the_exhaustive_strategy_gives_every_input_once() {
    for design in common::all_small() {
        let (rom, input) = (design.rom(), design.config().input);
        let cases: HashSet<(u32, i64)> = samples(&design, Strategy::Exhaustive, 0, 0)
            .iter()
            .map(|sample| (sample.case.address, sample.case.x))
            .collect();
        assert_eq!(cases.len(), 1 << (rom.address_width() + input.width()));
    }
}
