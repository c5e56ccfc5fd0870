//! Every x of every exponent through the verilated RTL, against the golden model.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Block, Datapath, Status};
use hw_model::rtl::SOURCES;
use vectors::rtl::PACKAGE;

use super::{Failure, failed};

/// Samples compared at a time.
const CHUNK: usize = 1 << 16;

const HARNESS: &str = include_str!("exhaustive.cpp");

/// How many results of a run were compared, and how many differ.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// The number of results compared.
    pub compared: u64,
    /// The number of results that differ from the model's.
    pub different: u64,
}

/// Builds the harness in a directory of RTL.
///
/// # Errors
/// With what the compiler says.
pub fn build(directory: &Path) -> Result<PathBuf, Failure> {
    let harness = directory.join("exhaustive.cpp");
    std::fs::write(&harness, HARNESS).map_err(|error| Failure(error.to_string()))?;
    let output = Command::new("verilator")
        .args(["--cc", "--exe", "--build", "-j", "2", "-O3", "--x-assign", "fast"])
        .args(["--x-initial", "fast", "-CFLAGS", "-O3", "--top-module", "blysk"])
        .args(["-MAKEFLAGS", "OPT_FAST=-O3", "--Mdir", "exhaustive", "-o", "exhaustive"])
        .arg(PACKAGE)
        .args(SOURCES.map(|(name, _)| name))
        .arg("exhaustive.cpp")
        .current_dir(directory)
        .output()
        .map_err(|error| Failure(format!("cannot run verilator: {error}; run scripts/setup")))?;
    if !output.status.success() {
        return failed(String::from_utf8_lossy(&[output.stdout, output.stderr].concat()));
    }
    Ok(directory.join("exhaustive/exhaustive"))
}

/// Every x in [0, 1] of the addresses `first..=last`.
///
/// # Errors
/// When the harness cannot run, or gives another number of results.
pub fn compare(
    program: &Path,
    directory: &Path,
    datapath: &Datapath,
    (first, last): (u32, u32),
) -> Result<Counts, Failure> {
    let greatest = datapath.front_end().greatest;
    let output = datapath.formats().output;
    let mut child = Command::new(program)
        .args([first.to_string(), last.to_string(), greatest.to_string()])
        .arg(output.width().to_string())
        .current_dir(directory)
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| Failure(format!("cannot run {}: {error}", program.display())))?;
    let Some(mut words) = child.stdout.take() else { return failed("no output to compare") };
    let mut counts = Counts::default();
    let mut golden = Golden::new(datapath);
    let mut bytes = vec![0; CHUNK * 4];
    for address in first..=last {
        let mut x = 0;
        while x <= greatest {
            let count = CHUNK.min((greatest - x) as usize + 1);
            let bytes = &mut bytes[..count * 4];
            words
                .read_exact(bytes)
                .map_err(|error| Failure(format!("address {address}, x from {x}: results are missing: {error}")))?;
            golden.evaluate(address, x, count);
            counts.compared += count as u64;
            counts.different += golden.differences(bytes);
            x += count as i64;
        }
    }
    let mut rest = Vec::new();
    words.read_to_end(&mut rest).map_err(|error| Failure(error.to_string()))?;
    let status = child.wait().map_err(|error| Failure(error.to_string()))?;
    if !rest.is_empty() || !status.success() {
        return failed(format!("{} bytes more than there are results; {status}", rest.len()));
    }
    Ok(counts)
}

/// The golden model's words for a run of x.
struct Golden<'a> {
    datapath: &'a Datapath,
    xs: Vec<i64>,
    block: Block,
}

impl<'a> Golden<'a> {
    fn new(datapath: &'a Datapath) -> Self {
        Self { datapath, xs: Vec::new(), block: Block::default() }
    }

    fn evaluate(&mut self, address: u32, x: i64, count: usize) {
        self.xs.clear();
        self.xs.extend(x..x + count as i64);
        let row = self.datapath.row(address);
        self.datapath.evaluate_row(&row, None, &self.xs, &mut self.block);
    }

    /// How many of the words (little endian) are others. No x here is above 1 or negative, so the one
    /// flag that can be set is that of the clamp.
    fn differences(&self, bytes: &[u8]) -> u64 {
        let one = self.datapath.output_one();
        let width = self.datapath.formats().output.width();
        let clamped = u32::from(Status::CLAMPED.bits()) << width;
        let results = self.block.intensities.iter().zip(&self.block.regions);
        let word = |(&t3, &region): (&i64, &Region)| {
            let intensity = t3.clamp(0, one);
            let flag = region == Region::Polynomial && intensity != t3;
            intensity as u32 | if flag { clamped } else { 0 }
        };
        let given = bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        results.map(word).zip(given).filter(|(wanted, got)| wanted != got).count() as u64
    }
}
