//! Files appear whole, or not at all.

use std::fs;
use std::io::Write;
use std::path::Path;

use vectors::whole_file::check_list;
use vectors::{OutputError, OutputSet, Staging, WholeFile};

fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn what_an_earlier_run_left_goes_with_the_commit_and_not_before() {
    let home = tempfile::tempdir().unwrap();
    let place = |name: &str| home.path().join(name);
    for name in ["old.mem", "both.mem", "mine.txt"] {
        std::fs::write(place(name), "left").unwrap();
    }
    let mut set = OutputSet::create(home.path()).unwrap();
    set.obsolete("old.mem");
    set.obsolete("both.mem");
    set.obsolete("never.mem");
    set.write("both.mem", "new").unwrap();
    assert!(place("old.mem").exists());
    set.commit().unwrap();
    assert!(!place("old.mem").exists() && place("mine.txt").exists());
    assert_eq!(std::fs::read_to_string(place("both.mem")).unwrap(), "new");
}

#[test]
fn committed_files_are_all_there_and_nothing_else() {
    let place = tempfile::tempdir().unwrap();
    let directory = place.path().join("a/b");
    let mut set = OutputSet::create(&directory).unwrap();
    let mut long = set.file("long").unwrap();
    set.write("short", "s\n").unwrap();
    for _ in 0..100_000 {
        long.write_all(b"0123456789\n").unwrap();
    }
    set.keep(long).unwrap();
    let under_way = names(place.path());
    assert!(under_way.iter().all(|name| name.starts_with(".blysk-")), "nothing has its name yet");
    assert_eq!(under_way.len(), 1);
    let paths = set.commit().unwrap();
    assert_eq!(paths, [directory.join("short"), directory.join("long")]);
    assert_eq!(names(&directory), ["long", "short"]);
    assert_eq!(fs::read(directory.join("long")).unwrap().len(), 1_100_000);
}

#[test]
fn what_is_not_committed_leaves_nothing() {
    let place = tempfile::tempdir().unwrap();
    let mut set = OutputSet::create(place.path().join("new/deep")).unwrap();
    set.write("a", "a").unwrap();
    let begun = set.file("b").unwrap();
    drop(begun);
    drop(set);
    assert!(names(place.path()).is_empty());

    fs::write(place.path().join("old"), "kept").unwrap();
    let mut file = WholeFile::create(place.path().join("old")).unwrap();
    file.write_all(b"lost").unwrap();
    drop(file);
    assert_eq!(fs::read(place.path().join("old")).unwrap(), b"kept");
    assert_eq!(names(place.path()), ["old"]);
    drop(WholeFile::create(place.path().join("x/y/trace.csv")).unwrap());
    assert_eq!(names(place.path()), ["old"]);
}

#[test]
fn a_file_begun_and_not_kept_stops_the_set() {
    let place = tempfile::tempdir().unwrap();
    let mut set = OutputSet::create(place.path()).unwrap();
    set.write("a", "a").unwrap();
    let begun = set.file("b").unwrap();
    let error = set.commit().unwrap_err();
    drop(begun);
    assert!(matches!(error, OutputError::Unfinished(path) if path.ends_with("b")));
    assert!(names(place.path()).is_empty());
}

#[test]
fn one_whole_file_replaces_the_old_one() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("t/trace.csv");
    for text in ["first, and longer", "second"] {
        let mut file = WholeFile::create(&path).unwrap();
        file.write_all(text.as_bytes()).unwrap();
        assert_eq!(file.commit().unwrap(), path);
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }
}

#[cfg(unix)]
#[test]
fn others_may_read_what_the_umask_lets_them() {
    use std::os::unix::fs::PermissionsExt;
    let place = tempfile::tempdir().unwrap();
    let usual = place.path().join("usual");
    fs::write(&usual, "").unwrap();
    let mut set = OutputSet::create(place.path()).unwrap();
    set.write("whole", "").unwrap();
    set.commit().unwrap();
    let mode = |name| fs::metadata(place.path().join(name)).unwrap().permissions().mode();
    assert_eq!(mode("whole"), mode("usual"));
}

