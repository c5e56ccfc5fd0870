//! The golden model against the naive one, over a wide space of configurations.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};

use hw_model::config::{Config, Cut, Form, Tail};
use hw_model::design::Design;
use hw_model::exponents::Exponents;
use hw_model::fit::Method;
use hw_model::rounding::Rounding;
use naive::Naive;
use naive::comparison::{self, Comparison, Complaint, Kind};
use naive::configurations::{self, METHODS, Random};
use num_bigint::BigInt;
use rayon::prelude::*;

/// The seed of everything random here.
const SEED: u64 = 0x0b11_5c00_2024;

/// Configurations tried (or as many as BLYSK_CONFIGURATIONS says), and inputs for each that makes
/// hardware.
const CONFIGURATIONS: u64 = 6000;
const INPUTS: usize = 260;

/// What came of some configurations.
#[derive(Default)]
struct Tally {
    compared: u64,
    designs: u64,
    /// Designs with a quotient at the clamp.
    saturated: u64,
    refusals: BTreeMap<String, u64>,
    complaints: Vec<(String, Complaint)>,
}

impl Tally {
    fn join(mut self, other: Self) -> Self {
        self.compared += other.compared;
        self.designs += other.designs;
        self.saturated += other.saturated;
        for (text, count) in other.refusals {
            *self.refusals.entry(text).or_default() += count;
        }
        self.complaints.extend(other.complaints);
        self
    }

    fn refused(&self) -> u64 {
        self.refusals.values().sum()
    }

    fn assert_none(&self) {
        let by_kind = self.complaints.iter().fold(BTreeMap::<_, u64>::new(), |mut kinds, (_, complaint)| {
            *kinds.entry(complaint.kind).or_default() += 1;
            kinds
        });
        let mut shown: BTreeMap<Kind, u32> = BTreeMap::new();
        for (config, complaint) in &self.complaints {
            let shown = shown.entry(complaint.kind).or_default();
            *shown += 1;
            if *shown <= 4 {
                eprintln!("{complaint}\n  with {config}");
            }
        }
        assert!(self.complaints.is_empty(), "complaints: {by_kind:?}");
    }
}

/// Complaints of all tests, and how many are enough: a model that is wrong everywhere is soon done with.
static COMPLAINTS: AtomicU64 = AtomicU64::new(0);
const ENOUGH: u64 = 40;

/// Runs one configuration; a panic anywhere in the golden model is a complaint like any other.
fn guarded(config: &Config, run: impl FnOnce(&mut Tally) -> Result<(), Complaint>) -> Tally {
    let mut tally = Tally::default();
    if COMPLAINTS.load(Ordering::Relaxed) >= ENOUGH {
        return tally;
    }
    let outcome = catch_unwind(AssertUnwindSafe(|| run(&mut tally)));
    let complaint = match outcome {
        Ok(Ok(())) => return tally,
        Ok(Err(complaint)) => complaint,
        Err(payload) => {
            let text = payload
                .downcast_ref::<String>()
                .map(String::as_str)
                .or_else(|| payload.downcast_ref::<&str>().copied())
                .unwrap_or("a panic");
            Complaint { kind: Kind::Panic, text: text.to_owned() }
        }
    };
    COMPLAINTS.fetch_add(1, Ordering::Relaxed);
    let text: String = config.to_json().split_whitespace().collect();
    tally.complaints.push((text, complaint));
    tally
}

/// The first words of a refusal, to count refusals by.
fn kind_of_refusal(text: &str) -> String {
    let words: Vec<&str> = text.split([' ', ',']).take(2).collect();
    words.join(" ")
}

fn random_configuration(index: u64) -> Tally {
    let mut random = Random::new(SEED, index);
    let config = configurations::random(&mut random);
    guarded(&config, |tally| {
        let design = match Design::new(config.clone()) {
            Ok(design) => design,
            Err(refusal) => {
                let text = kind_of_refusal(&refusal.to_string());
                *tally.refusals.entry(text).or_default() += 1;
                return Ok(());
            }
        };
        tally.designs += 1;
        comparison::rom(&design)?;
        let mut comparison = Comparison::new(&design);
        let depth = design.rom().depth() as i64;
        let addresses = 1 + random.integer(0, 2).min(depth - 1);
        for _ in 0..addresses {
            let address = random.integer(0, depth - 1) as u32;
            let cut = design.rows()[address as usize].cut;
            let count = INPUTS / addresses as usize;
            let xs = configurations::inputs(&mut random, design.datapath(), cut, count);
            tally.compared += comparison.inputs(address, &xs)?;
        }
        // An address without a word.
        let greatest = (1_i64 << design.rom().address_width()) - 1;
        let beyond = random.integer(depth, greatest) as u32;
        let xs = configurations::inputs(&mut random, design.datapath(), 0, 24);
        tally.compared += comparison.inputs(beyond, &xs)?;
        Ok(())
    })
}

