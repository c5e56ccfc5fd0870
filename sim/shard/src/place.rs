//! Where the files of a plan stand.
//!
//! | in the directory of the plan | is |
//! |---|---|
//! | `plan.json` | the job, with everything that it depends on, and the number of shards |
//! | `results/shard-00003.json` | what shard 3 found |
//! | `rtl/` | for the kind of that name: the RTL, and the harness that Verilator built of it |
//! | `checkpoints/shard-00003.json` | how far shard 3 has come, while it is not done |

use std::path::{Path, PathBuf};

use crate::rtl::PROGRAM;

/// The directory of a plan.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a>(pub &'a Path);

impl Place<'_> {
    /// The plan.
    #[must_use]
    pub fn plan(&self) -> PathBuf {
        self.0.join("plan.json")
    }

    /// The directory of the results.
    #[must_use]
    pub fn results(&self) -> PathBuf {
        self.0.join("results")
    }

    /// The directory of the RTL.
    #[must_use]
    pub fn rtl(&self) -> PathBuf {
        self.0.join("rtl")
    }

    /// The harness that was built of the RTL. It is run in its own directory, and so has an absolute path.
    #[must_use]
    pub fn program(&self) -> PathBuf {
        let program = self.rtl().join(PROGRAM);
        std::path::absolute(&program).unwrap_or(program)
    }

    /// The result of a shard.
    #[must_use]
    pub fn result(&self, index: u32) -> PathBuf {
        self.results().join(file(index))
    }

    /// The checkpoint of a shard.
    #[must_use]
    pub fn checkpoint(&self, index: u32) -> PathBuf {
        self.0.join("checkpoints").join(file(index))
    }
}

fn file(index: u32) -> String {
    format!("shard-{index:05}.json")
}
