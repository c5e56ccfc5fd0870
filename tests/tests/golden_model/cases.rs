//! Configurations, requests and clock cycles that every way is asked.

use hw_model::config::Config;
use hw_model::design::Design;
use model::{Clocked, Model};
use naive::configurations::{Random, random};
use sim::pipeline::Inputs;

/// Presets beside the random configurations: the wide lanes of random ones are rarely the presets' narrow ones.
const PRESETS: [&str; 4] = ["paper", "compact", "precise", "schlick"];
/// Configurations in all.
pub const CONFIGURATIONS: usize = 10;
/// Requests to each.
pub const REQUESTS: usize = 100_000;
/// Clock cycles of each.
pub const CYCLES: usize = 10_000;

/// A configuration, what it is asked, and what Rust answers.
pub struct Case {
    pub model: Model,
    /// As JSON.
    pub configuration: String,
    pub addresses: Vec<u32>,
    pub xs: Vec<i64>,
    pub cycles: Vec<Inputs>,
    /// The golden model's answers to the requests: intensity and status.
    pub answers: Vec<[i64; 2]>,
    /// What its ports show in each cycle: in_ready, out_valid, intensity, status.
    pub shown: Vec<[i64; 4]>,
}

/// The cases, the same in every run.
pub fn all() -> Vec<Case> {
    let mut source = Random::new(17, 0);
    let presets = PRESETS.map(|name| hw_model::presets::find(name).unwrap().config().unwrap());
    let mut designs: Vec<Design> = presets.into_iter().map(|config: Config| Design::new(config).unwrap()).collect();
    while designs.len() < CONFIGURATIONS {
        designs.extend(Design::new(random(&mut source)).ok());
    }
    designs.into_iter().map(|design| case(design, &mut source)).collect()
}

fn case(design: Design, source: &mut Random) -> Case {
    let configuration = design.config().to_json();
    let model = Model::new(design);
    let (addresses, xs): (Vec<u32>, Vec<i64>) = (0..REQUESTS).map(|_| request(&model, source)).unzip();
    let (mut intensities, mut status) = (vec![0; REQUESTS], vec![0; REQUESTS]);
    model.evaluate_all(model::Addresses::Each(&addresses), &xs, &mut intensities, &mut status).unwrap();
    let answers = intensities.iter().zip(&status).map(|(&intensity, &status)| [intensity, status.into()]).collect();
    let cycles = cycles(&model, source);
    let mut pipeline = Clocked::new(&model);
    let shown = cycles.iter().map(|inputs| {
        let outputs = pipeline.tick(inputs).unwrap();
        [outputs.in_ready.into(), outputs.out_valid.into(), outputs.intensity, outputs.status.bits().into()]
    });
    let shown = shown.collect();
    Case { model, configuration, addresses, xs, cycles, answers, shown }
}

/// An address with a word or just beyond them, and an x: of all, near 1, or at an end of the format.
fn request(model: &Model, source: &mut Random) -> (u32, i64) {
    let design = model.design();
    let input = model.datapath().formats().input;
    let depth = design.rom().depth() as i64;
    let greatest_address = (1_i64 << design.rom().address_width()) - 1;
    let address =
        if source.once_in(40) { source.integer(depth, greatest_address) } else { source.integer(0, depth - 1) };
    let near = source.integer(0, i64::from(input.fraction_bits()));
    let x = match source.integer(0, 9) {
        0..=3 => source.integer(input.min_bits(), input.max_bits()),
        4..=8 => input.one() - source.integer(-1, 1_i64 << near),
        _ => source.one_of(&[input.min_bits(), input.max_bits(), 0, input.one()]),
    };
    (address as u32, x.clamp(input.min_bits(), input.max_bits()))
}

/// Blocks of cycles with and without stalls, bubbles and resets.
fn cycles(model: &Model, source: &mut Random) -> Vec<Inputs> {
    let mut made = Vec::with_capacity(CYCLES);
    let [mut stalls, mut bubbles, mut resets] = [false; 3];
    for cycle in 0..CYCLES {
        if cycle % 64 == 0 {
            [stalls, bubbles, resets] = [source.once_in(2), source.once_in(2), source.once_in(4)];
        }
        let (address, x) = request(model, source);
        made.push(Inputs {
            in_valid: !(bubbles && source.once_in(2)),
            address,
            x,
            out_ready: !(stalls && source.once_in(2)),
            reset: cycle == 0 || resets && source.once_in(30),
        });
    }
    made
}
