//! Files at any places that get their names together.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Component, Path, PathBuf};

use super::commit::Journal;
use super::error::OutputError;
use super::target::{Identity, Stream, Target, find, no_link, place, regular};
use super::temporary::{Temporary, committing, no_signal_meanwhile, parent};

/// Large enough that a write is rarely a system call.
const BUFFER_BYTES: usize = 1 << 16;

/// A file under way. What is written to it has no name until its staging is committed; what is no regular file is
/// written through.
#[derive(Debug)]
#[must_use = "a file that is not kept is thrown away"]
pub struct Draft {
    target: PathBuf,
    sink: Sink,
}

#[derive(Debug)]
enum Sink {
    Staged(BufWriter<File>, Place),
    Through(BufWriter<Stream>),
}

/// Where the contents are.
#[derive(Debug)]
enum Place {
    /// Beside the file that they will be.
    Beside { temporary: Temporary, real: PathBuf },
    /// In their place, in a directory that has no name yet.
    Inside,
}

impl Draft {
    /// The path the file will have.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.target
    }

    /// Whether this goes to standard output, where nothing else can go then.
    #[must_use]
    pub fn is_standard_output(&self) -> bool {
        matches!(&self.sink, Sink::Through(stream) if stream.get_ref().standard_output)
    }

    /// Whether this is a file and no stream, so that it can be written in any order.
    #[must_use]
    pub fn is_file(&self) -> bool {
        matches!(self.sink, Sink::Staged(..))
    }

    /// An error of writing this file, with its path.
    #[must_use]
    pub fn error(&self, cause: io::Error) -> OutputError {
        OutputError::Write { path: self.target.clone(), cause }
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.sink {
            Sink::Staged(writer, _) => writer.write(bytes),
            Sink::Through(stream) => stream.write(bytes),
        }
    }
    fn flush(&mut self) -> io::Result<()> {
        match &mut self.sink {
            Sink::Staged(writer, _) => writer.flush(),
            Sink::Through(stream) => stream.flush(),
        }
    }
}

/// For formats whose header is filled in last.
impl Seek for Draft {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match &mut self.sink {
            Sink::Staged(writer, _) => writer.seek(to),
            Sink::Through(_) => Err(ErrorKind::NotSeekable.into()),
        }
    }
}

#[derive(Debug)]
struct Finished {
    target: PathBuf,
    place: Place,
    seal: bool,
}

/// A directory that is built under a temporary name.
#[derive(Debug)]
struct NewDirectory {
    target: PathBuf,
    temporary: Temporary,
}

/// Files that get their names together. Dropped, it leaves nothing.
#[derive(Debug, Default)]
pub struct Staging {
    inputs: Vec<(PathBuf, Identity)>,
    directories: Vec<NewDirectory>,
    begun: Vec<PathBuf>,
    places: Vec<PathBuf>,
    finished: Vec<Finished>,
    obsolete: Vec<PathBuf>,
}

impl Staging {
    /// A staging that refuses to write over these files, which are read.
    #[must_use]
    pub fn apart_from(inputs: &[PathBuf]) -> Self {
        let found = inputs.iter().filter_map(|path| Some((path.clone(), Identity::of(path)?)));
        Self { inputs: found.collect(), ..Self::default() }
    }

    /// Begins what is at `path`, to be handed back to [`keep`](Self::keep).
    ///
    /// # Errors
    /// When nothing can be written there, or nothing may be.
    pub fn begin(&mut self, path: &Path) -> Result<Draft, OutputError> {
        match find(path)? {
            Target::File(real) => self.begin_at(path, real),
            Target::Stream(stream) => {
                let sink = Sink::Through(BufWriter::with_capacity(BUFFER_BYTES, stream));
                Ok(Draft { target: path.to_owned(), sink })
            }
        }
    }

    /// Whether a file was begun that this path leads to.
    #[must_use]
    pub fn has(&self, path: &Path) -> bool {
        regular(path).is_ok_and(|real| self.places.contains(&place(&real)))
    }

