//! The library as C sees it: `tests/c/checks.c` and the examples, compiled by the system's compilers, and run plainly,
//! under valgrind, and with the address and undefined-behaviour sanitizers.

use std::path::{Path, PathBuf};
use std::process::Command;

mod support;

use support::{SYSTEM, libraries, package, passes, shared_directory, static_library};

const C: [&str; 6] = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-pedantic", "-g"];
const CPP: [&str; 5] = ["-std=c++17", "-Wall", "-Wextra", "-Werror", "-g"];
const SANITIZE: [&str; 2] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

enum Link {
    Static,
    Shared,
}

/// Compiles a source of the package to a program, named after the flags too: tests run side by side, and one must not
/// write a program that another one runs.
fn compile(source: &str, link: &Link, flags: &[&str]) -> PathBuf {
    let cpp = source.ends_with(".cpp");
    let stem = source.replace(['/', '.'], "_");
    let kind = match link {
        Link::Static => "static",
        Link::Shared => "shared",
    };
    let flagged: String = flags.iter().flat_map(|flag| flag.chars()).filter(char::is_ascii_alphanumeric).collect();
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{stem}_{kind}_{flagged}"));
    let mut compiler = Command::new(if cpp { "c++" } else { "cc" });
    compiler.args(if cpp { &CPP[..] } else { &C[..] }).arg("-I").arg(package().join("include"));
    compiler.arg(package().join(source)).arg("-o").arg(&program);
    match link {
        Link::Static => compiler.arg(static_library()).args(SYSTEM),
        Link::Shared => compiler.arg("-L").arg(libraries()).args(["-lblysk", "-lm", "-lpthread"]),
    };
    passes(compiler.args(flags));
    program
}

fn checks_pass(said: &str) {
    let counts = said.lines().last().expect("a line of counts");
    let (checks, failures) = counts.split_once(" checks, ").expect("a line of counts");
    assert!(checks.parse::<u32>().is_ok_and(|checks| checks > 1000) && failures == "0 failures", "{said}");
}

/// No error and no leak: what valgrind calls reachable is what the standard library keeps to the end.
fn valgrind(program: &Path) -> String {
    let flags =
        ["--quiet", "--error-exitcode=9", "--leak-check=full", "--errors-for-leak-kinds=definite,indirect,possible"];
    passes(Command::new("valgrind").args(flags).arg(program))
}

#[test]
fn checks_pass_with_either_library() {
    checks_pass(&passes(&mut Command::new(compile("tests/c/checks.c", &Link::Static, &[]))));
    let shared = compile("tests/c/checks.c", &Link::Shared, &[]);
    checks_pass(&passes(Command::new(shared).env("LD_LIBRARY_PATH", shared_directory())));
}

#[test]
fn checks_pass_under_valgrind() {
    checks_pass(&valgrind(&compile("tests/c/checks.c", &Link::Static, &["-DVALGRIND"])));
}

#[test]
fn checks_pass_with_sanitizers() {
    let program = compile("tests/c/checks.c", &Link::Static, &SANITIZE);
    checks_pass(&passes(&mut Command::new(program)));
}

#[test]
fn threads_share_a_model() {
    let said = passes(&mut Command::new(compile("examples/threads.c", &Link::Static, &SANITIZE)));
    assert!(said.starts_with("the same: "), "{said}");
    let said = valgrind(&compile("examples/threads.c", &Link::Static, &[]));
    assert!(said.starts_with("the same: "), "{said}");
}

#[test]
fn the_examples_run() {
    let said = passes(&mut Command::new(compile("examples/highlight.c", &Link::Static, &[])));
    assert!(said.contains("0.99^64 is about 0.52"), "{said}");
    let said = passes(&mut Command::new(compile("examples/highlight.cpp", &Link::Static, &[])));
    assert!(said.contains("refused: there is no preset \"none\""), "{said}");
}

