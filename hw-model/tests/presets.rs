//! Every preset makes hardware that keeps its budget, and its own JSON comes back.

use hw_model::config::Config;
use hw_model::datapath::Block;
use hw_model::design::Design;
use hw_model::presets;
use hw_model::quantise::real;

#[test]
fn every_preset_parses_and_prints_itself() {
    for preset in presets::ALL {
        let config = preset.config().unwrap();
        assert_eq!(config.name, preset.name);
        assert_eq!(Config::from_json(&config.to_json()).unwrap(), config);
    }
}

/// The promise of the budget, at points spread over the whole range and dense near 1.
#[test]
fn every_preset_keeps_its_error_budget() {
    for preset in presets::ALL {
        let design = Design::new(preset.config().unwrap()).unwrap();
        let config = design.config();
        let one = config.input.one();
        let mut xs: Vec<i64> = (0..=4096).map(|i| one * i / 4096).collect();
        xs.extend((0..4096).map(|i| one - i * i / 2));
        let mut block = Block::default();
        let mut compared = 0;
        for (address, row) in design.rows().iter().enumerate() {
            design.datapath().evaluate_block(address as u32, &xs, &mut block);
            for (&x, &bits) in xs.iter().zip(&block.intensities) {
                let s = real(one - x, config.input);
                let wanted = row.value_at_s(s, x >= row.cut);
                let error = (real(bits, config.output) - wanted).abs() / config.output.ulp();
                let bound = design.bounds()[address].total();
                assert!(
                    error <= bound * (1.0 + 1e-9),
                    "{} n = {} x = {x}: {error} ulp, bound {bound}",
                    preset.name,
                    row.exponent
                );
                compared += 1;
            }
        }
        assert_eq!(compared, 256 * xs.len());
    }
}

/// The block of samples and the ranks of registers are one implementation.
#[test]
fn a_block_gives_what_the_ranks_give() {
    for preset in presets::ALL {
        let design = Design::new(preset.config().unwrap()).unwrap();
        let datapath = design.datapath();
        let one = design.config().input.one();
        let xs: Vec<i64> = (-100..=1500).map(|i| one * i / 1400).collect();
        let mut block = Block::default();
        let (mut intensities, mut status) = (vec![-1; xs.len()], vec![0xff; xs.len()]);
        for address in [0, 1, 2, 63, 255, 256, 300] {
            datapath.evaluate_block(address, &xs, &mut block);
            datapath.answer_block(address, &xs, &mut intensities, &mut status);
            assert_eq!(block.intensities, intensities, "{} {address}", preset.name);
            for ((&x, (&bits, &region)), &status) in
                xs.iter().zip(block.intensities.iter().zip(&block.regions)).zip(&status)
            {
                let last = datapath.evaluate(address, x);
                assert_eq!((last.intensity, last.region, last.status.bits()), (bits, region, status), "{address} {x}");
            }
        }
    }
}

/// A run of consecutive x, from below 0 or across the cut to above 1, gives what the block gives.
#[test]
fn a_run_gives_what_a_block_gives() {
    for preset in presets::ALL {
        let design = Design::new(preset.config().unwrap()).unwrap();
        let datapath = design.datapath();
        let one = design.config().input.one();
        let mut block = Block::default();
        let mut run = vec![0; 1500];
        for address in [0, 1, 2, 3, 63, 255, 256, 300] {
            let cut = design.rows().get(address as usize).map_or(one, |row| row.cut);
            for first in [-700, 0, cut - 700, cut, cut + 1, one - 1400] {
                let xs: Vec<i64> = (first..).take(run.len()).collect();
                datapath.evaluate_block(address, &xs, &mut block);
                datapath.evaluate_run(address, first, &mut run);
                assert_eq!(run, block.intensities, "{} {address} {first}", preset.name);
            }
        }
    }
}
