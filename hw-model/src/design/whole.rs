//! A design: a configuration with everything that follows from it.

use crate::budget::Bound;
use crate::config::{Config, Form};
use crate::datapath::Datapath;
use crate::rom::Rom;

use super::real_row::RealRow;

/// A configuration with everything that follows from it.
#[derive(Debug, Clone)]
pub struct Design {
    pub(super) config: Config,
    /// As they were fitted: before their ends were rounded to stated formats, and the domain cut them off.
    pub(super) fitted: Vec<RealRow>,
    pub(super) rows: Vec<RealRow>,
    pub(super) bounds: Vec<Bound>,
    pub(super) datapath: Datapath,
}

impl Design {
    /// The configuration from which this design follows.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// The real functions behind each ROM row, in the order of the addresses.
    #[must_use]
    pub fn rows(&self) -> &[RealRow] {
        &self.rows
    }

    /// The proved error bound of each row, in output ulp. (An output format that does not reach 1 shows
    /// its greatest value there: that ulp is the format's, and not in the bound.)
    #[must_use]
    pub fn bounds(&self) -> &[Bound] {
        &self.bounds
    }

    /// The data path: integers in, integers out, without a clock.
    #[must_use]
    pub const fn datapath(&self) -> &Datapath {
        &self.datapath
    }

    /// The ROM that the data path reads, row by row.
    #[must_use]
    pub const fn rom(&self) -> &Rom {
        self.datapath.rom()
    }

    /// True where the polynomial is evaluated in u = (1 − x)·2^e.
    #[must_use]
    pub fn is_centred(&self) -> bool {
        self.config.form == Form::Centred
    }
}
