//! Every pair of neighbouring x of a row: where the output falls as x rises, and how far it jumps.
//!
//! x^n rises with x, and so should the intensity. Rounding can make it fall by an ulp where the curve
//! is flat; a hand-over can by any amount. A hand-over lies where another part answers than at the x below:
//! it is found by the regions the data path itself reports, whatever parts a configuration has. Blocks
//! overlap in one x, so that no pair is left out: a row has as many pairs as x, less one.
//!
//! An image has 8 bits: the intensity is rounded to 0..=255, and the largest step of that between
//! neighbouring x is what the finest gradient on a screen would show.

mod scan;

use hw_model::datapath::Block;
use hw_model::design::Design;
use hw_model::highlight::phong;
use hw_model::quantise::real;
use rayon::prelude::*;
use serde::Serialize;

use self::scan::{Scan, Seam};
use vectors::progress::Progress;

/// Pairs that make one piece of work for a thread.
const PIECE: i64 = 1 << 18;

/// What one exponent's output does as x rises by an ulp at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SeamRow {
    /// The exponent of the row.
    pub n: f64,
    /// Pairs of neighbouring x.
    pub pairs: u64,
    /// Pairs at which the output falls.
    pub falls: u64,
    /// Those of them where the same part answers on both sides.
    pub falls_within_part: u64,
    /// The deepest fall, in ulp of the output.
    pub deepest_fall_ulp: i64,
    /// The greater x of the first such pair; none where nothing falls.
    pub deepest_fall_x: Option<f64>,
    /// The highest rise, in ulp of the output.
    pub highest_rise_ulp: i64,
    /// The greater x of the first such pair.
    pub highest_rise_x: Option<f64>,
    /// Hand-overs from one part to another.
    pub hand_overs: u64,
    /// The jump at the hand-over where it is largest, upwards positive, in ulp of the output.
    pub hand_over_jump_ulp: Option<i64>,
    /// The greater x of that pair.
    pub hand_over_x: Option<f64>,
    /// The largest step of the 8-bit intensity.
    pub image_step: i64,
    /// The greater x of the first such pair.
    pub image_step_x: Option<f64>,
    /// Pairs at which the 8-bit intensity falls.
    pub image_falls: u64,
}

/// A pair of neighbouring x at which another part of the pipeline takes over.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HandOver {
    /// The exponent of the row.
    pub n: f64,
    /// The region that answers below `x`.
    pub from: &'static str,
    /// What answers from `x` on.
    pub to: &'static str,
    /// The bits of the first x that the upper part answers.
    pub x_bits: i64,
    /// The same as a number.
    pub x: f64,
    /// The output there less the output an ulp of x below, in ulp of the output.
    pub jump_ulp: i64,
    /// What x^n does there, in the same unit.
    pub reference_ulp: f64,
    /// What the 8-bit intensity does there.
    pub image_step: i64,
}

/// Every exponent asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SeamReport {
    /// The name of the configuration.
    pub configuration: String,
    /// Pairs of neighbouring x, all exponents together.
    pub pairs: u64,
    /// One for each exponent.
    pub rows: Vec<SeamRow>,
    /// Every hand-over of each.
    pub hand_overs: Vec<HandOver>,
}

/// The number of pairs that a report over these addresses sees.
#[must_use]
pub fn pairs(design: &Design, addresses: &[u32]) -> u128 {
    design.datapath().front_end().greatest as u128 * addresses.len() as u128
}

