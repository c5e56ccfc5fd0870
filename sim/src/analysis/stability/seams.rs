//! Every pair of neighbouring x of a row: where the output falls as x rises, and how far it jumps.
//!
//! x^n rises with x, and so should the intensity. Rounding can make it fall by an ulp where the curve
//! is flat; a hand-over can by any amount. A hand-over lies where another part answers than at the x below:
//! it is found by the regions the data path itself reports, whatever parts a configuration has. Blocks
//! overlap in one x, so that no pair is left out: a row has as many pairs as x, less one.
//!
//! An image has 8 bits: the intensity is rounded to 0..=255, and the largest step of that between
//! neighbouring x is what the finest gradient on a screen would show.

use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Block, Datapath};
use hw_model::design::Design;
use hw_model::highlight::phong;
use hw_model::quantise::real;
use hw_model::rom::FieldName;
use multiversion::multiversion;
use rayon::prelude::*;
use serde::Serialize;

use crate::analysis::error_report::Progress;

/// Pairs that go through the pipeline together.
const BLOCK: i64 = 1024;
/// Pairs that make one piece of work for a thread.
const PIECE: i64 = 1 << 18;
/// The greatest intensity of an image.
const WHITE: i128 = 255;

/// What one exponent's output does as x rises by an ulp at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SeamRow {
    /// The exponent.
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

/// One hand-over.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HandOver {
    /// The exponent.
    pub n: f64,
    /// What answers below.
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
    /// The configuration's name.
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
pub fn pairs(design: &Design, addresses: &[u32]) -> u64 {
    (design.datapath().front_end().greatest as u64).saturating_mul(addresses.len() as u64)
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
            let hand_over = design.datapath().row(address).get(FieldName::HandOver);
            let mut scan = scan(evaluate, first, last, fraction);
            scan.see_segments(design.datapath(), address, hand_over, (first, last));
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
            .flat_map(|(address, scan)| {
                scan.hand_overs.iter().map(|seam| hand_over(design, *address, seam))
            })
            .collect(),
    }
}

