//! A run and a block of inputs give what the ranks give one at a time.

use hw_model::datapath::Block;
use naive::configurations::{designs, inputs};

/// Runs of consecutive x, across the cut, 0 and 1 wherever the input format goes there.
#[test]
fn a_run_is_a_block_is_the_ranks() {
    let mut block = Block::default();
    let mut compared = 0;
    for (mut source, design) in designs() {
        let datapath = design.datapath();
        let format = datapath.formats().input;
        let address = source.integer(0, design.rom().depth() as i64) as u32;
        let cut = design.rows().get(address as usize).map_or(0, |row| row.cut);
        for first in inputs(&mut source, datapath, cut, 24) {
            let from = (first - source.integer(0, 300)).max(format.min_bits());
            let count = source.integer(1, 400).min(format.max_bits() - from + 1);
            let xs: Vec<i64> = (from..from + count).collect();
            let mut run = vec![-1; xs.len()];
            datapath.evaluate_run(address, from, &mut run);
            datapath.evaluate_block(address, &xs, &mut block);
            assert_eq!(run, block.intensities, "{} {address} {from}", design.config().to_json());
            for (&x, &intensity) in xs.iter().zip(&run).step_by(37) {
                assert_eq!(intensity, datapath.evaluate(address, x).intensity, "{address} {x}");
            }
            compared += xs.len();
        }
    }
    assert!(compared > 100_000, "{compared}");
}
