//! Random configurations over a wide space, and the inputs worth trying on them.

use hw_model::config::{Config, Cut, Form, Tail};
use hw_model::datapath::Datapath;
use hw_model::design::Design;
use hw_model::domain::Presented;
use hw_model::exponents::Exponents;
use hw_model::fit::Method;
use hw_model::format::QFormat;
use hw_model::handshake::{Handshake, Level, ReadySlice, Reset, ResetKind};
use hw_model::pipelining::Pipelining;
use hw_model::presets;
use hw_model::registers::Register;
use hw_model::rounding::Rounding;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A small random source: the same numbers for the same seed, on every platform.
#[derive(Debug)]
pub struct Random(ChaCha8Rng);

impl Random {
    /// The source of one seed and one stream.
    #[must_use]
    pub fn new(seed: u64, stream: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(stream);
        Self(rng)
    }

    /// An integer in `low..=high`.
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        let count = i128::from(high) - i128::from(low) + 1;
        let offset = (u128::from(self.0.next_u64()) * count as u128) >> 64;
        (i128::from(low) + offset as i128) as i64
    }

    /// A number in `low..high`.
    pub fn real(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.0.next_u64() >> 11) as f64 * (-53_f64).exp2();
        low + (high - low) * unit
    }

    /// True once in `times`.
    pub fn once_in(&mut self, times: i64) -> bool {
        self.integer(1, times) == 1
    }

    /// One of these choices, each as likely as another.
    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.integer(0, choices.len() as i64 - 1) as usize]
    }
}

/// The methods a configuration can have.
pub const METHODS: [Method; 6] =
    [Method::Hermite, Method::ThreePoint, Method::Tangent, Method::Minimax, Method::Quadratic, Method::Schlick];

/// A configuration with every field at its default, to be changed field by field.
///
/// # Panics
/// Never: the text is a configuration.
#[must_use]
pub fn plain() -> Config {
    Config::from_json(
        r#"{"name": "plain", "method": "hermite", "exponents": "1..=4", "input": "UQ1.12",
            "output": "UQ1.8"}"#,
    )
    .expect("the plain configuration is one")
}

/// A random configuration. Most make hardware; some state what cannot be had.
pub fn random(random: &mut Random) -> Config {
    let mut config = plain();
    config.method = random.one_of(&METHODS);
    config.form = random.one_of(&[Form::Power, Form::Centred, Form::Centred]);
    config.tail = random.one_of(&[Tail::Zero, Tail::Rational]);
    config.cut = random.one_of(&[Cut::Epicentre, Cut::Minimum]);
    config.rounding = random.one_of(&Rounding::ALL);
    config.quotient_bits_per_stage = random.integer(1, 8) as u32;
    if config.method == Method::Schlick {
        config.tail = Tail::Rational;
    }
    if config.method == Method::Minimax && !random.once_in(3) {
        config.segments = random.one_of(&[1, 2, 2, 3, 5, 8]);
        config.cut = random.one_of(&[Cut::Epicentre, Cut::Balanced]);
        config.tail = Tail::Zero;
        config.form = if config.segments > 1 { Form::Centred } else { config.form };
    }
    config.degree = match config.method {
        Method::Minimax => random.one_of(&[3, 3, 1, 2, 4]),
        Method::Quadratic => random.one_of(&[2, 3]),
        _ => 3,
    };
    if config.tail == Tail::Rational && !random.once_in(40) {
        config.cut = Cut::Epicentre;
    }
    (config.q, config.g) = levels(random);
    config.exponents = exponents(random, config.form);
    config.input = input(random);
    config.output = output(random);
    config.error_budget_ulp = budget(random, config.rounding);
    if random.once_in(6) {
        config.multiplier_operand_bits = Some(random.integer(8, 24) as u32);
    }
    if random.once_in(6) {
        state_widths(random, &mut config);
    }
    if config.tail == Tail::Zero && random.once_in(6) {
        state_domain(random, &mut config);
    }
    if random.once_in(2) {
        config.pipelining = pipelining(random);
    }
    if random.once_in(3) {
        control(random, &mut config);
    }
    config
}

