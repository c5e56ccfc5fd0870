//! Manual pages and completions, made from the command itself: read by the tools that take them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use blysk_tests::bench;
use blysk_tests::cli::Bench;

/// What a tool says on standard error of a file; it must end with status 0.
fn said(program: &str, arguments: &[&str], file: &Path) -> String {
    let output = Command::new(program).args(arguments).arg(file).output();
    let output = output.unwrap_or_else(|error| panic!("{program}: {error}; run scripts/setup"));
    assert!(output.status.success(), "{program} {}: {output:?}", file.display());
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The names of the commands and their subcommands, such as `shard plan`, as their help lists them.
fn commands(bench: &Bench) -> BTreeSet<String> {
    let mut waiting = vec![String::new()];
    let mut found = BTreeSet::new();
    while let Some(command) = waiting.pop() {
        let help = bench.good(format!("{command} --help").trim());
        // The lists of subcommands end where the options begin; "Commands:" or a group stands above each.
        let (_, lists) = help.split_once("\nUsage: ").expect("a usage");
        let lists = lists.split("\nOptions:").next().unwrap().split("\nArguments:").next().unwrap();
        let names = lists.lines().skip(1).filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
        for name in names.filter(|name| !name.is_empty() && *name != "help") {
            let below = format!("{command} {name}").trim().to_owned();
            waiting.push(below.clone());
            found.insert(below);
        }
    }
    assert!(found.len() > 25 && found.contains("shard plan") && found.contains("presets show"), "{found:?}");
    found
}

#[test]
fn every_command_has_a_page_without_a_warning() {
    let bench = bench!();
    let _said = bench.good("man --out man");
    let pages: BTreeSet<String> = bench
        .tree("man")
        .into_keys()
        .map(|name| name.display().to_string())
        .filter(|name| name.ends_with(".1"))
        .collect();
    let mut expected: BTreeSet<String> =
        commands(&bench).iter().map(|name| format!("blysk-{}.1", name.replace(' ', "-"))).collect();
    expected.insert("blysk.1".to_owned());
    assert_eq!(pages, expected);
    for page in &pages {
        let path = bench.path(&format!("man/{page}"));
        assert_eq!(said("groff", &["-man", "-ww", "-z", "-Kutf8", "-Tutf8"], &path), "", "{page}");
    }
    let report = bench.text("man/blysk-report.1");
    assert!(report.contains("blysk\\-report") && report.contains("\\-\\-all\\-presets"), "{report}");
    // A page that is wrong is seen.
    bench.write("wrong.1", format!("{report}\n.nosuchrequest\n"));
    assert_ne!(said("groff", &["-man", "-ww", "-z", "-Kutf8", "-Tutf8"], &bench.path("wrong.1")), "");
    assert!(bench.good("man --out again").contains("begin with blysk.1"));
    for page in &pages {
        assert!(bench.read(&format!("man/{page}")) == bench.read(&format!("again/{page}")), "{page}");
    }
}

#[test]
fn shells_take_their_completions() {
    let bench = bench!();
    for (shell, check) in [("bash", "-n"), ("zsh", "-n"), ("fish", "--no-execute")] {
        let text = bench.good(&format!("completions {shell}"));
        let file = format!("blysk.{shell}");
        bench.write(&file, &text);
        assert_eq!(said(shell, &[check], &bench.path(&file)), "", "{shell}");
        for word in ["coefficients", "completions", "specialise", "all-presets", "glsl"] {
            assert!(text.contains(word), "{shell}: {word}");
        }
    }
    // What bash offers, as it asks for it.
    let ask = "source blysk.bash; COMP_WORDS=(blysk pareto --no); COMP_CWORD=2; _blysk blysk --no pareto; \
               echo ${COMPREPLY[*]}";
    let asked = Command::new("bash").args(["-c", ask]).current_dir(bench.path("")).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&asked.stdout), "--no-timing\n", "{asked:?}");
    bench.refused("completions tcsh", &["tcsh", "bash", "fish"]);
}

/// What `make install` does with them.
#[test]
fn pages_and_completions_go_where_they_are_looked_for() {
    let bench = bench!();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scripts/command-pages");
    let blysk = bench.command(&[]).get_program().to_owned();
    let laid = Command::new(script).arg(blysk).arg(bench.path("usr")).output().unwrap();
    assert!(laid.status.success(), "{laid:?}");
    for file in [
        "share/man/man1/blysk.1",
        "share/man/man1/blysk-shard-plan.1",
        "share/bash-completion/completions/blysk",
        "share/fish/vendor_completions.d/blysk.fish",
        "share/zsh/site-functions/_blysk",
    ] {
        assert!(!fs::read(bench.path(&format!("usr/{file}"))).expect(file).is_empty(), "{file}");
    }
    let laid: Vec<_> = bench.tree("usr/share/man").into_keys().collect();
    assert!(laid.iter().all(|path| path.is_dir() || path.extension().is_none_or(|end| end == "1")), "{laid:?}");
}

/// No line of any help is wider than a terminal of 100 columns; nor is one of `make help`.
#[test]
fn help_fits_a_terminal() {
    let bench = bench!();
    let narrow = |what: &str, text: &str| {
        for line in text.lines() {
            assert!(line.chars().count() <= 100, "{what}: {} columns: {line}", line.chars().count());
        }
    };
    let mut looked_at = 0;
    for command in commands(&bench).iter().map(String::as_str).chain([""]) {
        for option in ["--help", "-h"] {
            let line = format!("{command} {option}");
            narrow(&line, &bench.good(line.trim()));
            looked_at += 1;
        }
    }
    assert!(looked_at > 50, "{looked_at}");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let made = Command::new("make").args(["--no-print-directory", "help"]).current_dir(root).output().unwrap();
    let text = String::from_utf8_lossy(&made.stdout);
    assert!(text.lines().count() > 20, "{made:?}");
    narrow("make help", &text);
}

/// A wide error is folded, in a pipe as on a terminal, and its words stay whole.
#[test]
fn errors_fit_a_terminal() {
    let bench = bench!();
    let long = "a".repeat(60);
    for command in [
        format!("report --config {long}/{long}.json"),
        "coefficients --method hermit --exponents 8".to_owned(),
        "evaluate".to_owned(),
        "certify --preset paper --exponents 8 --all-real-n --check x".to_owned(),
    ] {
        let output = bench.command(&command.split(' ').collect::<Vec<_>>()).output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{text}");
        for line in text.lines() {
            let alone = !line.trim().contains(' ');
            assert!(line.chars().count() <= 100 || alone, "{command}: {line}");
        }
    }
}
