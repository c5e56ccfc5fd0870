//! Where the parts of a data path stand in its picture: columns by rank, lanes by part.

use hw_model::datapath::Datapath;
use hw_model::registers::Register;

/// Room for the ports on the left and on the right.
pub(super) const PORTS: f64 = 104.0;
/// Width of a box.
pub(super) const BOX: f64 = 118.0;
/// Height of a box of a lane.
pub(super) const LANE: f64 = 62.0;
/// The distance between two columns, in SVG units.
const GAP: f64 = 98.0;
/// Between two wires above the lanes, or below.
pub(super) const WIRE: f64 = 24.0;
/// Where the first of those wires runs.
const FIRST_WIRE: f64 = 74.0;

/// One column: the ranks of a part, or several in which nothing new begins.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    /// The first rank that it stands for.
    pub(super) first: usize,
    /// The last rank that it stands for.
    pub(super) last: usize,
    /// The place of its left edge, in SVG units.
    pub(super) left: f64,
}

impl Column {
    /// Where it ends, and its registers stand.
    pub(super) fn right(&self) -> f64 {
        self.left + BOX
    }

    /// The place of its middle, in SVG units.
    pub(super) fn centre(&self) -> f64 {
        self.left + BOX / 2.0
    }

    /// How many ranks it stands for.
    pub(super) fn ranks(&self) -> usize {
        self.last + 1 - self.first
    }
}

/// The heights at which things stand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes {
    /// Wires above the lanes, the first of these many.
    pub(super) first_wire: f64,
    /// The polynomial, where there is one.
    pub(super) polynomial: f64,
    /// The wire of the variable.
    pub(super) variable: f64,
    /// The wire of region and status.
    pub(super) region: f64,
    /// The divider, where there is one.
    pub(super) tail: f64,
    /// The upper of the wires of A and B, where they run below.
    pub(super) tail_row: f64,
    /// The foot of the front end and of the clamp.
    pub(super) foot: f64,
    /// The foot of the ROM.
    pub(super) rom_foot: f64,
    /// The top of the register of x.
    pub(super) x: f64,
    /// The top of the handshake.
    pub(super) handshake: f64,
}

/// Height of the register of x.
pub(super) const X_HEIGHT: f64 = 44.0;

/// The columns, first rank to last.
pub(super) fn columns(datapath: &Datapath) -> Vec<Column> {
    let last = datapath.rank_count() - 1;
    // The last ranks of the parts that have a column of their own: ROM, front end, and stages or divisor.
    let stages = (1..=datapath.degree()).map(Register::T);
    let lines = stages.chain((datapath.degree() == 0).then_some(Register::Divisor));
    let ends = [datapath.rank_of(Register::Region) - 1, datapath.rank_of(Register::V)];
    let ends = ends.into_iter().chain(lines.map(|register| datapath.rank_of(register))).chain([last - 1, last]);
    let mut spans: Vec<(usize, usize)> = Vec::new();
    for end in ends {
        let first = spans.last().map_or(0, |&(_, before)| before + 1);
        if first <= end {
            spans.push((first, end));
        }
    }
    let place = |(index, (first, last)): (usize, (usize, usize))| Column {
        first,
        last,
        left: PORTS + (BOX + GAP) * index as f64,
    };
    spans.into_iter().enumerate().map(place).collect()
}

/// The heights for these many wires above the lanes.
pub(super) fn lanes(datapath: &Datapath, wires: usize) -> Lanes {
    let top = FIRST_WIRE + WIRE * wires as f64 + 8.0;
    let (polynomial, tail) = (datapath.degree() > 0, datapath.divider().is_some());
    let below = top + LANE;
    let both = polynomial && tail;
    let region = if polynomial { below + 52.0 } else { below + 24.0 };
    let tail_top = if polynomial { region + 30.0 } else { top };
    let foot = if both { tail_top + LANE } else { region + 16.0 };
    let rom_foot = if both { foot + 40.0 + WIRE } else { top + 6.0 };
    let x = rom_foot + 18.0;
    Lanes {
        first_wire: FIRST_WIRE,
        polynomial: top,
        variable: below + 20.0,
        region,
        tail: tail_top,
        tail_row: foot + 24.0,
        foot,
        rom_foot,
        x,
        handshake: foot.max(x + X_HEIGHT) + 28.0,
    }
}

/// The height of the `index`-th wire above the lanes.
pub(super) fn wire(lanes: &Lanes, index: usize) -> f64 {
    lanes.first_wire + WIRE * index as f64
}