#[test]
fn a_file_in_the_way_of_the_directory_is_named() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("file");
    fs::write(&file, "kept").unwrap();
    for directory in [file.clone(), file.join("below")] {
        let error = OutputSet::create(&directory).unwrap_err();
        let text = error.to_string();
        assert!(matches!(error, OutputError::Directory { .. }), "{text}");
        assert!(text.contains(directory.to_str().unwrap()), "{text}");
        assert!(text.contains("a file is in the way"), "{text}");
    }
    assert_eq!(names(place.path()), ["file"]);
}

/// A directory that refuses files even to root.
#[cfg(target_os = "linux")]
#[test]
fn an_unwritable_directory_is_named() {
    let error = WholeFile::create("/proc/self/fdinfo/trace.csv").unwrap_err();
    let text = error.to_string();
    assert!(matches!(error, OutputError::Write { .. }), "{text}");
    assert!(text.starts_with("cannot write /proc/self/fdinfo/trace.csv: "), "{text}");
    assert!(!text.contains(".blysk-"), "{text}");
    let error = OutputSet::create("/proc/self/fdinfo/out").unwrap_err();
    assert!(matches!(error, OutputError::Directory { .. }), "{error}");
}

#[test]
fn neither_a_device_nor_a_directory_is_replaced() {
    let place = tempfile::tempdir().unwrap();
    fs::create_dir(place.path().join("sub")).unwrap();
    let error = WholeFile::create(place.path().join("sub")).unwrap_err();
    assert!(matches!(error, OutputError::NotAFile(_)), "{error}");
    let mut set = OutputSet::create(place.path()).unwrap();
    assert!(matches!(set.file("sub").unwrap_err(), OutputError::NotAFile(_)));
    for name in ["", "..", "sub/inner", "/absolute"] {
        let error = set.file(name).unwrap_err();
        assert!(matches!(error, OutputError::NoName(_) | OutputError::NotAFile(_)), "{name}");
    }
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_stay() {
    use std::os::unix::fs::symlink;
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    fs::create_dir(at("real")).unwrap();
    fs::write(at("real/file"), "old").unwrap();
    for (link, to) in [("link", "real/file"), ("again", "link"), ("null", "/dev/null"), ("none", "nowhere")] {
        symlink(to, at(link)).unwrap();
    }
    for link in ["link", "again"] {
        WholeFile::create(at(link)).unwrap().fill(link).unwrap();
        assert_eq!(fs::read_to_string(at("real/file")).unwrap(), link);
        assert!(at(link).is_symlink() && names(&at("real")) == ["file"]);
    }
    let mut set = OutputSet::create(place.path()).unwrap();
    set.write("link", "set").unwrap();
    // A set is files; a stream is for one.
    assert!(matches!(set.file("null").unwrap_err(), OutputError::NotAFile(_)));
    set.commit().unwrap();
    assert_eq!(fs::read_to_string(at("real/file")).unwrap(), "set");
    assert!(at("link").is_symlink());
    WholeFile::create(at("null")).unwrap().fill("gone").unwrap();
    assert!(at("null").is_symlink());
    let _socket = std::os::unix::net::UnixListener::bind(at("socket")).unwrap();
    let error = WholeFile::create(at("socket")).unwrap_err();
    assert!(matches!(error, OutputError::NotAFile(_)), "{error}");
    let error = WholeFile::create(at("none")).unwrap_err();
    assert!(error.to_string().contains("which does not exist"), "{error}");
    let error = OutputSet::create(at("none/deep")).unwrap_err();
    assert!(matches!(error, OutputError::Dangling { .. }), "{error}");
}

#[test]
fn a_set_in_sub_directories_is_listed_and_every_change_is_found() {
    let home = tempfile::tempdir().unwrap();
    let directory = home.path().join("set");
    for text in ["first", "second"] {
        let mut set = OutputSet::create(&directory).unwrap().listed("test").unwrap();
        set.write("a", text).unwrap();
        set.within("deep", |set| set.write("b", text)).unwrap();
        set.seal("seal", text).unwrap();
        set.commit().unwrap();
        assert_eq!(names(&directory), ["a", "deep", "seal", "test.sha256"]);
        assert_eq!(names(&directory.join("deep")), ["b"]);
        assert_eq!(check_list(&directory, "test").unwrap(), ["a", "deep/b", "seal"]);
    }
    for (name, with) in [("a", "first"), ("deep/b", "first"), ("seal", ""), ("test.sha256", "?")] {
        let path = directory.join(name);
        let kept = fs::read(&path).unwrap();
        fs::write(&path, with).unwrap();
        let error = check_list(&directory, "test").unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
        fs::remove_file(&path).unwrap();
        let error = check_list(&directory, "test").unwrap_err().to_string();
        assert!(error.contains("incomplete") && error.contains(name), "{error}");
        fs::write(&path, kept).unwrap();
    }
    check_list(&directory, "test").unwrap();
}

#[test]
fn neither_inputs_nor_outputs_are_written_over() {
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    fs::write(at("in"), "kept").unwrap();
    fs::hard_link(at("in"), at("other_name")).unwrap();
    let inputs = [at("in")];
    for output in ["in", "./in", "other_name"] {
        let error = WholeFile::apart_from(&inputs, at(output)).unwrap_err();
        assert!(matches!(error, OutputError::Input { .. }), "{error}");
    }
    let mut set = OutputSet::apart_from(&inputs, place.path()).unwrap();
    assert!(matches!(set.file("in").unwrap_err(), OutputError::Input { .. }));
    drop(set);
    let set = OutputSet::apart_from(&inputs, place.path()).unwrap();
    assert!(matches!(set.announce(["new/x", "in"]).unwrap_err(), OutputError::Input { .. }));
    let mut staging = Staging::default();
    let _one = staging.begin(&at("new/x")).unwrap();
    let error = staging.begin(&at("./new/x")).unwrap_err();
    assert!(matches!(error, OutputError::Twice(_)), "{error}");
    drop(staging);
    assert_eq!(names(place.path()), ["in", "other_name"]);
}

/// Two sets that need the same directory, and neither is in the other's way.
#[test]
fn a_directory_that_another_set_makes_meanwhile_is_shared() {
    let home = tempfile::tempdir().unwrap();
    let begun = |directory: &str| {
        let mut set = OutputSet::create(home.path().join(directory)).unwrap();
        set.write("file", directory).unwrap();
        set
    };
    let sets = ["new/a", "new/b", "new/deep/c", "new/a"].map(begun);
    let [a, b, c, again] = sets;
    for set in [a, b, c] {
        set.commit().unwrap();
    }
    let error = again.commit().unwrap_err().to_string();
    assert!(error.contains("new") && error.contains("in the way"), "{error}");
    assert_eq!(names(home.path()), ["new"]);
    assert_eq!(names(&home.path().join("new")), ["a", "b", "deep"]);
    for directory in ["new/a", "new/b", "new/deep/c"] {
        assert_eq!(fs::read_to_string(home.path().join(directory).join("file")).unwrap(), directory);
    }
}

#[test]
fn a_directory_in_the_way_at_the_end_leaves_the_old_set() {
    let place = tempfile::tempdir().unwrap();
    let begun = |text: &str| {
        let mut set = OutputSet::create(place.path()).unwrap().listed("test").unwrap();
        for name in ["a", "b", "c"] {
            set.write(name, text).unwrap();
        }
        set
    };
    begun("old").commit().unwrap();
    let set = begun("new");
    fs::remove_file(place.path().join("c")).unwrap();
    fs::create_dir(place.path().join("c")).unwrap();
    let error = set.commit().unwrap_err();
    assert!(matches!(error, OutputError::NotAFile(_)), "{error}");
    assert_eq!(names(place.path()), ["a", "b", "c", "test.sha256"]);
    assert_eq!(fs::read_to_string(place.path().join("a")).unwrap(), "old");
}
