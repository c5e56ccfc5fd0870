//! Every x of every exponent, cut into pieces of work that one thread can have.
//!
//! The cut depends on the design alone, and not on the number of threads or machines: what is found in pieces is put
//! together in their order, and so comes out the same however the pieces were handed out.

use hw_model::design::Design;

/// A run of consecutive x of one ROM row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Piece {
    /// The address of the ROM row.
    pub address: u32,
    /// The least x, as bits in the input format.
    pub first: i64,
    /// The greatest x.
    pub last: i64,
}

impl Piece {
    /// How many x the piece has.
    #[must_use]
    pub const fn inputs(&self) -> u64 {
        (self.last - self.first + 1) as u64
    }
}

/// The pieces of a design, row by row, each row from x = 0 upwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pieces {
    length: i64,
    greatest: i64,
    rows: u64,
}

impl Pieces {
    /// The pieces of a design, of `length` x each; the last piece of a row is shorter.
    #[must_use]
    pub fn new(design: &Design, length: i64) -> Self {
        Self { length, greatest: design.datapath().front_end().greatest, rows: design.rom().depth() as u64 }
    }

    /// How many pieces a row has.
    #[must_use]
    pub const fn per_row(&self) -> u64 {
        (self.greatest / self.length + 1) as u64
    }

    /// How many there are.
    #[must_use]
    pub const fn count(&self) -> u64 {
        self.rows * self.per_row()
    }

    /// The piece of this number, counted from 0 and below [`count`](Self::count).
    #[must_use]
    pub const fn at(&self, index: u64) -> Piece {
        let address = (index / self.per_row()) as u32;
        let first = (index % self.per_row()) as i64 * self.length;
        let last = first + self.length - 1;
        Piece { address, first, last: if last < self.greatest { last } else { self.greatest } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_x_of_every_row_is_in_one_piece() {
        let design = Design::preset("compact").unwrap();
        let greatest = design.datapath().front_end().greatest;
        for length in [1 << 20, 3_000_001, greatest, greatest + 1, 1 << 40] {
            let pieces = Pieces::new(&design, length);
            let mut next = (0, 0);
            for piece in (0..pieces.count()).map(|index| pieces.at(index)) {
                assert_eq!((piece.address, piece.first), next, "length {length}");
                assert!(piece.first <= piece.last && piece.inputs() <= length as u64);
                next = if piece.last == greatest { (piece.address + 1, 0) } else { (piece.address, piece.last + 1) };
            }
            assert_eq!(next, (design.rom().depth() as u32, 0), "length {length}");
        }
    }
}
