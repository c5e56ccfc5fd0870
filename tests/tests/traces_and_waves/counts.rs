//! The printed counts against what can be counted in the trace.

use blysk_tests::cli::{csv_rows, number};
use hw_model::design::Design;
use serde_json::Value;

use super::trace::Trace;

pub const NAMES: [&str; 9] = [
    "cycles",
    "requests",
    "results",
    "lost_to_reset",
    "stalls",
    "bubbles",
    "latency",
    "initiation_interval",
    "cycles_per_million_results",
];

pub fn check(printed: &str, trace: &Trace, design: &Design, place: &str) {
    let printed: Value = serde_json::from_str(printed).unwrap();
    let [printed] = printed.as_array().unwrap().as_slice() else { panic!("{printed}") };
    let names: Vec<&String> = printed.as_object().unwrap().keys().collect();
    let mut wanted = NAMES;
    wanted.sort_unstable();
    assert_eq!(names, wanted);

    let all = 0..trace.len();
    let count = |of: &dyn Fn(usize) -> bool| all.clone().filter(|&cycle| of(cycle)).count();
    let flag = |cycle, column| trace.flag(cycle, column);
    let taken = |cycle| flag(cycle, "in_valid") && flag(cycle, "in_ready");
    let requests: Vec<usize> = all.clone().filter(|&cycle| taken(cycle)).collect();
    let results = count(&|cycle| flag(cycle, "out_valid") && flag(cycle, "out_ready") && !flag(cycle, "rst"));
    let lost: usize = all
        .clone()
        .filter(|&cycle| flag(cycle, "rst"))
        .map(|cycle| {
            let valid = trace.header.iter().filter(|name| name.ends_with(".valid"));
            valid.filter(|name| flag(cycle, name)).count()
        })
        .sum();
    let stalls = count(&|cycle| flag(cycle, "out_valid") && !flag(cycle, "out_ready") && !flag(cycle, "rst"));
    let (first, last) = (requests[0], requests[requests.len() - 1]);
    let bubbles = (first..last).filter(|&cycle| flag(cycle, "in_ready") && !flag(cycle, "in_valid")).count();
    assert_eq!(requests.len(), results + lost, "{place}");

    for (name, wanted) in [
        ("cycles", trace.len()),
        ("requests", requests.len()),
        ("results", results),
        ("lost_to_reset", lost),
        ("stalls", stalls),
        ("bubbles", bubbles),
        ("latency", design.datapath().rank_count()),
    ] {
        assert_eq!(printed[name].as_u64(), Some(wanted as u64), "{place}: {name}");
    }
    let real = |name: &str| printed[name].as_f64().unwrap();
    let interval = (last - first) as f64 / (requests.len() - 1) as f64;
    assert_eq!(real("initiation_interval"), interval, "{place}");
    let taken_from_it: Vec<usize> = all
        .clone()
        .filter(|&cycle| flag(cycle, "out_valid") && flag(cycle, "out_ready") && !flag(cycle, "rst"))
        .collect();
    let span = taken_from_it[results - 1] - taken_from_it[0];
    let per_million = span as f64 * 1e6 / (results - 1) as f64;
    assert!((real("cycles_per_million_results") / per_million - 1.0).abs() < 1e-12, "{place}");

    // What the patterns are for.
    match place.split_once(", ").unwrap().1 {
        "nothing in the way" => {
            assert_eq!((stalls, bubbles, lost), (0, 0, 0), "{place}");
            assert_eq!(interval, 1.0, "{place}");
            assert_eq!(trace.len(), requests.len() + design.datapath().rank_count(), "{place}");
        }
        "bubbles" => assert!(bubbles > 20 && stalls == 0 && lost == 0, "{place}"),
        "stalls" => assert!(stalls > 20 && bubbles == 0 && lost == 0, "{place}"),
        "bubbles and stalls" => assert!(stalls > 20 && bubbles > 0 && lost == 0, "{place}"),
        "resets" => assert!(stalls == 0 && lost > 20, "{place}"),
        "a long stall" => assert!(lost == design.datapath().rank_count(), "{place}: {lost}"),
        _ => assert!(stalls > 10 && bubbles > 0 && lost > 0, "{place}"),
    }
}

pub fn same_in_every_format(json: &str, csv: &str, table: &str) {
    let json: Value = serde_json::from_str(json).unwrap();
    let rows = csv_rows(csv);
    assert_eq!(rows.len(), 1);
    assert_eq!(csv.lines().next(), Some(NAMES.join(",").as_str()));
    // The counts stand above an empty line, and the answers below it.
    let counts: Vec<&str> = table.lines().take_while(|line| !line.is_empty()).skip(1).collect();
    assert_eq!(counts.len(), NAMES.len(), "{table}");
    for (name, line) in NAMES.iter().zip(counts) {
        let wanted = json[0][name].as_f64().unwrap();
        assert_eq!(number(&rows[0], name), wanted, "{name}");
        let (label, value) = line.trim_end().rsplit_once(' ').unwrap();
        assert_eq!(label.trim(), name.replace('_', " "));
        let value: f64 = value.parse().unwrap();
        assert!((value - wanted).abs() <= 1e-8 * wanted, "{name}: {value} for {wanted}");
    }
}
