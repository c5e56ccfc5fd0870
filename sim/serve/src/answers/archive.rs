//! The RTL of a configuration, as `blysk rtl` writes it, in one archive.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use vectors::case::{DEFAULT_COUNT, DEFAULT_SEED, Strategy};
use vectors::rtl::{self, Emission};
use vectors::{Bundle, OutputSet};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use crate::configuration::{Configuration, PASTED};
use crate::known::Known;
use crate::refusal::Refusal;

/// The archive. Its files are made below `directory` and do not stay there; it has no time in it, so that the same
/// configuration gives the same bytes.
///
/// # Errors
/// When a file cannot be written.
pub(crate) fn archive(known: &Known, directory: &Path) -> Result<Vec<u8>, Refusal> {
    let place = tempfile::tempdir_in(directory).map_err(Refusal::own)?;
    write_rtl(known, place.path())?;
    pack(place.path(), &known.design.config().name).map_err(Refusal::own)
}

fn write_rtl(known: &Known, place: &Path) -> Result<(), Refusal> {
    let strategy = Strategy::default();
    let command = known.configuration.rtl_command();
    let emission = Emission::default();
    let bundle = Bundle::new(&known.design, strategy, DEFAULT_COUNT, DEFAULT_SEED, &command);
    let bundle = bundle.map_err(Refusal::unusable)?;
    let set = OutputSet::create(place).and_then(|set| set.listed("rtl")?.announce(rtl::names(&emission, strategy)));
    let mut set = set.map_err(Refusal::own)?;
    rtl::stage(&bundle, &emission, &command, &mut set).map_err(Refusal::own)?;
    set.commit().map_err(Refusal::own)?;
    // What the command in the files reads.
    if let Configuration::Text(text) = &known.configuration {
        fs::write(place.join(PASTED), text).map_err(Refusal::own)?;
    }
    Ok(())
}

/// Every file of a directory, in the order of their names, below a directory of the archive.
fn pack(place: &Path, name: &str) -> zip::result::ZipResult<Vec<u8>> {
    let mut files: Vec<_> = fs::read_dir(place)?.collect::<Result<_, _>>()?;
    files.sort_by_key(fs::DirEntry::file_name);
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for file in files {
        archive.start_file(format!("{name}/{}", file.file_name().to_string_lossy()), options)?;
        archive.write_all(&fs::read(file.path())?)?;
    }
    Ok(archive.finish()?.into_inner())
}
