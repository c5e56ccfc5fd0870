//! Running the command from outside, in a directory of its own.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// The first argument of [`Bench::new`] names the binary; only an integration test can know it.
///
/// ```text
/// let bench = blysk_tests::bench!();
/// ```
#[macro_export]
macro_rules! bench {
    () => {
        $crate::cli::Bench::new(env!("CARGO_BIN_EXE_blysk-under-test"))
    };
}

/// hermite with a divider, in power form: every kind of rank, and every x quickly seen.
pub const SMALL: &str = r#"{
  "name": "small",
  "description": "hermite in power form with a rational tail, few bits",
  "method": "hermite",
  "exponents": "1..=8",
  "input": "Q2.9",
  "output": "UQ1.8",
  "form": "power",
  "tail": "rational",
  "quotient_bits_per_stage": 3
}
"#;

/// three_point in the centred form down to its minimum, with exponents that are no integers.
pub const CENTRED: &str = r#"{
  "name": "centred",
  "method": "three_point",
  "exponents": "1,2.5,3,9.75,31",
  "input": "UQ1.10",
  "output": "UQ1.9",
  "cut": "minimum"
}
"#;

/// The divider alone, on an x that does not reach 1.
pub const DIVIDER: &str = r#"{
  "name": "divider",
  "method": "schlick",
  "exponents": "1,2,7,12",
  "input": "UQ0.9",
  "output": "UQ0.8",
  "tail": "rational",
  "rounding": "floor",
  "error_budget_ulp": 2.0
}
"#;

/// The small configurations, each with its file name.
pub const CONFIGURATIONS: [(&str, &str); 3] =
    [("small.json", SMALL), ("centred.json", CENTRED), ("divider.json", DIVIDER)];

/// Files and directories below a directory, with the contents of the files.
pub type Tree = BTreeMap<PathBuf, Option<Vec<u8>>>;

/// What a run of the command left.
#[derive(Debug)]
pub struct Run {
    /// The command line, for messages.
    pub command: String,
    /// The exit status of the command.
    pub status: i32,
    /// What the command wrote to standard output.
    pub stdout: String,
    /// What the command wrote to standard error; lines that it folded are whole.
    pub stderr: String,
}

/// An empty directory and the command.
#[derive(Debug)]
pub struct Bench {
    binary: PathBuf,
    directory: TempDir,
}

impl Bench {
    /// A new directory for the binary at this path, with the small configurations in it.
    ///
    /// # Panics
    /// When there can be no temporary directory.
    #[must_use]
    pub fn new(binary: &str) -> Self {
        let directory = TempDir::new().expect("a temporary directory");
        let bench = Self { binary: binary.into(), directory };
        for (name, json) in CONFIGURATIONS {
            bench.write(name, json);
        }
        bench
    }