#[test]
fn the_systemc_module_does_what_the_model_does() {
    let said = passes(&mut Command::new(compile("examples/systemc.cpp", &Link::Static, &["-lsystemc"])));
    assert!(said.lines().any(|line| line == "PASS 4096 results"), "{said}");
    let stalls = said.lines().find(|line| line.contains(" stalls, ")).expect("a line of counts");
    assert!(!stalls.contains(" 0 stalls") && !stalls.contains(" 0 bubbles"), "{stalls}");
}

/// What `make c` and `make install` lay out is found by pkg-config, in its place and under another prefix.
#[test]
fn an_installed_library_is_found_by_pkg_config() {
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("installed");
    let _ = std::fs::remove_dir_all(&place);
    let built = place.join("built");
    std::fs::create_dir_all(&built).expect("a directory");
    std::fs::copy(static_library(), built.join("libblysk.a")).expect("the library is copied");
    std::fs::copy(libraries().join("libblysk.so"), built.join("libblysk.so")).expect("the library is copied");
    let script = package().join("../../../scripts/c-library");
    passes(Command::new(&script).arg(&built).arg(&place));
    let pkg_config = |flags: &[&str]| {
        let mut command = Command::new("pkg-config");
        passes(command.args(flags).arg("blysk").env("PKG_CONFIG_PATH", place.join("lib/pkgconfig")))
    };
    let flags = pkg_config(&["--cflags", "--libs"]);
    let program = place.join("highlight");
    let mut compiler = Command::new("cc");
    compiler.args(C).arg(place.join("share/blysk/examples/highlight.c")).args(flags.split_whitespace());
    passes(compiler.arg("-o").arg(&program));
    let said = passes(Command::new(&program).env("LD_LIBRARY_PATH", place.join("lib")));
    assert!(said.contains("0.99^64 is about 0.52"), "{said}");
    let static_flags = pkg_config(&["--static", "--libs"]);
    assert!(SYSTEM.iter().all(|library| static_flags.contains(library)), "{static_flags}");

    let packaged = place.join("package");
    passes(Command::new(&script).arg(&built).arg(&packaged).arg("/opt/blysk"));
    let file = std::fs::read_to_string(packaged.join("lib/pkgconfig/blysk.pc")).expect("the pkg-config file");
    assert!(file.starts_with("prefix=/opt/blysk\n") && !file.contains('@'), "{file}");
    assert!(packaged.join("share/blysk/dpi/blysk_dpi_pkg.sv").is_file());
}

/// Every function of the header and no other name; the loader's name has the version of the ABI.
#[test]
fn the_shared_library_exports_the_header() {
    let library = libraries().join("libblysk.so");
    let symbols = passes(Command::new("nm").args(["--dynamic", "--defined-only", "--format=posix"]).arg(&library));
    // Type T: the C library's own variable `signgam` is there too, as everywhere where its `lgamma` is.
    let functions = symbols.lines().filter_map(|line| line.split_once(" T "));
    let mut exported: Vec<&str> = functions.map(|(name, _)| name).collect();
    exported.sort_unstable();
    let header = std::fs::read_to_string(package().join("include/blysk.h")).expect("the header");
    let is_comment = |line: &str| ["//", "/*", "*"].iter().any(|mark| line.trim_start().starts_with(mark));
    let code: String = header.lines().filter(|line| !is_comment(line)).collect();
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let calls = code.match_indices('(').filter_map(|(at, _)| code[..at].rsplit(|c| !is_name(c)).next());
    let mut declared: Vec<&str> = calls.filter(|name| name.starts_with("blysk_")).collect();
    declared.sort_unstable();
    assert_eq!(exported, declared);
    assert!(exported.len() > 20, "{exported:?}");
    let dynamic = passes(Command::new("readelf").arg("--dynamic").arg(&library));
    assert!(dynamic.contains(&format!("soname: [libblysk.so.{}]", blysk::ABI_VERSION)), "{dynamic}");
}