    /// As [`begin`](Self::begin), for a path that must be that of a regular file.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    pub fn begin_file(&mut self, path: &Path) -> Result<Draft, OutputError> {
        let real = regular(path)?;
        self.begin_at(path, real)
    }

    /// That a file can be at this path.
    ///
    /// # Errors
    /// When something that is no regular file is there, or an input.
    pub fn look(&self, path: &Path) -> Result<PathBuf, OutputError> {
        let real = regular(path)?;
        let Some(identity) = Identity::of(&real) else { return Ok(real) };
        match self.inputs.iter().find(|(_, input)| *input == identity) {
            Some((input, _)) => Err(OutputError::Input { path: path.to_owned(), input: input.clone() }),
            None => Ok(real),
        }
    }

    fn begin_at(&mut self, path: &Path, real: PathBuf) -> Result<Draft, OutputError> {
        self.look(path)?;
        let here = place(&real);
        if self.places.contains(&here) {
            return Err(OutputError::Twice(path.to_owned()));
        }
        // Text of the system about a temporary file would name it.
        let write = |cause: io::Error| OutputError::Write { path: path.to_owned(), cause: cause.kind().into() };
        let (file, place) = match self.directory(parent(&real))? {
            None => {
                let (temporary, file) = Temporary::file(parent(&real)).map_err(write)?;
                (file, Place::Beside { temporary, real })
            }
            Some(inside) => {
                let path = inside.join(real.file_name().unwrap_or_default());
                let file = no_signal_meanwhile(|| File::create_new(path));
                (file.map_err(write)?, Place::Inside)
            }
        };
        self.begun.push(path.to_owned());
        self.places.push(here);
        let writer = BufWriter::with_capacity(BUFFER_BYTES, file);
        Ok(Draft { target: path.to_owned(), sink: Sink::Staged(writer, place) })
    }

    /// Where files of a directory can be staged, if the directory does not exist.
    ///
    /// # Errors
    /// When there is no such directory, and it cannot be made.
    pub(super) fn directory(&mut self, path: &Path) -> Result<Option<PathBuf>, OutputError> {
        let refused = |kind: ErrorKind| OutputError::Directory { path: path.to_owned(), cause: kind.into() };
        if path.is_dir() {
            return Ok(None);
        }
        let above = path.ancestors().filter(|above| !above.as_os_str().is_empty());
        let Some(first) = above.take_while(|above| !above.exists()).last() else {
            return Err(refused(ErrorKind::NotADirectory));
        };
        no_link(first)?;
        let rest = path.strip_prefix(first).unwrap_or(Path::new(""));
        if rest.components().any(|part| part == Component::ParentDir) {
            return Err(refused(ErrorKind::NotFound));
        }
        let home = parent(first);
        if !home.is_dir() {
            return Err(refused(ErrorKind::NotADirectory));
        }
        let target = place(first);
        let known = self.directories.iter().position(|directory| directory.target == target);
        let index = match known {
            Some(index) => index,
            None => {
                let made = Temporary::directory(home);
                let temporary = made.map_err(|error| refused(error.kind()))?;
                self.directories.push(NewDirectory { target, temporary });
                self.directories.len() - 1
            }
        };
        let inside = self.directories[index].temporary.path().join(rest);
        no_signal_meanwhile(|| fs::create_dir_all(&inside)).map_err(|error| refused(error.kind()))?;
        Ok(Some(inside))
    }

    /// Sees to it that files can be made in a directory.
    pub(super) fn prepare(&mut self, path: &Path) -> Result<(), OutputError> {
        if self.directory(path)?.is_some() {
            return Ok(());
        }
        let refused = |cause: io::Error| OutputError::Directory { path: path.to_owned(), cause: cause.kind().into() };
        Temporary::file(path).map(drop).map_err(refused)
    }

    /// Takes a written file: everything is on the disc then, and a full disc shows here at the latest.
    ///
    /// # Errors
    /// When the last of it cannot be written.
    pub fn keep(&mut self, draft: Draft) -> Result<(), OutputError> {
        self.keep_as(draft, false)
    }

    /// The same. A seal vouches for the others: it loses its old name first and gets its new one last.
    pub(super) fn keep_as(&mut self, draft: Draft, seal: bool) -> Result<(), OutputError> {
        let Draft { target, sink } = draft;
        let written = match sink {
            Sink::Staged(writer, place) => {
                let file = writer.into_inner().map_err(io::IntoInnerError::into_error);
                file.and_then(|file| file.sync_all()).map(|()| Some(place))
            }
            Sink::Through(mut stream) => stream.flush().map(|()| None),
        };
        match written {
            Ok(Some(place)) => self.finished.push(Finished { target, place, seal }),
            Ok(None) => {}
            Err(cause) => return Err(OutputError::Write { path: target, cause }),
        }
        Ok(())
    }

    /// Says that a file, left by an earlier run, would no longer belong to the others: unless it is among them, it
    /// goes with the [`commit`](Self::commit).
    pub fn obsolete(&mut self, path: PathBuf) {
        self.obsolete.push(path);
    }

    /// Gives every kept file its name and returns their paths, in the order of keeping.
    ///
    /// # Errors
    /// When a file was begun and not kept, or a step fails. Everything is as it was then.
    pub fn commit(mut self) -> Result<Vec<PathBuf>, OutputError> {
        let kept = |path: &PathBuf| self.finished.iter().any(|file| file.target == *path);
        if let Some(path) = self.begun.iter().find(|path| !kept(path)) {
            return Err(OutputError::Unfinished(path.clone()));
        }
        let gone = |path: &&PathBuf| !kept(path) && path.is_file();
        let obsolete: Vec<PathBuf> = self.obsolete.iter().filter(gone).cloned().collect();
        let paths = self.finished.iter().map(|file| file.target.clone()).collect();
        let _signals_wait = committing();
        for file in &self.finished {
            if let Place::Beside { .. } = file.place {
                self.look(&file.target)?;
            }
        }
        let mut journal = Journal::default();
        match self.steps(&obsolete, &mut journal) {
            Ok(()) => Ok(paths),
            Err(cause) => Err(journal.undo(cause)),
        }
    }

    /// Seals go, files come, seals come: at no time does a seal stand beside what it does not vouch for.
    fn steps(&mut self, obsolete: &[PathBuf], journal: &mut Journal) -> Result<(), OutputError> {
        let write = |path: &Path| {
            let path = path.to_owned();
            move |cause| OutputError::Write { path, cause }
        };
        for file in self.finished.iter().rev().filter(|file| file.seal) {
            if let Place::Beside { real, .. } = &file.place
                && real.exists()
            {
                journal.remove(real).map_err(write(&file.target))?;
            }
        }
        for path in obsolete {
            journal.remove(path).map_err(write(path))?;
        }
        let (seals, files): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.finished).into_iter().partition(|file| file.seal);
        put(files, journal)?;
        for NewDirectory { target, temporary } in std::mem::take(&mut self.directories) {
            let put = journal.put_directory(temporary, &target);
            put.map_err(|cause| OutputError::Directory { path: target, cause })?;
        }
        put(seals, journal)
    }
}

fn put(files: Vec<Finished>, journal: &mut Journal) -> Result<(), OutputError> {
    for Finished { target, place, .. } in files {
        if let Place::Beside { temporary, real } = place {
            let put = journal.put(temporary, &real);
            put.map_err(|cause| OutputError::Write { path: target, cause })?;
        }
    }
    Ok(())
}
