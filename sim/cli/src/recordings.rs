//! Where `blysk simulate` records a run: two files anywhere, or a directory.

use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use hw_model::datapath::Datapath;
use vectors::rtl::save_file::EXTENSION;
use vectors::whole_file::Draft;
use vectors::{OutputFile, OutputSet, Staging};

use super::output;
use sim::waves::{WaveFormat, save_file};

/// The files of a directory.
const NAMES: [&str; 3] = ["trace.csv", "waves.vcd", "waves.gtkw"];

/// The files of a run, which have no names before it is over.
pub(super) enum Recordings {
    Files(Box<Files>),
    Directory(Box<Directory>),
}

/// Files at any places.
pub(super) struct Files {
    trace: Option<Draft>,
    waves: Option<(WaveFormat, Draft)>,
    /// What GTKWave shows of the waves, where these are a file.
    save: Option<Draft>,
    staging: Staging,
}

/// A directory with all of them.
pub(super) struct Directory {
    trace: OutputFile,
    waves: OutputFile,
    save: OutputFile,
    set: OutputSet,
}

impl Recordings {
    pub(super) fn of_files(trace: Option<&Path>, waves: Option<&Path>, inputs: &[PathBuf]) -> anyhow::Result<Self> {
        let mut staging = Staging::apart_from(inputs);
        let trace = trace.map(|path| staging.begin(path)).transpose()?;
        if waves.is_some_and(|path| staging.has(path)) {
            bail!("--trace and --waves name the same file; give each its own");
        }
        let format = waves.map(wave_format).transpose()?;
        let waves = waves.map(|path| staging.begin(path)).transpose()?;
        if let (Some(WaveFormat::Fst), Some(waves)) = (format, &waves)
            && !waves.is_file()
        {
            let path = waves.path().display();
            bail!("--waves {path}: FST is not written in order, which a pipe asks for; use .vcd");
        }
        let save = waves.as_ref().filter(|waves| waves.is_file());
        let save = save.map(|waves| waves.path().with_extension(EXTENSION));
        if save.as_ref().is_some_and(|save| staging.has(save)) {
            bail!("--trace names the save file that comes with --waves; give it another name");
        }
        let save = save.map(|path| staging.begin(&path)).transpose()?;
        Ok(Self::Files(Box::new(Files { trace, waves: format.zip(waves), save, staging })))
    }

    pub(super) fn in_directory(directory: &Path, inputs: &[PathBuf]) -> anyhow::Result<Self> {
        let mut set = output::set(directory, "simulate", inputs, NAMES)?;
        let [trace, waves, save] = NAMES;
        let [trace, waves, save] = [set.file(trace)?, set.file(waves)?, set.file(save)?];
        Ok(Self::Directory(Box::new(Directory { trace, waves, save, set })))
    }

    /// Writes the save file of the waves of this configuration.
    pub(super) fn save(&mut self, name: &str, datapath: &Datapath) -> anyhow::Result<()> {
        let (dump, mut target) = match self {
            Self::Files(files) => match (&files.waves, &mut files.save) {
                (Some((_, waves)), Some(save)) => (waves.path().to_owned(), Target::File(save)),
                _ => return Ok(()),
            },
            Self::Directory(files) => (files.waves.path().to_owned(), Target::OfSet(&mut files.save)),
        };
        Ok(target.write_all(save_file(name, datapath, &dump).as_bytes())?)
    }

    /// What to write the trace and the waves to.
    pub(super) fn targets(&mut self) -> (Option<Target<'_>>, Option<(WaveFormat, Target<'_>)>) {
        match self {
            Self::Files(files) => {
                let Files { trace, waves, .. } = &mut **files;
                let waves = waves.as_mut().map(|(format, file)| (*format, Target::File(file)));
                (trace.as_mut().map(Target::File), waves)
            }
            Self::Directory(directory) => {
                let Directory { trace, waves, .. } = &mut **directory;
                (Some(Target::OfSet(trace)), Some((WaveFormat::Vcd, Target::OfSet(waves))))
            }
        }
    }

    /// Gives the files their names. True where one went to standard output, which then has nothing else.
    pub(super) fn commit(self) -> anyhow::Result<bool> {
        match self {
            Self::Files(files) => {
                let Files { trace, waves, save, mut staging } = *files;
                let waves = waves.map(|(_, file)| file);
                let files: Vec<Draft> = trace.into_iter().chain(waves).chain(save).collect();
                let alone = files.iter().any(Draft::is_standard_output);
                for file in files {
                    staging.keep(file)?;
                }
                staging.commit()?;
                Ok(alone)
            }
            Self::Directory(directory) => {
                let Directory { trace, waves, save, mut set } = *directory;
                for file in [trace, waves, save] {
                    set.keep(file)?;
                }
                set.commit()?;
                Ok(false)
            }
        }
    }
}

/// The format that the end of a file's name asks for.
fn wave_format(path: &Path) -> anyhow::Result<WaveFormat> {
    let asked = path.extension().unwrap_or_default();
    let found = WaveFormat::ALL.into_iter().find(|format| asked == format.extension());
    let endings = WaveFormat::ALL.map(|format| format!(".{}", format.extension())).join(" or ");
    found.with_context(|| format!("--waves {}: give the file a name that ends in {endings}", path.display()))
}

/// A file whose errors say which file it is.
pub(super) enum Target<'a> {
    File(&'a mut Draft),
    OfSet(&'a mut OutputFile),
}

impl Target<'_> {
    fn named(&self, error: io::Error) -> io::Error {
        let kind = error.kind();
        let named = match self {
            Self::File(file) => file.error(error),
            Self::OfSet(file) => file.error(error),
        };
        io::Error::new(kind, named)
    }
}

impl Write for Target<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = match self {
            Self::File(file) => file.write(bytes),
            Self::OfSet(file) => file.write(bytes),
        };
        written.map_err(|error| self.named(error))
    }
    fn flush(&mut self) -> io::Result<()> {
        let flushed = match self {
            Self::File(file) => file.flush(),
            Self::OfSet(file) => file.flush(),
        };
        flushed.map_err(|error| self.named(error))
    }
}

/// For FST, which is never among the files of a directory: those are summed up as they are written.
impl Seek for Target<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let found = match self {
            Self::File(file) => file.seek(to),
            Self::OfSet(_) => Err(ErrorKind::NotSeekable.into()),
        };
        found.map_err(|error| self.named(error))
    }
}
