//! Limits on work, of a server in this process.

use std::time::Duration;

use serde_json::json;
use serve::Limits;

use crate::client::{post, with};

#[test]
fn what_takes_too_long_is_not_waited_for() {
    let limits = Limits { workers: 1, waiting: 4, deadline: Duration::from_millis(1) };
    with(limits, |port| {
        let question = json!({"configuration": {"preset": "paper"}}).to_string();
        let message = post(port, "/api/hardware", question.as_bytes()).refused(503);
        assert!(message.contains("longer than 0.001 s") && message.contains("fewer exponents"), "{message}");
    });
}

#[test]
fn a_queue_has_an_end() {
    let limits = Limits { workers: 1, waiting: 0, deadline: Duration::from_secs(60) };
    with(limits, |port| {
        let ask =
            move || post(port, "/api/hardware", json!({"configuration": {"preset": "paper"}}).to_string().as_bytes());
        let first: Vec<_> = (0..4).map(|_| std::thread::spawn(ask)).collect();
        let statuses: Vec<u16> = first.into_iter().map(|asked| asked.join().unwrap().status).collect();
        assert!(statuses.contains(&200) && statuses.contains(&503), "{statuses:?}");
        assert_eq!(ask().status, 200, "there is room again");
    });
}
