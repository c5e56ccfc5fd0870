//! What is answered is what the command says.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::time::Duration;

use blysk_tests::bench;
use blysk_tests::cli::Bench;
use serde_json::{Value, json};
use serve::Limits;

use crate::client::{Served, post, with};

fn highlight(served: &Served, preset: &str, n: &str, x: &str) -> Value {
    served.post("/api/highlight", &json!({"configuration": {"preset": preset}, "n": n, "x": {"real": x}})).good()
}

fn text<'a>(value: &'a Value, way: &str) -> &'a str {
    value.pointer(way).and_then(Value::as_str).unwrap_or_else(|| panic!("{way} in {value}"))
}

#[test]
fn a_highlight_is_what_evaluate_prints() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    for (preset, n, x) in
        [("compact", "64", "0.99"), ("paper", "3", "0.25"), ("precise", "256", "0.999"), ("paper", "300", "0.5")]
    {
        let answer = highlight(&served, preset, n, x);
        let printed = bench.good(&format!("evaluate --preset {preset} --n {n} --x {x} --ranks"));
        let (head, ranks) = printed.split_once("\n\n").unwrap();
        for line in [
            format!("intensity  {}  (", text(&answer, "/intensity/decimal")),
            format!(": {}, {})", text(&answer, "/intensity/bits"), text(&answer, "/intensity/hex")),
            format!(
                "x^n        {}  (n = {}, x = {} in",
                text(&answer, "/reference/text"),
                text(&answer, "/n/text"),
                text(&answer, "/x/text")
            ),
            format!("error      {} ulp of", text(&answer, "/error_ulp/text")),
            format!(", {} % of full", text(&answer, "/error_per_cent/text")),
            format!("region     {}  (status {})", text(&answer, "/region"), text(&answer, "/status")),
        ] {
            assert!(head.contains(&line), "{line:?} is not in\n{head}");
        }
        let mut rows = ranks.lines().skip(1);
        for rank in answer["ranks"].as_array().unwrap() {
            for register in rank["registers"].as_array().unwrap() {
                let shown = ["/name", "/format/name", "/hex", "/bits", "/value"].map(|way| text(register, way));
                let row: Vec<&str> = rows.next().unwrap().split_whitespace().collect();
                assert_eq!(row, [&[text(rank, "/name")], &shown[..]].concat());
                assert_eq!(text(register, "/binary").len() as u64, register["format"]["width"].as_u64().unwrap());
                let [least, value, greatest] = ["/range/least", "/decimal", "/range/greatest"]
                    .map(|way| text(register, way).parse::<f64>().unwrap());
                assert!(least <= value && value <= greatest, "{register}");
            }
        }
        assert_eq!(rows.next(), None, "every row was seen");
    }
}

#[test]
fn a_curve_is_what_evaluate_answers() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    for span in ["all", "highlight"] {
        let curve =
            served.post("/api/curve", &json!({"configuration": {"preset": "precise"}, "n": "64", "span": span})).good();
        let column = |name: &str| curve[name].as_array().unwrap().clone();
        assert_eq!(column("x").len(), vectors::limits::MOST_SERVED_POINTS);
        let questions: String = column("x").iter().map(|x| format!("64,{x}\n")).collect();
        bench.write("questions.csv", format!("n,x\n{questions}"));
        let answers = bench.good("evaluate --preset precise --format csv questions.csv");
        for (place, line) in answers.lines().skip(1).enumerate() {
            let fields: Vec<&str> = line.split(',').collect();
            for (name, field) in [("x", 1), ("intensity", 2), ("reference", 3), ("error_ulp", 4)] {
                assert_eq!(fields[field].parse::<f64>().unwrap(), curve[name][place].as_f64().unwrap(), "{line}");
            }
            assert_eq!(fields[5], text(&curve["region"][place], ""));
        }
    }
    let none = json!({"configuration": {"preset": "precise"}, "n": "300", "span": "all"});
    assert!(served.post("/api/curve", &none).refused(422).contains("no word for n = 300"));
}

/// The files of a directory by their names.
fn files(bench: &Bench, directory: &str) -> BTreeMap<String, Vec<u8>> {
    let tree = bench.tree(directory).into_iter();
    tree.filter_map(|(path, bytes)| Some((path.file_name()?.to_str()?.to_owned(), bytes?))).collect()
}

fn unpacked(archive: &[u8], below: &str) -> BTreeMap<String, Vec<u8>> {
    let mut archive = zip::ZipArchive::new(Cursor::new(archive)).unwrap();
    let mut files = BTreeMap::new();
    for place in 0..archive.len() {
        let mut file = archive.by_index(place).unwrap();
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        files.insert(file.name().strip_prefix(below).unwrap().to_owned(), bytes);
    }
    files
}

#[test]
fn the_archive_is_what_rtl_writes() {
    let bench = bench!();
    // However busy the machine is that tests.
    with(Limits { deadline: Duration::from_secs(600), ..Limits::default() }, |port| archives(&bench, port));
}