    /// A path in the directory.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    /// Writes a file into the directory.
    ///
    /// # Panics
    /// When it cannot.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        fs::write(self.path(name), contents).expect("the directory is ours");
    }

    /// The contents of a file.
    ///
    /// # Panics
    /// When it cannot be read.
    #[must_use]
    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The contents of a text file.
    ///
    /// # Panics
    /// When it cannot be read.
    #[must_use]
    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Every file and directory below `name`, with the contents of the files; hidden ones too.
    #[must_use]
    pub fn tree(&self, name: &str) -> Tree {
        tree(&self.path(name))
    }

    /// The command with these arguments, to be run in the directory.
    #[must_use]
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.binary);
        command.args(arguments).current_dir(self.directory.path()).stdin(Stdio::null());
        command
    }

    /// Runs the command with arguments that have no spaces.
    ///
    /// # Panics
    /// When it cannot be run, is killed, prints something that is not text, or panics.
    #[must_use]
    pub fn run(&self, arguments: &str) -> Run {
        self.run_list(&arguments.split_whitespace().collect::<Vec<_>>())
    }

    /// Runs the command.
    ///
    /// # Panics
    /// As [`run`](Self::run).
    #[must_use]
    pub fn run_list(&self, arguments: &[&str]) -> Run {
        let output = self.command(arguments).output().expect("the command is built");
        let text = |bytes| String::from_utf8(bytes).expect("the command prints UTF-8");
        let run = Run {
            command: format!("blysk {}", arguments.join(" ")),
            status: output.status.code().expect("the command is not killed"),
            stdout: text(output.stdout),
            stderr: unfolded(&text(output.stderr)),
        };
        assert!(run.status <= 2 && !run.stderr.contains("panicked"), "{run:#?}");
        run
    }

    /// Runs a command that must do its work, and returns what it printed.
    ///
    /// # Panics
    /// When the status is not 0, or something is on standard error.
    #[must_use]
    pub fn good(&self, arguments: &str) -> String {
        let run = self.run(arguments);
        assert!(run.status == 0 && run.stderr.is_empty(), "{run:#?}");
        run.stdout
    }

    /// Runs a command that must be refused, with every one of `said` on standard error: nothing on
    /// standard output, and the directory as it was.
    ///
    /// # Panics
    /// When it is not so.
    pub fn refused(&self, arguments: &str, said: &[&str]) {
        self.refused_list(&arguments.split_whitespace().collect::<Vec<_>>(), said);
    }

    /// The same for arguments with spaces in them.
    ///
    /// # Panics
    /// As [`refused`](Self::refused).
    pub fn refused_list(&self, arguments: &[&str], said: &[&str]) {
        assert!(!said.is_empty(), "say what the message must have");
        let before = self.tree("");
        let run = self.run_list(arguments);
        assert_eq!(run.status, 2, "{run:#?}");
        assert!(run.stdout.is_empty(), "a result beside an error: {run:#?}");
        for said in said {
            assert!(run.stderr.contains(said), "{said:?} is not said: {run:#?}");
        }
        let pieces: Vec<&str> = run.stderr.split(": ").filter(|piece| piece.len() > 12).collect();
        for (index, piece) in pieces.iter().enumerate() {
            let again = pieces[..index].iter().any(|said| said.trim() == piece.trim());
            assert!(!again, "{piece:?} is said twice: {run:#?}");
        }
        let after = self.tree("");
        assert!(before == after, "{run:#?}\nbefore {:?}\nafter {:?}", names(&before), names(&after));
    }
}

/// Errors as they were before they were folded.
///
/// # Panics
/// When a line is wider than a terminal, and not a single long word.
fn unfolded(stderr: &str) -> String {
    for line in stderr.lines() {
        assert!(line.chars().count() <= 100 || !line.trim().contains(' '), "more than 100 columns: {line}");
    }
    stderr.replace("\n    ", " ")
}

fn names(tree: &Tree) -> Vec<&PathBuf> {
    tree.keys().collect()
}

/// Every file and directory below `root`, with the contents of the files.
///
/// # Panics
/// When something cannot be read.
#[must_use]
pub fn tree(root: &Path) -> Tree {
    let mut found = BTreeMap::new();
    let mut waiting = vec![root.to_owned()];
    while let Some(directory) = waiting.pop() {
        for entry in fs::read_dir(&directory).expect("a directory") {
            let path = entry.expect("an entry").path();
            let name = path.strip_prefix(root).expect("it is below").to_owned();
            // A link is what it says, and not what it leads to, which may be an endless device.
            if let Ok(target) = fs::read_link(&path) {
                found.insert(name, Some(target.display().to_string().into_bytes()));
            } else if path.is_dir() {
                waiting.push(path);
                found.insert(name, None);
            } else {
                found.insert(name, Some(fs::read(&path).expect("a file")));
            }
        }
    }
    found
}

/// A printed table read back: each line by the names of its columns.
///
/// # Panics
/// When the text is not CSV with lines of equal length.
#[must_use]
pub fn csv_rows(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().expect("a header").clone();
    let named = |record: csv::StringRecord| {
        header.iter().zip(&record).map(|(name, cell)| (name.to_owned(), cell.to_owned())).collect()
    };
    reader.records().map(|record| named(record.expect("a line"))).collect()
}

/// The number in a column.
///
/// # Panics
/// When there is no such column, or no number in it.
#[must_use]
pub fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    let cell = row.get(column).unwrap_or_else(|| panic!("there is no column {column}"));
    cell.parse().unwrap_or_else(|_| panic!("{column}: {cell:?} is not a number"))
}