/// Scans every pair of neighbouring x in [0, 1] at these addresses, each of which has a ROM word.
#[must_use]
pub fn seam_report(design: &Design, addresses: &[u32], progress: &dyn Progress) -> SeamReport {
    let greatest = design.datapath().front_end().greatest;
    let pieces = (greatest + PIECE - 1) / PIECE;
    let scanned: Vec<Scan> = (0..addresses.len() as i64 * pieces)
        .into_par_iter()
        .map(|index| {
            let (address, piece) = (addresses[(index / pieces) as usize], index % pieces);
            let (first, last) = (piece * PIECE, (piece * PIECE + PIECE).min(greatest));
            let evaluate = |xs: &[i64], block: &mut Block| {
                design.datapath().evaluate_block(address, xs, block);
            };
            let fraction = design.config().output.fraction_bits();
            let row = design.datapath().row(address);
            let mut scan = scan::scan(evaluate, first, last, fraction);
            for segment in 1..design.datapath().segment_count() {
                let hand_over = design.datapath().front_end().hand_over(&row, segment);
                scan.see_segments(design.datapath(), address, hand_over, (first, last));
            }
            progress.advance(scan.pairs);
            scan
        })
        .collect();
    let rows: Vec<(u32, Scan)> = addresses
        .iter()
        .copied()
        .zip(scanned.chunks(pieces.max(1) as usize))
        .map(|(address, pieces)| (address, pieces.iter().cloned().fold(Scan::default(), Scan::and)))
        .collect();
    SeamReport {
        configuration: design.config().name.clone(),
        pairs: rows.iter().map(|(_, scan)| scan.pairs).sum(),
        rows: rows.iter().map(|(address, scan)| seam_row(design, *address, scan)).collect(),
        hand_overs: rows
            .iter()
            .flat_map(|(address, scan)| scan.hand_overs.iter().map(|seam| hand_over(design, *address, seam)))
            .collect(),
    }
}

fn seam_row(design: &Design, address: u32, scan: &Scan) -> SeamRow {
    let x = |bits: i64| real(bits, design.config().input);
    let worst = scan
        .hand_overs
        .iter()
        .reduce(|worst, seam| if seam.jump.unsigned_abs() > worst.jump.unsigned_abs() { seam } else { worst });
    SeamRow {
        n: design.rows()[address as usize].exponent,
        pairs: scan.pairs,
        falls: scan.falls,
        falls_within_part: scan.falls - scan.hand_overs.iter().filter(|seam| seam.jump < 0).count() as u64,
        deepest_fall_ulp: scan.fall.map_or(0, |peak| peak.size),
        deepest_fall_x: scan.fall.map(|peak| x(peak.x)),
        highest_rise_ulp: scan.rise.map_or(0, |peak| peak.size),
        highest_rise_x: scan.rise.map(|peak| x(peak.x)),
        hand_overs: scan.hand_overs.len() as u64,
        hand_over_jump_ulp: worst.map(|seam| seam.jump),
        hand_over_x: worst.map(|seam| x(seam.x)),
        image_step: scan.image.map_or(0, |peak| peak.size),
        image_step_x: scan.image.map(|peak| x(peak.x)),
        image_falls: scan.image_falls,
    }
}

