//! The hardware designers' reference in `docs/hardware/` is what its command makes, and its links lead
//! somewhere.

use std::fs;
use std::path::{Path, PathBuf};

use blysk_tests::bench;
use blysk_tests::cli::{Tree, tree};

const AGAIN: &str = "`make docs` writes docs/hardware/ again; read the difference before you keep it";

fn kept() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/hardware")
}

fn names(tree: &Tree) -> Vec<&PathBuf> {
    tree.keys().collect()
}

/// Where the links and pictures of a page lead, headings of the page apart.
fn links(page: &str) -> Vec<&str> {
    let targets = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.map(|link| link.split('#').next().unwrap_or(link)).filter(|link| !link.is_empty()).collect()
}

#[test]
fn the_reference_is_what_its_command_makes() {
    let bench = bench!();
    let _said = bench.good("document --all-presets --out made");
    let (made, kept) = (bench.tree("made"), tree(&kept()));
    assert_eq!(names(&made), names(&kept), "files made, files kept: {AGAIN}");
    for (name, made) in &made {
        let text = |file: &Option<Vec<u8>>| String::from_utf8_lossy(file.as_deref().unwrap_or_default()).into_owned();
        let (made, kept) = (text(made), text(&kept[name]));
        let same = made.lines().zip(kept.lines()).take_while(|(made, kept)| made == kept).count();
        let (wanted, found) = (made.lines().nth(same), kept.lines().nth(same));
        assert!(made == kept, "{}, line {}:\n  made {wanted:?}\n  kept {found:?}\n{AGAIN}", name.display(), same + 1);
    }
}

#[test]
fn its_links_lead_somewhere() {
    let mut followed = 0;
    for name in tree(&kept()).into_keys().filter(|name| name.extension().is_some_and(|e| e == "md")) {
        let page = fs::read_to_string(kept().join(&name)).expect("a page");
        for link in links(&page) {
            assert!(kept().join(link).exists(), "{}: {link}", name.display());
            followed += 1;
        }
    }
    assert!(followed > 30, "{followed} links");
}

/// The page of a configuration of one's own has the same parts, whatever the hardware keeps.
#[test]
fn a_configuration_of_ones_own_has_its_page() {
    let bench = bench!();
    for name in ["small", "centred", "divider"] {
        let command = format!("document --config {name}.json --out {name}");
        let _said = bench.good(&command);
        let page = bench.text(&format!("{name}/{name}.md"));
        for heading in ["Ports", "Latency", "ROM map", "Lines", "Registers", "Timing", "Examples"] {
            assert!(page.contains(&format!("\n## {heading}\n")), "{name}: {heading}");
        }
        assert!(page.contains(&format!("blysk document --config {name}.json")), "{name}");
        assert_eq!(page.contains("### Divider"), name != "centred");
        assert_eq!(page.contains("t1 = c2"), name != "divider");
        for link in links(&page) {
            assert!(bench.path(name).join(link).exists(), "{name}: {link}");
        }
        let first = bench.tree(name);
        let _said = bench.good(&command);
        assert!(first == bench.tree(name), "{name}: the same command, the same bytes");
    }
}