#[test]
fn a_million_random_inputs_agree() {
    let count = std::env::var("BLYSK_CONFIGURATIONS").ok().and_then(|text| text.parse().ok()).unwrap_or(CONFIGURATIONS);
    let tally = (0..count).into_par_iter().map(random_configuration).reduce(Tally::default, Tally::join);
    println!(
        "seed {SEED:#x}: {} inputs of {} designs compared; {} of {count} configurations refused",
        tally.compared,
        tally.designs,
        tally.refused(),
    );
    for (text, count) in &tally.refusals {
        println!("  refused {count}: {text} ...");
    }
    tally.assert_none();
    // All of them are a million; fewer configurations, in proportion.
    assert!(tally.compared >= 1_000_000 * count / CONFIGURATIONS, "{}", tally.compared);
    assert!(tally.refused() * 2 < count, "refusals are to be a minority: {}", tally.refused());
}

/// Divisors so coarse, under a budget so large, that a ratio meant for [0, Q] passes 1.
fn coarse_divider(exponent: f64, q: f64, rounding: Rounding) -> Tally {
    let mut config = configurations::plain();
    config.exponents = Exponents::new(vec![exponent]).expect("an exponent");
    (config.q, config.g) = (q, 0.1);
    (config.tail, config.rounding) = (Tail::Rational, rounding);
    config.error_budget_ulp = 1e6;
    guarded(&config, |tally| {
        let Ok(design) = Design::new(config.clone()) else { return Ok(()) };
        tally.designs += 1;
        let cut = design.rows()[0].cut;
        let xs: Vec<i64> = (0..40).map(|below| cut - 1 - below).collect();
        let mut comparison = Comparison::new(&design);
        tally.compared += comparison.inputs(0, &xs)?;
        let one = design.datapath().output_one();
        let naive = Naive::new(&design);
        let passes = xs.iter().any(|&x| naive.answer(0, x).intensity == BigInt::from(one));
        tally.saturated += u64::from(passes);
        Ok(())
    })
}

#[test]
fn a_quotient_that_passes_one_saturates() {
    let tally = (0..900_u32)
        .into_par_iter()
        .map(|index| {
            let exponent = 2.0 + f64::from(index / 6) * 0.13;
            let q = [0.7, 0.9, 0.97][index as usize % 3];
            let rounding = [Rounding::NearestUp, Rounding::Floor][index as usize / 3 % 2];
            coarse_divider(exponent, q, rounding)
        })
        .reduce(Tally::default, Tally::join);
    println!("{} inputs of {} designs compared, {} of which pass 1", tally.compared, tally.designs, tally.saturated);
    tally.assert_none();
    assert!(tally.designs > 500 && tally.saturated > 20);
}

/// A variable so coarse that its error squared counts: a bound of first order is 40 000 ulp short.
#[test]
fn the_bound_holds_for_a_coarse_variable() {
    let mut config = configurations::plain();
    config.exponents = "2.3622864941670483,2.518397435842244,3,8,15.999999999999998,103,104,\
        792.1275377745093,5030.632625785858"
        .parse()
        .expect("nine exponents");
    (config.input, config.output) = ("UQ0.5".parse().expect("a format"), "UQ0.21".parse().expect("a format"));
    config.q = 0.469_917_089_615_132_6;
    config.rounding = Rounding::NearestEven;
    config.error_budget_ulp = 1e6;
    let tally = guarded(&config, |tally| {
        let design = Design::new(config.clone()).expect("the budget is large");
        let xs: Vec<i64> = (0..32).collect();
        let mut comparison = Comparison::new(&design);
        for address in 0..9 {
            tally.compared += comparison.inputs(address, &xs)?;
        }
        Ok(())
    });
    tally.assert_none();
    assert_eq!(tally.compared, 9 * 32);
}

/// Every x of Q2.6 (so below 0 and above 1 too) at each of sixteen exponents.
fn every_input(config: &Config) -> Tally {
    guarded(config, |tally| {
        let design = Design::new(config.clone())
            .map_err(|refusal| Complaint { kind: Kind::Rom, text: format!("refused: {refusal}") })?;
        tally.designs += 1;
        comparison::rom(&design)?;
        let format = config.input;
        let xs: Vec<i64> = (format.min_bits()..=format.max_bits()).collect();
        let mut comparison = Comparison::new(&design);
        for address in 0..=16 {
            tally.compared += comparison.inputs(address, &xs)?;
        }
        Ok(())
    })
}

#[test]
fn every_input_of_small_configurations_agrees() {
    let mut configs = Vec::new();
    for method in METHODS {
        for form in [Form::Power, Form::Centred] {
            for rounding in Rounding::ALL {
                for (tail, cut) in
                    [(Tail::Zero, Cut::Epicentre), (Tail::Zero, Cut::Minimum), (Tail::Rational, Cut::Epicentre)]
                {
                    if method == Method::Schlick && tail == Tail::Zero {
                        continue;
                    }
                    let mut config = configurations::plain();
                    config.method = method;
                    config.exponents = "1..=8,10,16,20.5,32,64,100,128,200".parse().expect("sixteen exponents");
                    config.input = "Q2.6".parse().expect("a format");
                    config.output = "UQ1.7".parse().expect("a format");
                    config.form = form;
                    config.rounding = rounding;
                    config.tail = tail;
                    config.cut = cut;
                    config.error_budget_ulp = 1.5;
                    configs.push(config);
                }
            }
        }
    }
    let designs = configs.len() as u64;
    let tally = configs.par_iter().map(every_input).reduce(Tally::default, Tally::join);
    println!("{} inputs of {designs} designs compared", tally.compared);
    tally.assert_none();
    assert_eq!(tally.compared, designs * 17 * 256);
}
