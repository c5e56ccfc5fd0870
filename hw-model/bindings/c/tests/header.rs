//! `include/blysk.h` is what cbindgen makes of the sources. With `BLYSK_HEADER=write` it is written anew:
//! `make header`.

use std::path::Path;

/// Puts pointers in the place of the names that the wrappers of `pointers.rs` have: a reader of the header must not
/// look up that `In_i64` is `const int64_t *`.
fn with_plain_pointers(header: &str) -> String {
    let wrapper = |line: &&str| line.starts_with("typedef ") && line.contains('*') && line.ends_with(';');
    let mut plain = header.to_owned();
    for line in header.lines().filter(wrapper) {
        let (pointer, name) = line.trim_end_matches(';').rsplit_once('*').expect("a pointer");
        let pointer = format!("{}*", pointer.trim_start_matches("typedef "));
        let at = plain.find(line).expect("a line of the header");
        // With the comment above it.
        let start = plain[..at].rfind("\n\n").map_or(0, |blank| blank + 1);
        plain.replace_range(start..at + line.len() + 1, "");
        plain = plain.replace(&format!("{name} "), &pointer);
    }
    plain
}

#[test]
fn the_header_is_that_of_the_sources() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let bindings = cbindgen::generate(package).expect("cbindgen reads the sources");
    let mut made = Vec::new();
    bindings.write(&mut made);
    let made = with_plain_pointers(&String::from_utf8(made).expect("a header is text"));
    assert!(made.matches("blysk_code blysk_").count() > 15, "{made}");
    assert!(!made.contains("In_") && !made.contains("Out_"), "{made}");
    let path = package.join("include/blysk.h");
    if std::env::var("BLYSK_HEADER").is_ok_and(|value| value == "write") {
        std::fs::write(&path, &made).expect("the header is written");
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == made, "{} is not that of the sources: run `make header`", path.display());
}
