//! Every x of a piece through the harness, and the golden model beside it.

use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

use analysis::pieces::Piece;
use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Block, Datapath, Status};
use serde::{Deserialize, Serialize};

use super::error::{RtlError, WORD_BITS};

/// Samples compared at a time.
const CHUNK: usize = 1 << 16;

/// How many results were compared, and how many differ.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// The number of results compared.
    pub compared: u64,
    /// The number of results that differ from the model's.
    pub different: u64,
    /// The first x whose result differs, as bits in the input format.
    pub first_different: Option<i64>,
}

impl Counts {
    /// The counts of both; `later` has the greater x.
    #[must_use]
    pub fn and(self, later: Self) -> Self {
        Self {
            compared: self.compared + later.compared,
            different: self.different + later.different,
            first_different: self.first_different.or(later.first_different),
        }
    }
}

/// Every x of a piece. `program` is run in `directory`, where its ROM image is.
///
/// # Errors
/// When the harness cannot run, or gives another number of results.
pub fn compare(program: &Path, directory: &Path, datapath: &Datapath, piece: Piece) -> Result<Counts, RtlError> {
    let Piece { address, first, last } = piece;
    let width = datapath.formats().output.width();
    let bits = width + datapath.status_width();
    if bits > WORD_BITS {
        return Err(RtlError::Wide { bits });
    }
    let no_program = |cause| RtlError::NoProgram { program: program.to_owned(), cause };
    let mut child = Command::new(program)
        .args([address.to_string(), first.to_string(), last.to_string()])
        .args([width.to_string(), (datapath.latency() + 1).to_string()])
        .current_dir(directory)
        .stdout(Stdio::piped())
        .spawn()
        .map_err(no_program)?;
    let short = |x| move |cause| RtlError::Short { address, x, cause };
    let Some(mut words) = child.stdout.take() else {
        return Err(no_program(std::io::Error::other("it has no output")));
    };
    let mut counts = Counts::default();
    let mut golden = Golden::new(datapath);
    let mut bytes = vec![0; CHUNK * 4];
    let mut x = first;
    while x <= last {
        let count = CHUNK.min((last - x) as usize + 1);
        let bytes = &mut bytes[..count * 4];
        words.read_exact(bytes).map_err(short(x))?;
        golden.evaluate(address, x, count);
        counts = counts.and(golden.counts(x, bytes));
        x += count as i64;
    }
    let mut rest = Vec::new();
    words.read_to_end(&mut rest).map_err(short(x))?;
    let status = child.wait().map_err(short(x))?;
    if !rest.is_empty() || !status.success() {
        return Err(RtlError::Surplus { address, bytes: rest.len(), status: status.to_string() });
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

    /// How many of the words (little endian) are others, and which is the first. No x here is above 1 or negative, so
    /// the one flag that can be set is that of the clamp.
    fn counts(&self, x: i64, bytes: &[u8]) -> Counts {
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
        let mut pairs = results.map(word).zip(given);
        let compared = pairs.len() as u64;
        let Some(first) = pairs.position(|(wanted, got)| wanted != got) else {
            return Counts { compared, different: 0, first_different: None };
        };
        let different = 1 + pairs.filter(|(wanted, got)| wanted != got).count() as u64;
        Counts { compared, different, first_different: Some(x + first as i64) }
    }
}
