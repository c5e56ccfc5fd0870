//! ROM images that are not what the pipeline needs: every simulation must end, and say which file is wrong.

use std::fs;
use std::path::Path;

use super::simulators::Simulator;
use super::workspace::{Emitted, copy};
use super::{Failure, failed};

/// A ROM image that is no image of this ROM.
#[derive(Debug, Clone)]
pub struct Wrong {
    /// In which way it is wrong.
    pub name: &'static str,
    /// Its contents; none where there is no file.
    pub contents: Option<String>,
    /// What the pipeline says of it.
    pub said: String,
}

/// Every kind of wrong image, made from a right one.
#[must_use]
pub fn wrong_images(right: &str) -> Vec<Wrong> {
    let lines: Vec<&str> = right.lines().collect();
    let head = lines.iter().take_while(|line| line.starts_with("//")).count();
    let words = lines.len() - head;
    let with = |line: usize, change: &dyn Fn(&str) -> String| {
        let changed = |(at, text): (usize, &&str)| {
            if at == line { change(text) } else { (*text).to_owned() }
        };
        let all: Vec<String> = lines.iter().enumerate().map(changed).collect();
        Some(all.join("\n") + "\n")
    };
    let count = |found: usize| format!("rom.mem: the ROM image has {found} words and must have {words}");
    let at = |line: usize| format!("rom.mem, line {}: no words of ", line + 1);
    let last = lines.len() - 1;
    let wrong = |name, contents, said| Wrong { name, contents, said };
    vec![
        wrong("missing", None, "rom.mem: the ROM image is not there".to_owned()),
        wrong("empty", Some(String::new()), count(0)),
        wrong("comments alone", Some(lines[..head].join("\n")), count(0)),
        wrong("short", Some(lines[..last].join("\n")), count(words - 1)),
        wrong("too long", Some(format!("{right}{}\n", lines[last])), count(words + 1)),
        wrong("a digit too many", with(head, &|word| format!("0{word}")), at(head)),
        wrong("an unknown digit", with(last, &|word| format!("{}x", &word[1..])), at(last)),
        wrong("an undriven digit", with(head, &|word| format!("Z{}", &word[1..])), at(head)),
        wrong("words", with(head, &|_| "no word".to_owned()), at(head)),
        wrong("half a comment", with(last, &|word| format!("{word} / n")), at(last)),
        wrong("bytes", Some("\u{1}\u{2}\u{feff}".to_owned()), at(0)),
    ]
}

/// Runs the built testbench with every wrong image.
///
/// # Errors
/// When one runs on, or what is said does not name the file.
pub fn check(emitted: &Emitted<'_>, simulator: &Simulator) -> Result<usize, Failure> {
    let place = copy(&emitted.directory, "rom-image")?;
    let image = place.join("rom.mem");
    let io = |error: std::io::Error| Failure(format!("{}: {error}", image.display()));
    let images = wrong_images(&fs::read_to_string(&image).map_err(io)?);
    for wrong in &images {
        put(&image, wrong).map_err(io)?;
        let mut testbench = simulator.testbench(&emitted.directory);
        let output = testbench.current_dir(&place).output().map_err(io)?;
        let text = [output.stdout, output.stderr].concat();
        let text = String::from_utf8_lossy(&text);
        // Verilator refuses some of them itself, in its own words.
        let named = if simulator.is_icarus() { wrong.said.as_str() } else { "rom.mem" };
        if output.status.success() || text.contains("PASS") || !text.contains(named) {
            return failed(format!("{}, ROM image: {}: {text}", simulator.name, wrong.name));
        }
    }
    Ok(images.len())
}

/// Puts a wrong image in the place of the right one.
///
/// # Errors
/// When it cannot be written.
pub fn put(image: &Path, wrong: &Wrong) -> std::io::Result<()> {
    match &wrong.contents {
        Some(contents) => fs::write(image, contents),
        None => fs::remove_file(image),
    }
}
