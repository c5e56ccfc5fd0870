//! What is seen of the pairs of neighbouring x of one row, block by block and piece by piece.

use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Block, Datapath};
use multiversion::multiversion;

/// Pairs that go through the pipeline together.
const BLOCK: i64 = 1024;
/// The greatest intensity of an image.
const WHITE: i128 = 255;

/// A greatest size and the x at which it is met first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Peak {
    pub(super) size: i64,
    pub(super) x: i64,
}

/// A place at which the region changes as x rises.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Seam {
    pub(super) from: Region,
    pub(super) to: Region,
    /// The first x of the upper part.
    pub(super) x: i64,
    pub(super) jump: i64,
    pub(super) image_step: i64,
}

/// What was seen of a row so far.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Scan {
    pub(super) pairs: u64,
    pub(super) falls: u64,
    pub(super) fall: Option<Peak>,
    pub(super) rise: Option<Peak>,
    pub(super) image: Option<Peak>,
    pub(super) image_falls: u64,
    pub(super) hand_overs: Vec<Seam>,
}

fn raise(peak: &mut Option<Peak>, size: i64, x: i64) {
    if size > peak.map_or(0, |peak| peak.size) {
        *peak = Some(Peak { size, x });
    }
}

impl Scan {
    /// Both; `later` has the greater x.
    pub(super) fn and(mut self, later: Self) -> Self {
        self.pairs += later.pairs;
        self.falls += later.falls;
        self.image_falls += later.image_falls;
        for (peak, later) in
            [(&mut self.fall, later.fall), (&mut self.rise, later.rise), (&mut self.image, later.image)]
        {
            if let Some(later) = later {
                raise(peak, later.size, later.x);
            }
        }
        self.hand_overs.extend(later.hand_overs);
        self
    }
}

/// Scans the pairs of neighbouring x from `first` to `last`, both included.
pub(super) fn scan(mut evaluate: impl FnMut(&[i64], &mut Block), first: i64, last: i64, fraction: u32) -> Scan {
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

    /// A hand-over between segments is within the polynomial's region, and is looked at by itself.
    pub(super) fn see_segments(
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
}