fn seam_row(design: &Design, address: u32, scan: &Scan) -> SeamRow {
    let x = |bits: i64| real(bits, design.config().input);
    let worst = scan.hand_overs.iter().reduce(|worst, seam| {
        if seam.jump.unsigned_abs() > worst.jump.unsigned_abs() { seam } else { worst }
    });
    SeamRow {
        n: design.rows()[address as usize].exponent,
        pairs: scan.pairs,
        falls: scan.falls,
        falls_within_part: scan.falls
            - scan.hand_overs.iter().filter(|seam| seam.jump < 0).count() as u64,
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

/// A greatest size and the x at which it is met first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Peak {
    size: i64,
    x: i64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Seam {
    from: Region,
    to: Region,
    /// The first x of the upper part.
    x: i64,
    jump: i64,
    image_step: i64,
}

/// What was seen of a row so far.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
struct Scan {
    pairs: u64,
    falls: u64,
    fall: Option<Peak>,
    rise: Option<Peak>,
    image: Option<Peak>,
    image_falls: u64,
    hand_overs: Vec<Seam>,
}

fn raise(peak: &mut Option<Peak>, size: i64, x: i64) {
    if size > peak.map_or(0, |peak| peak.size) {
        *peak = Some(Peak { size, x });
    }
}

impl Scan {
    /// Both; `later` has the greater x.
    fn and(mut self, later: Self) -> Self {
        self.pairs += later.pairs;
        self.falls += later.falls;
        self.image_falls += later.image_falls;
        for (peak, later) in [
            (&mut self.fall, later.fall),
            (&mut self.rise, later.rise),
            (&mut self.image, later.image),
        ] {
            if let Some(later) = later {
                raise(peak, later.size, later.x);
            }
        }
        self.hand_overs.extend(later.hand_overs);
        self
    }
}

/// Scans the pairs of neighbouring x from `first` to `last`, both included.
fn scan(
    mut evaluate: impl FnMut(&[i64], &mut Block),
    first: i64,
    last: i64,
    fraction: u32,
) -> Scan {
    let mut scan = Scan::default();
    let mut block = Block::default();
    let mut xs = Vec::with_capacity(BLOCK as usize + 1);
    let mut from = first;
    while from < last {
        let to = (from + BLOCK).min(last);
        xs.clear();
        xs.extend(from..=to);
        evaluate(&xs, &mut block);
        scan.see(&block, from, fraction);
        from = to;
    }
    scan
}

impl Scan {
    /// Sees the answers to x, x + 1, … in a block.
    fn see(&mut self, block: &Block, first: i64, fraction: u32) {
        let ys = &block.intensities;
        let Some(pairs) = ys.len().checked_sub(1) else { return };
        self.pairs += pairs as u64;
        let differences = differences(ys);
        self.falls += differences.falls;
        let place = |wanted: i64| {
            let found = ys.windows(2).position(|pair| pair[1] - pair[0] == wanted);
            first + 1 + found.unwrap_or(0) as i64
        };
        if -differences.least > self.fall.map_or(0, |peak| peak.size) {
            self.fall = Some(Peak { size: -differences.least, x: place(differences.least) });
        }
        if differences.greatest > self.rise.map_or(0, |peak| peak.size) {
            self.rise = Some(Peak { size: differences.greatest, x: place(differences.greatest) });
        }
        self.see_image(ys, first, fraction, &differences);
        if block.regions.windows(2).any(|pair| pair[0] != pair[1]) {
            self.see_regions(block, first, fraction);
        }
    }

    /// A step of d ulp is one of at most d·255/2^f + 1 in 8 bits: most blocks need no look.
    fn see_image(&mut self, ys: &[i64], first: i64, fraction: u32, differences: &Differences) {
        let largest = i128::from(differences.greatest.max(-differences.least));
        let most = ((largest * WHITE) >> fraction) as i64 + 1;
        let falls = differences.falls > 0;
        if !falls && most <= self.image.map_or(0, |peak| peak.size) {
            return;
        }
        for (index, pair) in ys.windows(2).enumerate() {
            let step = byte(pair[1], fraction) - byte(pair[0], fraction);
            self.image_falls += u64::from(step < 0);
            raise(&mut self.image, step.abs(), first + 1 + index as i64);
        }
    }

    fn see_regions(&mut self, block: &Block, first: i64, fraction: u32) {
        let ys = &block.intensities;
        for (index, pair) in block.regions.windows(2).enumerate() {
            if pair[0] != pair[1] {
                self.hand_overs.push(Seam {
                    from: pair[0],
                    to: pair[1],
                    x: first + 1 + index as i64,
                    jump: ys[index + 1] - ys[index],
                    image_step: byte(ys[index + 1], fraction) - byte(ys[index], fraction),
                });
            }
        }
    }
}

impl Scan {
    /// A hand-over between segments is within the polynomial's region, and is looked at by itself.
    fn see_segments(
        &mut self,
        datapath: &Datapath,
        address: u32,
        hand_over: i64,
        (first, last): (i64, i64),
    ) {
        // The pair whose greater x it is belongs to one piece only.
        if hand_over <= first || hand_over > last {
            return;
        }
        let [below, above] = [hand_over - 1, hand_over].map(|x| datapath.evaluate(address, x));
        if below.region == Region::Polynomial && above.region == Region::Polynomial {
            let fraction = datapath.formats().output.fraction_bits();
            let at = self.hand_overs.partition_point(|seam| seam.x < hand_over);
            let seam = Seam {
                from: below.region,
                to: above.region,
                x: hand_over,
                jump: above.intensity - below.intensity,
                image_step: byte(above.intensity, fraction) - byte(below.intensity, fraction),
            };
            self.hand_overs.insert(at, seam);
        }
    }
}

/// An intensity as an image has it: 0 to 255, rounded to the nearest, a tie up.
fn byte(intensity: i64, fraction: u32) -> i64 {
    let scaled = i128::from(intensity) * WHITE;
    ((scaled + (1_i128 << fraction >> 1)) >> fraction) as i64
}

struct Differences {
    least: i64,
    greatest: i64,
    falls: u64,
}

/// Compiled for the vector widths named here, the machine's own chosen at run time.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn differences(ys: &[i64]) -> Differences {
    let mut found = Differences { least: 0, greatest: 0, falls: 0 };
    for (below, above) in ys.iter().zip(&ys[1..]) {
        let difference = above - below;
        found.least = found.least.min(difference);
        found.greatest = found.greatest.max(difference);
        found.falls += u64::from(difference < 0);
    }
    found
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use hw_model::config::Config;
    use proptest::prelude::*;

    use super::*;

    /// Rises by one every 7 x, but for a fall of `depth` at the pair that ends in `at`.
    fn planted(at: i64, depth: i64) -> impl FnMut(&[i64], &mut Block) {
        move |xs, block| {
            let y = |x: i64| x / 7 + 1000 - if x >= at { depth } else { 0 };
            block.intensities = xs.iter().copied().map(y).collect();
            let region = |&x: &i64| if x < 40 { Region::Zero } else { Region::Polynomial };
            block.regions = xs.iter().map(region).collect();
        }
    }

    proptest! {
        #[test]
        fn a_planted_fall_is_found(last in 2_i64..5000, part in 0.0_f64..1.0, depth in 2_i64..99) {
            let at = 1 + (part * (last - 1) as f64) as i64;
            let seen = scan(planted(at, depth), 0, last, 15);
            prop_assert_eq!((seen.pairs, seen.falls), (last as u64, 1));
            let rise = i64::from(at % 7 == 0);
            prop_assert_eq!(seen.fall, Some(Peak { size: depth - rise, x: at }));
            let seam = seen.hand_overs.first().map(|seam| seam.x);
            prop_assert_eq!(seam, (last >= 40).then_some(40));
            prop_assert!(seen.hand_overs.len() <= 1);
        }

        /// Cut into pieces anywhere, it is the same scan.
        #[test]
        fn pieces_make_the_whole(last in 2_i64..4000, part in 0.0_f64..1.0, at in 1_i64..4000) {
            let middle = (part * last as f64) as i64;
            let whole = scan(planted(at, 5), 0, last, 12);
            let pieces = scan(planted(at, 5), 0, middle, 12).and(scan(planted(at, 5), middle, last, 12));
            prop_assert_eq!(pieces, whole);
        }
    }

    #[test]
    fn bytes_are_those_of_an_image() {
        assert_eq!([0, 64, 65, 1 << 14, 1 << 15].map(|bits| byte(bits, 15)), [0, 0, 1, 128, 255]);
        assert_eq!((byte(1, 1), byte(0, 1), byte(1 << 62, 62)), (128, 0, 255));
    }

    /// Against every x evaluated on its own, rank by rank.
    #[test]
    fn every_pair_of_a_design_is_seen() {
        for (rest, hands) in [
            (r#""method": "hermite", "form": "power", "tail": "rational""#, 1),
            (r#""method": "three_point", "cut": "minimum""#, 1),
            (r#""method": "schlick", "tail": "rational""#, 0),
        ] {
            let text = format!(
                r#"{{"name": "s", "exponents": "2,5,33", "input": "UQ1.10", "output": "UQ1.8", {rest}}}"#
            );
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
}
