//! Save files of GTKWave read, as far as ours go.

use std::collections::BTreeSet;

use crate::waves::Waves;

/// A save file of GTKWave, read back.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaveFile {
    /// The dump that it is for.
    pub dump: Option<String>,
    /// The groups, each with its signals: full names, without their ranges, and their bits.
    pub groups: Vec<(String, Vec<(String, u32)>)>,
}

impl SaveFile {
    /// Reads a save file.
    ///
    /// # Panics
    /// When a line is none of those that we write, or a group is not closed.
    #[must_use]
    pub fn read(text: &str) -> Self {
        let mut file = Self { dump: None, groups: Vec::new() };
        let (mut flags, mut open) = (None, false);
        for line in text.lines() {
            if let Some(name) = line.strip_prefix("[dumpfile] ") {
                file.dump = Some(name.trim_matches('"').to_owned());
            } else if let Some(digits) = line.strip_prefix('@') {
                flags = Some(u32::from_str_radix(digits, 16).expect("flags in hex"));
            } else if let Some(name) = line.strip_prefix('-') {
                match flags.expect("flags before a group") {
                    0x80_0200 if !open => file.groups.push((name.to_owned(), Vec::new())),
                    0x100_0200 if open => {
                        let (begun, signals) = file.groups.last().expect("a group");
                        assert!(begun == name && !signals.is_empty(), "{line}");
                    }
                    other => panic!("{line} with the flags {other:x}"),
                }
                open = !open;
            } else if !line.starts_with(['[', '*']) {
                let flags = flags.expect("flags before a signal");
                assert!(open && flags & 0x20 != 0, "{line}: {flags:x}");
                file.groups.last_mut().expect("a group").1.push(signal(line));
            }
        }
        assert!(!open, "a group has no end");
        file
    }

    /// Every signal stands in the waves, with its bits, and in one group only.
    ///
    /// # Panics
    /// When one does not.
    pub fn check(&self, waves: &Waves) {
        let mut seen = BTreeSet::new();
        for (name, width) in self.groups.iter().flat_map(|(_, signals)| signals) {
            assert_eq!(waves.get(name).width, *width, "{name}");
            assert!(seen.insert(name), "{name} is there twice");
        }
        assert!(seen.len() > 10, "{} signals", seen.len());
    }
}

/// `+{label} name[high:0]`, the label and the range where there are any.
fn signal(line: &str) -> (String, u32) {
    let name = line.rsplit(' ').next().expect("a name");
    match name.rsplit_once('[') {
        Some((name, range)) if range.contains(':') => {
            let high = range.strip_suffix(":0]").expect("a range down to 0");
            (name.to_owned(), high.parse::<u32>().expect("a number") + 1)
        }
        _ => (name.to_owned(), 1),
    }
}
