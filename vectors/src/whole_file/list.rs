//! The list of a set: the SHA-256 of each of its files, as `sha256sum` writes it.

use std::fs::{self, File};
use std::io;
use std::path::{Component, Path, PathBuf};

use thiserror::Error;

use crate::checksum::checksum;

/// Why the files of a set are refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ListError {
    /// There is no list, so that nothing says which files belong together.
    #[error("the set is incomplete: cannot read {}: {cause}; write the set again", path.display())]
    NoList {
        /// The path of the list.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// A line of the list is none.
    #[error(
        "{}, line {line}: not 64 hex digits, two spaces and the path of a file below the directory",
        path.display()
    )]
    Line {
        /// The path of the list.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
    },
    /// A file of the set is missing or cannot be read.
    #[error("the set is incomplete: cannot read {}: {cause}; write the set again", path.display())]
    Missing {
        /// The path of the file that is missing.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// A file is not the one that was written with the others.
    #[error(
        "the set is mixed: {} is not the file that was written with the others: its SHA-256 is {found}, {} says \
         {expected}; write the set again", path.display(), list.display()
    )]
    Differs {
        /// The path of the file.
        path: PathBuf,
        /// The path of the list.
        list: PathBuf,
        /// The SHA-256 of the file as it is.
        found: String,
        /// The SHA-256 that the list has.
        expected: String,
    },
}

/// The name of the list of a command's files.
#[must_use]
pub fn list_name(command: &str) -> String {
    format!("{command}.sha256")
}

/// A line, with the marks by which `sha256sum` writes names that have a line's end in them.
pub(super) fn line(name: &str, sha256: &str) -> String {
    let plain = name.replace('\\', r"\\").replace('\n', r"\n").replace('\r', r"\r");
    let mark = if plain == name { "" } else { "\\" };
    format!("{mark}{sha256}  {plain}\n")
}

/// Checksum and name of a line.
fn read(line: &str) -> Option<(&str, String)> {
    let (marked, line) = line.strip_prefix('\\').map_or((false, line), |line| (true, line));
    let (sha256, name) = line.split_once("  ")?;
    let name = if marked { unmarked(name)? } else { name.to_owned() };
    let hex = sha256.len() == 64 && sha256.bytes().all(|byte| byte.is_ascii_hexdigit());
    let mut parts = Path::new(&name).components();
    let below = !name.is_empty() && parts.all(|part| matches!(part, Component::Normal(_)));
    (hex && below).then_some((sha256, name))
}

fn unmarked(name: &str) -> Option<String> {
    let mut plain = String::new();
    let mut characters = name.chars();
    while let Some(character) = characters.next() {
        plain.push(match character {
            '\\' => match characters.next()? {
                '\\' => '\\',
                'n' => '\n',
                'r' => '\r',
                _ => return None,
            },
            other => other,
        });
    }
    Some(plain)
}

/// Checks that the files of a command in `directory` are those that were written together, and returns their paths
/// from there.
///
/// # Errors
/// Says that the set is incomplete or mixed, and which file shows it.
pub fn check_list(directory: &Path, command: &str) -> Result<Vec<String>, ListError> {
    let list = directory.join(list_name(command));
    let text = match fs::read_to_string(&list) {
        Ok(text) => text,
        Err(cause) => return Err(ListError::NoList { path: list, cause }),
    };
    let mut names = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let Some((expected, name)) = read(line) else {
            return Err(ListError::Line { path: list, line: index + 1 });
        };
        let path = directory.join(&name);
        match File::open(&path).and_then(checksum) {
            Err(cause) => return Err(ListError::Missing { path, cause }),
            Ok(found) if found.sha256 != expected => {
                let (found, expected) = (found.sha256, expected.to_owned());
                return Err(ListError::Differs { path, list, found, expected });
            }
            Ok(_) => names.push(name),
        }
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_back_as_they_were() {
        let sha256 = "0123456789abcdef".repeat(4);
        for name in ["rom.mem", "rtl/blysk.sv", "two words", "a\\b\nc\rd", "\\"] {
            let written = line(name, &sha256);
            let text = written.strip_suffix('\n').unwrap();
            assert_eq!(read(text), Some((sha256.as_str(), name.to_owned())), "{text}");
        }
    }

    #[test]
    fn what_is_no_line_is_refused() {
        let sha256 = "0".repeat(64);
        for text in ["", "0  a", &sha256, &format!("{sha256} a"), &format!("{sha256}  /etc/passwd")] {
            assert_eq!(read(text), None, "{text}");
        }
        assert_eq!(read(&format!("{sha256}  ../a")), None);
        assert_eq!(read(&format!("\\{sha256}  a\\t")), None);
    }
}