/// Ranks of registers in some of the places where there can be more.
fn pipelining(random: &mut Random) -> Pipelining {
    Pipelining {
        rom: random.once_in(2),
        front_end: random.integer(0, 1) as u32,
        operands: random.once_in(2),
        product: random.integer(0, 2) as u32,
        sum: random.once_in(2),
        ready_slice: random.one_of(&[None, None, None, Some(ReadySlice::Input), Some(ReadySlice::Output)]),
    }
}

/// A handshake that goes with the ranks, and a reset.
fn control(random: &mut Random, config: &mut Config) {
    if config.pipelining.ready_slice.is_none() {
        config.handshake = random.one_of(&Handshake::ALL);
    }
    config.reset = Reset {
        kind: random.one_of(&[ResetKind::Synchronous, ResetKind::Asynchronous]),
        active: random.one_of(&[Level::High, Level::Low]),
        ready: random.once_in(2),
    };
}

/// A domain that begins at or above every cut, or rarely below one.
fn state_domain(random: &mut Random, config: &mut Config) {
    let Ok(design) = Design::new(config.clone()) else {
        return;
    };
    let ulp = config.input.ulp();
    config.domain = design
        .rows()
        .iter()
        .map(|row| {
            let cut = (row.cut as f64 * ulp).min(1.0);
            let least = if random.once_in(30) { 0.9 * cut } else { random.real(cut, 1.0) };
            Presented { n: row.exponent, least }
        })
        .collect();
}

fn levels(random: &mut Random) -> (f64, f64) {
    let q = match random.integer(0, 9) {
        0..=3 => 0.5,
        4..=7 => random.real(0.05, 0.95),
        8 => random.one_of(&[0.999_999, 0.99, 0.999, 1.0 - 1e-12]),
        _ => random.one_of(&[1e-6, 1e-3, 0.01]),
    };
    let g = match random.integer(0, 3) {
        0 => q * random.real(0.01, 0.99),
        1 => q * random.one_of(&[0.999_999, 1e-6]),
        _ if q > 1.0 / 18.0 => 1.0 / 18.0,
        _ => q / 9.0,
    };
    (q, g)
}

fn exponents(random: &mut Random, form: Form) -> Exponents {
    let count = random.one_of(&[1, 1, 2, 3, 5, 9]);
    let log_up_to = |random: &mut Random, greatest: f64| random.real(0.0, greatest.ln()).exp();
    let mut list: Vec<f64> = (0..count)
        .map(|_| match random.integer(0, 11) {
            0..=3 => random.integer(1, 8) as f64,
            4..=6 => random.integer(1, 256) as f64,
            7 if random.once_in(2) => random.real(1.0, 4.0),
            7 => {
                let power = (random.integer(1, 10) as f64).exp2();
                random.one_of(&[power.next_down(), power, power.next_up()])
            }
            8 => 1.0 + random.real(0.0, 1.0) * random.real(-30.0, 0.0).exp2(),
            9 => log_up_to(random, 1e4),
            _ if form == Form::Power && !random.once_in(8) => random.real(1.0, 64.0),
            10 => log_up_to(random, 1e6),
            _ => log_up_to(random, 1e15),
        })
        .collect();
    list.sort_by(f64::total_cmp);
    list.dedup();
    Exponents::new(list).expect("sorted, from 1 to 1e15")
}

fn input(random: &mut Random) -> QFormat {
    let fraction = random.integer(2, 40) as u32;
    match random.integer(0, 7) {
        0..=2 => QFormat::unsigned(1, fraction),
        3 => QFormat::unsigned(0, fraction),
        4 | 5 => QFormat::signed(2, fraction),
        6 => QFormat::signed(1, fraction),
        _ => QFormat::unsigned(random.integer(2, 5) as i32, fraction),
    }
    .expect("at most 45 bits")
}

fn output(random: &mut Random) -> QFormat {
    let width = match random.integer(0, 9) {
        0 => random.integer(1, 4),
        1 => random.integer(20, 32),
        _ => random.integer(4, 20),
    } as u32;
    if random.once_in(3) || width == 1 { QFormat::unsigned(0, width) } else { QFormat::unsigned(1, width - 1) }
        .expect("1 to 32 bits")
}

fn budget(random: &mut Random, rounding: Rounding) -> f64 {
    let least = if rounding.is_nearest() { 0.55 } else { 1.05 };
    match random.integer(0, 15) {
        0 => random.real(0.3, 1.5),
        1 => random.one_of(&[20.0, 100.0, 1e4, 1e6]),
        2..=6 => random.real(least, 2.0 * least),
        _ => random.real(2.0 * least, 6.0),
    }
}