fn hand_over(design: &Design, address: u32, seam: &Seam) -> HandOver {
    let config = design.config();
    let n = design.rows()[address as usize].exponent;
    let x = |bits: i64| real(bits, config.input);
    let rise = phong(n, x(seam.x)) - phong(n, x(seam.x - 1));
    HandOver {
        n,
        from: if seam.from == seam.to { "second segment" } else { seam.from.name() },
        to: seam.to.name(),
        x_bits: seam.x,
        x: x(seam.x),
        jump_ulp: seam.jump,
        reference_ulp: rise / config.output.ulp(),
        image_step: seam.image_step,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use hw_model::config::Config;

    use super::*;

    /// Against every x evaluated on its own, rank by rank.
    #[test]
    fn every_pair_of_a_design_is_seen() {
        for (rest, hands) in [
            (r#""method": "hermite", "form": "power", "tail": "rational""#, 1),
            (r#""method": "three_point", "cut": "minimum""#, 1),
            (r#""method": "schlick", "tail": "rational""#, 0),
        ] {
            let text =
                format!(r#"{{"name": "s", "exponents": "2,5,33", "input": "UQ1.10", "output": "UQ1.8", {rest}}}"#);
            let design = Design::new(Config::from_json(&text).unwrap()).unwrap();
            let count = AtomicU64::new(0);
            let report = seam_report(&design, &[0, 2], &count);
            assert_eq!(report.pairs, 2 * 1024);
            assert_eq!((count.load(Ordering::Relaxed), pairs(&design, &[0, 2])), (2048, 2048));
            for (row, address) in report.rows.iter().zip([0, 2]) {
                let y = |x| design.datapath().evaluate(address, x).intensity;
                let steps: Vec<(i64, i64)> = (1..=1024).map(|x| (x, y(x) - y(x - 1))).collect();
                let falls = steps.iter().filter(|(_, step)| *step < 0).count() as u64;
                assert_eq!((row.pairs, row.falls), (1024, falls), "{text}");
                let deepest = steps.iter().map(|(_, step)| -step).max().unwrap().max(0);
                assert_eq!(row.deepest_fall_ulp, deepest);
                let highest = steps.iter().map(|(_, step)| *step).max().unwrap();
                assert_eq!(row.highest_rise_ulp, highest);
                let place = steps.iter().find(|(_, step)| *step == highest).unwrap().0;
                assert_eq!(row.highest_rise_x, Some(place as f64 / 1024.0));
                assert_eq!(row.hand_overs, hands);
                let byte = |x| (y(x) * 510 + 256) / 512;
                let image = (1..=1024).map(|x| (byte(x) - byte(x - 1)).abs()).max().unwrap();
                assert_eq!(row.image_step, image);
                let image_falls = (1..=1024).filter(|&x| byte(x) < byte(x - 1)).count() as u64;
                assert_eq!(row.image_falls, image_falls);
            }
            for seam in &report.hand_overs {
                let row = design.rows().iter().find(|row| row.exponent == seam.n).unwrap();
                assert_eq!(seam.x_bits, row.cut, "a part ends at the cut");
            }
        }
    }

    /// Within the polynomial's region no part tells of the hand-over: it is found by the ROM's word alone.
    #[test]
    fn two_segments_meet_at_a_seam_of_their_own() {
        let design = two_segments();
        let report = seam_report(&design, &[0, 1, 2], &AtomicU64::new(0));
        let found: Vec<(f64, &str, i64)> =
            report.hand_overs.iter().map(|seam| (seam.n, seam.from, seam.x_bits)).collect();
        let rows = design.rows();
        // n = 2 is a cubic itself, down to x = 0: nothing is cut off.
        let expected = [
            (2.0, "second segment", hand_over(&rows[0])),
            (8.0, "zero", rows[1].cut),
            (8.0, "second segment", hand_over(&rows[1])),
            (33.0, "zero", rows[2].cut),
            (33.0, "second segment", hand_over(&rows[2])),
        ];
        assert_eq!(found, expected);
        assert_eq!(report.rows.iter().map(|row| row.hand_overs).collect::<Vec<_>>(), [1, 2, 2]);
        for seam in &report.hand_overs {
            let row = rows.iter().position(|row| row.exponent == seam.n).unwrap() as u32;
            let y = |x| design.datapath().evaluate(row, x).intensity;
            assert_eq!(seam.jump_ulp, y(seam.x_bits) - y(seam.x_bits - 1), "{seam:?}");
            assert!(seam.jump_ulp.abs() <= 1, "{seam:?}");
        }
        // What answers below the hand-over is near x^n, as the first segment gone on with would not be.
        for (address, row) in rows.iter().enumerate() {
            for x in [row.cut.max(1), row.cut.midpoint(hand_over(row)), hand_over(row) - 1] {
                let y = design.datapath().evaluate(address as u32, x).intensity as f64;
                let exact = phong(row.exponent, real(x, design.config().input)) * 1024.0;
                assert!((y - exact).abs() < 4.0, "n = {}, x = {x}: {y}, {exact}", row.exponent);
            }
        }
    }

    /// However [0, 1] is cut into pieces, one of them has the hand-over.
    #[test]
    fn a_hand_over_of_segments_belongs_to_one_piece() {
        let design = two_segments();
        let hand_over = hand_over(&design.rows()[1]);
        let seen = |first, last| {
            let mut scan = Scan::default();
            scan.see_segments(design.datapath(), 1, hand_over, (first, last));
            scan.hand_overs.iter().map(|seam| seam.x).collect::<Vec<_>>()
        };
        assert_eq!(seen(0, hand_over - 1), Vec::<i64>::new());
        assert_eq!(seen(hand_over - 1, hand_over), [hand_over]);
        assert_eq!(seen(hand_over, 1 << 16), Vec::<i64>::new());
    }

    fn hand_over(row: &hw_model::design::RealRow) -> i64 {
        row.segments[1].start
    }

    fn two_segments() -> Design {
        let text = r#"{"name": "two", "method": "minimax", "segments": 2, "cut": "balanced", "tail": "zero",
            "form": "centred", "exponents": "2,8,33", "input": "UQ1.16", "output": "UQ1.10"}"#;
        Design::new(Config::from_json(text).unwrap()).unwrap()
    }
}
