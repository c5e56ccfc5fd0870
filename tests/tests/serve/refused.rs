//! Who is not answered, and what is no question: always a status, and the server goes on.

use blysk_tests::bench;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use serde_json::json;
use vectors::limits::MOST_SERVED_TEXT;

use crate::client::Served;

const PATHS: [&str; 7] =
    ["/api/hardware", "/api/highlight", "/api/curve", "/api/alter", "/api/rtl", "/api/clock/open", "/api/clock"];

fn with_headers(served: &Served, method: &str, path: &str, headers: &str) -> u16 {
    let body = "{}";
    let length = body.len();
    served
        .raw(
            format!("{method} {path} HTTP/1.1\r\nConnection: close\r\nContent-Length: {length}\r\n{headers}\r\n{body}")
                .as_bytes(),
        )
        .status
}

#[test]
fn another_host_or_origin_is_refused() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    let port = served.port;
    for host in ["evil.example".to_owned(), format!("evil.example:{port}"), "127.0.0.1:1".to_owned()] {
        assert_eq!(with_headers(&served, "GET", "/", &format!("Host: {host}\r\n")), 403, "{host}");
    }
    let own = format!("Host: 127.0.0.1:{port}\r\nContent-Type: application/json\r\n");
    for path in PATHS {
        assert_eq!(with_headers(&served, "POST", path, &format!("{own}Origin: http://evil.example\r\n")), 403);
        assert_eq!(with_headers(&served, "POST", path, &own), 400, "{path}: no question, but answered");
        assert_eq!(with_headers(&served, "GET", path, &own), 405);
        assert_eq!(with_headers(&served, "POST", path, &format!("Host: localhost:{port}\r\n")), 415);
    }
    assert_eq!(served.get("/etc/passwd").status, 404);
    let page = served.get("/");
    assert!(page.head.to_lowercase().contains("content-security-policy: default-src 'none'"), "{}", page.head);
}

#[test]
fn a_long_body_or_configuration_is_refused() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    let long = json!({"configuration": {"text": " ".repeat(MOST_SERVED_TEXT + 1)}});
    assert!(served.post("/api/hardware", &long).refused(422).contains("65537 bytes"));
    let longer = json!({"configuration": {"text": " ".repeat(4 * MOST_SERVED_TEXT)}});
    assert!(served.post("/api/hardware", &longer).refused(413).contains("at most"));
    let rows =
        r#"{"name": "many", "method": "hermite", "exponents": "1..=8192", "input": "UQ1.10", "output": "UQ1.9"}"#;
    let many = json!({"configuration": {"text": rows}});
    assert!(served.post("/api/hardware", &many).refused(503).contains("4096 exponents would fit"));
}

#[test]
fn a_bad_configuration_is_refused_as_on_the_command_line() {
    let bench = bench!();
    let served = Served::start(&bench, &[]);
    // An empty text is refused before it is read as JSON, in other words than an empty file.
    let cases = [
        ("{\n  \"name\": 3\n}", Some((2, 11))),
        ("{\"name\": \"a\", \"method\": \"hermit\"}", Some((1, 33))),
        (r#"{"name": "a", "method": "hermite", "exponents": "1..=4", "input": "UQ1.9", "output": "Q1.8"}"#, None),
    ];
    for (text, place) in cases {
        bench.write("configuration.json", text);
        let said = bench.run("report --config configuration.json");
        let answer = served.post("/api/hardware", &json!({"configuration": {"text": text}}));
        let message = answer.refused(422);
        assert_eq!(said.stderr.trim_end(), format!("error: {message}"), "{text}");
        let error = &answer.json()["error"];
        assert_eq!(error["line"].as_u64().zip(error["column"].as_u64()), place, "{error}");
    }
    let none = json!({"configuration": {"preset": "papyrus"}, "n": "64", "x": {"real": "0.99"}});
    assert!(served.post("/api/highlight", &none).refused(422).contains("there is no preset"));
}

#[test]
fn numbers_that_are_none_are_refused() {
    let bench = bench!();
    let served = Served::start(&bench, &["--config", "small.json"]);
    let question =
        |n: &str, x: serde_json::Value| json!({"configuration": {"text": blysk_tests::cli::SMALL}, "n": n, "x": x});
    for n in ["", "NaN", "1e999", "-3", "0", "0x40", "64;", &"9".repeat(5000)] {
        let message = served.post("/api/highlight", &question(n, json!({"real": "0.5"}))).refused(422);
        assert!(message.starts_with("n: "), "{message}");
    }
    for x in ["", "inf", "NaN", "1e400", "7", "abc"] {
        let message = served.post("/api/highlight", &question("4", json!({"real": x}))).refused(422);
        assert!(message.starts_with("x: "), "{message}");
    }
    for bits in ["", "1.5", "0x", "0x+1", "99999999999999999999", "4096"] {
        let message = served.post("/api/highlight", &question("4", json!({"bits": bits}))).refused(422);
        assert!(message.starts_with("x: "), "{message}");
    }
    for body in
        ["{\"n\": NaN}", "{\"n\": 1e999}", "[[[[[[[[", "null", "\u{0}", "{\"configuration\": {\"preset\": \"paper\"}}"]
    {
        assert!(served.post_bytes("/api/highlight", body.as_bytes()).refused(400).starts_with("no question: "));
    }
}

/// Cut, altered and random bodies: a status of a refusal or of success, never of a fault, and the server still answers.
#[test]
fn nothing_that_is_sent_stops_it() {
    let bench = bench!();
    let served = Served::start(&bench, &["--config", "small.json"]);
    let configuration = json!({"text": blysk_tests::cli::SMALL});
    let good = json!({"configuration": configuration, "n": "4", "x": {"real": "0.5"}, "span": "all", "register": "c3",
        "format": "Q2.9", "session": 1, "reset": false, "in_valid": true, "out_ready": true, "cycles": 1});
    let good = good.to_string().into_bytes();
    let altered = (0..good.len(), prop_oneof![Just(None), any::<u8>().prop_map(Some)]).prop_map(move |(at, byte)| {
        let mut body = good.clone();
        match byte {
            Some(byte) => body[at] = byte,
            None => body.truncate(at),
        }
        body
    });
    let body = prop_oneof![3 => altered, 1 => prop::collection::vec(any::<u8>(), 0..200)];
    let mut runner = TestRunner::new(Config { cases: 200, failure_persistence: None, ..Config::default() });
    let fuzzed = runner.run(&(0..PATHS.len(), body), |(path, body)| {
        let status = served.post_bytes(PATHS[path], &body).status;
        prop_assert!([200, 400, 422, 503].contains(&status), "{}: {status}", PATHS[path]);
        Ok(())
    });
    fuzzed.unwrap();
    for bytes in [&b"\x16\x03\x01\x02\x00\x01\x00\r\n\r\n"[..], b"GET / HTTP/9.9\r\n\r\n"] {
        assert!((400..600).contains(&served.raw(bytes).status));
    }
    assert_eq!(served.get("/").status, 200);
}