/// States some widths as the design derives them, with a few bits more, or rarely a bit less.
fn state_widths(random: &mut Random, config: &mut Config) {
    let Ok(design) = Design::new(config.clone()) else {
        return;
    };
    let formats = design.datapath().formats();
    let mut state = |format: QFormat| {
        if random.once_in(2) {
            return None;
        }
        let less = i32::from(random.once_in(12));
        let integer = format.integer_bits() + random.integer(0, 3) as i32 - less;
        let fraction = format.fraction_bits() + random.integer(0, 8) as u32;
        let stated = if format.is_signed() || random.once_in(3) {
            QFormat::signed(integer + i32::from(!format.is_signed()), fraction)
        } else {
            QFormat::unsigned(integer, fraction)
        };
        stated.ok()
    };
    // The coefficients from c0 up, as the order of the draws has always been.
    let coefficients = (0..=config.degree).map(|power| Register::C(0, power));
    let stages = (1..config.degree).map(Register::T);
    let tail = [Register::TailA, Register::TailB, Register::Divisor];
    let v = Some(Register::V).filter(|_| config.form == Form::Centred);
    for register in v.into_iter().chain(coefficients).chain(stages).chain(tail) {
        if let Some(format) = formats.get(register) {
            config.widths.set(register, state(format));
        }
    }
    for end in [Register::Cut, Register::HandOver(1)] {
        let kept = formats.get(end).filter(|_| random.once_in(2));
        config.widths.set(end, kept.and_then(|format| coarser(random, format)));
    }
}

/// A format for an end of a segment with some fraction bits less, or none, or rarely no integer bit where one is
/// needed.
fn coarser(random: &mut Random, format: QFormat) -> Option<QFormat> {
    let most = format.fraction_bits();
    let fewer = random.integer(0, most.into()).min(random.integer(0, most.into())) as u32;
    let integer = if random.once_in(12) { format.integer_bits() } else { 1 };
    QFormat::unsigned(integer, most - fewer).ok()
}

/// Inputs of a row: corners, the cut and its neighbours, uniform, near one, above one, negative.
/// Only bits the input format holds.
pub fn inputs(random: &mut Random, datapath: &Datapath, cut: i64, count: usize) -> Vec<i64> {
    let format = datapath.formats().input;
    let one = 1_i64 << format.fraction_bits();
    let (least, most) = (format.min_bits(), format.max_bits());
    let mut list = vec![least, least + 1, most - 1, most];
    for place in [0, one / 2, cut, one] {
        list.extend((-2..=2).map(|offset| place + offset));
    }
    while list.len() < count {
        let reach = random.integer(0, format.fraction_bits().into()) as u32;
        let near = random.integer(0, 1 << reach);
        list.push(match random.integer(0, 9) {
            0..=2 => random.integer(0, one),
            3..=5 => one - near,
            6 => cut + near,
            7 => cut - near,
            8 => random.integer(least, most),
            _ => one + near,
        });
    }
    list.retain(|&x| format.holds(x.into()));
    list
}

/// Seed of [`designs`].
const SEED: u64 = 7;
/// Configurations that [`designs`] tries; about two thirds of them make hardware.
const CONFIGURATIONS: u64 = 400;

/// The presets and random configurations that make hardware, each with the source to draw its inputs from.
///
/// # Panics
/// When a preset makes none.
pub fn designs() -> impl Iterator<Item = (Random, Design)> {
    let presets = presets::ALL.iter().map(|preset| preset.config().unwrap());
    let sources = (0..CONFIGURATIONS).map(|stream| Random::new(SEED, stream));
    let mut presets = presets.collect::<Vec<_>>().into_iter();
    sources.filter_map(move |mut source| {
        let config = presets.next().unwrap_or_else(|| random(&mut source));
        Some((source, Design::new(config).ok()?))
    })
}

/// A request worth trying, also one at an address without a word.
#[must_use]
pub fn request(source: &mut Random, design: &Design) -> (u32, i64) {
    let address = source.integer(0, design.rom().depth() as i64) as u32;
    let cut = design.rows().get(address as usize).map_or(0, |row| row.cut);
    let xs = inputs(source, design.datapath(), cut, 30);
    (address, source.one_of(&xs))
}