fn archives(bench: &Bench, port: u16) {
    let ask =
        |configuration: Value| post(port, "/api/rtl", json!({ "configuration": configuration }).to_string().as_bytes());
    let preset = ask(json!({"preset": "compact"}));
    assert!(preset.head.contains("application/zip"), "{}", preset.head);
    assert_eq!(preset.body, ask(json!({"preset": "compact"})).body, "the same bytes");
    let _said = bench.good("rtl --preset compact --out compact");
    assert_eq!(unpacked(&preset.body, "compact/"), files(bench, "compact"));

    bench.write("configuration.json", blysk_tests::cli::CENTRED);
    let own = ask(json!({"text": blysk_tests::cli::CENTRED}));
    let _said = bench.good("rtl --config configuration.json --out own");
    let mut wanted = files(bench, "own");
    wanted.insert("configuration.json".to_owned(), blysk_tests::cli::CENTRED.into());
    assert_eq!(unpacked(&own.body, "centred/"), wanted);
}

#[test]
fn an_altered_width_is_what_report_measures() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    let configuration = json!({"text": blysk_tests::cli::CENTRED});
    let hardware = served.post("/api/hardware", &json!({"configuration": configuration})).good();
    let c3 = hardware["registers"].as_array().unwrap().iter().find(|register| register["name"] == "c3").unwrap();
    let format = text(c3, "/fewer");
    let altered =
        served.post("/api/alter", &json!({"configuration": configuration, "register": "c3", "format": format})).good();
    assert_eq!((text(&altered, "/format_before"), text(&altered, "/format_after")), (text(c3, "/format/name"), format));
    assert_eq!(altered["before"], hardware["figures"]);
    assert_ne!(altered["after"], altered["before"]);
    bench.write("altered.json", text(&altered, "/text"));
    for (file, figures) in [("centred.json", &altered["before"]), ("altered.json", &altered["after"])] {
        let rows: Value =
            serde_json::from_str(&bench.run(&format!("report --config {file} --format json")).stdout).unwrap();
        let worst =
            |field: &str| rows.as_array().unwrap().iter().map(|row| row[field].as_f64().unwrap()).fold(0.0, f64::max);
        assert_eq!(figures["epicentre"]["per_cent"]["value"], worst("total_abs") * 100.0);
        assert_eq!(figures["everywhere"]["per_cent"]["value"], worst("full_range_abs") * 100.0);
    }
    let alter = |register: &str, format: &str| {
        served
            .post("/api/alter", &json!({"configuration": configuration, "register": register, "format": format}))
            .refused(422)
    };
    assert!(alter("c9", "Q2.9").contains("c3"), "the registers that there are");
    assert!(alter("c3", "Q0.64").contains("Q0.64"));
    assert!(alter("c3", "Q-5.12").contains("overflow"));
}

#[test]
fn the_clock_is_the_pipelines() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    let opened = served.post("/api/clock/open", &json!({"configuration": {"preset": "compact"}})).good();
    let ranks = opened["ranks"].as_array().unwrap().len();
    let drive = |in_valid: bool, out_ready: bool, reset: bool, cycles: u64| {
        let question = json!({"session": opened["session"], "n": "64", "x": {"real": "0.99"}, "reset": reset,
            "in_valid": in_valid, "out_ready": out_ready, "cycles": cycles});
        served.post("/api/clock", &question).good()
    };
    let held = |answer: &Value, flag: &str| {
        answer["ranks"].as_array().unwrap().iter().filter(|rank| rank[flag] == true).count()
    };
    let answer = drive(true, false, false, ranks as u64);
    assert_eq!((held(&answer, "valid"), held(&answer, "stalled")), (ranks, ranks), "full, and nobody takes the result");
    assert_eq!((&answer["now"]["in_ready"], &answer["now"]["out_valid"]), (&json!(false), &json!(true)));
    assert_eq!(answer["cycles"].as_array().unwrap().len(), ranks);
    assert_eq!(answer["now"]["intensity"], highlight(&served, "compact", "64", "0.99")["intensity"]["bits"]);
    let answer = drive(false, true, false, 1);
    assert_eq!((held(&answer, "valid"), held(&answer, "stalled")), (ranks - 1, 0), "one was taken, all moved on");
    let last = &answer["ranks"][ranks - 1];
    let wanted = &highlight(&served, "compact", "64", "0.99")["ranks"][ranks - 1]["registers"][0];
    assert_eq!(last["registers"][0]["hex"], wanted["hex"], "{last}");
    assert_eq!(held(&drive(false, true, true, 1), "valid"), 0, "a reset clears the flags");
    assert!(drive(false, false, false, 0)["cycles"].as_array().unwrap().is_empty());

    let clock = |session: u64, cycles: u64| {
        let question = json!({"session": session, "n": "64", "x": {"real": "0.99"}, "reset": false, "in_valid": true,
            "out_ready": true, "cycles": cycles});
        served.post("/api/clock", &question)
    };
    let first = opened["session"].as_u64().unwrap();
    assert!(clock(first, 65).refused(422).contains("0 to 64"));
    assert!(clock(99, 1).refused(422).contains("not kept"));
    for _ in 0..vectors::limits::MOST_SERVED_SESSIONS {
        served.post("/api/clock/open", &json!({"configuration": {"preset": "compact"}})).good();
    }
    assert!(clock(first, 1).refused(422).contains("not kept any more"), "the oldest goes");
}
