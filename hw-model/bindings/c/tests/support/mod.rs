//! The library beside the test, and programs that are run.
#![allow(dead_code, reason = "each test uses a part of it")]

pub mod rtl;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

// The library is built with the tests, and lies beside them.
use blysk as _;

/// What the static library needs of the system, as in `blysk.pc.in`.
pub const SYSTEM: [&str; 4] = ["-lpthread", "-ldl", "-lm", "-lgcc_s"];

/// The directory of `libblysk.a` and `libblysk.so`.
pub fn libraries() -> PathBuf {
    let test = std::env::current_exe().expect("the path of this test");
    test.parent().expect("a directory").to_owned()
}

pub fn package() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The end of the name of a library in `libraries()`: cargo adds a digest to that of the static one.
pub fn static_library() -> PathBuf {
    let entries = std::fs::read_dir(libraries()).expect("the directory is read").flatten();
    let is_library = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with("libblysk") && name.ends_with(".a")
    };
    let found = entries.map(|entry| entry.path()).filter(is_library);
    let time = |path: &PathBuf| path.metadata().and_then(|data| data.modified()).expect("a time");
    found.max_by_key(time).expect("libblysk.a is built with this test")
}

pub fn run(command: &mut Command) -> Output {
    command.output().unwrap_or_else(|error| panic!("{command:?}: {error}; run scripts/setup"))
}

/// The standard output of a command that ends with status 0.
pub fn passes(command: &mut Command) -> String {
    let output = run(command);
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{command:?}\n{out}{err}");
    out.into_owned()
}

/// Standard output and error of a command that does not end with status 0.
pub fn fails(command: &mut Command) -> String {
    let output = run(command);
    let said = [output.stdout, output.stderr].concat();
    let said = String::from_utf8_lossy(&said).into_owned();
    assert!(!output.status.success(), "{command:?} did not fail\n{said}");
    said
}

/// The shared library under the name that the loader looks for. It is copied once: other tests may be running with it.
pub fn shared_directory() -> &'static Path {
    static DIRECTORY: OnceLock<PathBuf> = OnceLock::new();
    DIRECTORY.get_or_init(|| {
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("shared");
        std::fs::create_dir_all(&directory).expect("a directory");
        let name = directory.join(format!("libblysk.so.{}", blysk::ABI_VERSION));
        std::fs::copy(libraries().join("libblysk.so"), name).expect("the library is copied");
        directory
    })
}
