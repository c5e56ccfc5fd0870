//! A server that the command runs, and requests to it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::sync::mpsc::channel;
use std::time::Duration;

use blysk_tests::cli::Bench;
use serde_json::Value;
use serve::{Limits, Server, Start};

/// `blysk serve` on a free port; it goes when this is dropped.
pub struct Served {
    pub child: Child,
    pub port: u16,
}

/// What a server answers.
#[derive(Debug)]
pub struct Answer {
    pub status: u16,
    pub head: String,
    pub body: Vec<u8>,
}

impl Answer {
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }

    /// The message of a refusal with this status.
    pub fn refused(&self, status: u16) -> String {
        assert_eq!(self.status, status, "{}", String::from_utf8_lossy(&self.body));
        self.json()["error"]["message"].as_str().expect("a message").to_owned()
    }

    pub fn good(&self) -> Value {
        assert_eq!(self.status, 200, "{}", String::from_utf8_lossy(&self.body));
        self.json()
    }
}

impl Served {
    /// With these options besides.
    pub fn start(bench: &Bench, options: &[&str]) -> Self {
        let arguments = [&["serve", "--port", "0", "--open", "no"], options].concat();
        let mut child =
            bench.command(&arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs");
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().expect("piped")).read_line(&mut line).expect("a line");
        let port = line.strip_prefix("http://127.0.0.1:").and_then(|rest| rest.split_once('/')).map(|(port, _)| port);
        let port = port.and_then(|port| port.parse().ok()).unwrap_or_else(|| panic!("no address: {line:?}"));
        Self { child, port }
    }

    /// A request as it stands, and what comes back until the connection ends.
    pub fn raw(&self, request: &[u8]) -> Answer {
        raw(self.port, request)
    }

    pub fn get(&self, path: &str) -> Answer {
        self.raw(
            format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n", self.port).as_bytes(),
        )
    }

    pub fn post(&self, path: &str, question: &Value) -> Answer {
        post(self.port, path, question.to_string().as_bytes())
    }

    pub fn post_bytes(&self, path: &str, body: &[u8]) -> Answer {
        post(self.port, path, body)
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // It has ended where a test ended it.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A question to the server on this port.
pub fn post(port: u16, path: &str, body: &[u8]) -> Answer {
    let head = format!(
        "POST {path} HTTP/1.1\r\nHost: localhost:{port}\r\nOrigin: http://localhost:{port}\r\nConnection: close\r\n\
         Content-Type: application/json\r\nContent-Length: {}\r\n\r\n",
        body.len()
    );
    raw(port, &[head.as_bytes(), body].concat())
}

fn raw(port: u16, request: &[u8]) -> Answer {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("the server listens");
    stream.set_read_timeout(Some(Duration::from_secs(600))).expect("a timeout");
    // A server may answer, and close, before it has read a body that is too long.
    let _ = stream.write_all(request);
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer);
    let end = answer.windows(4).position(|four| four == b"\r\n\r\n").unwrap_or_else(|| panic!("no answer: {answer:?}"));
    let head = String::from_utf8(answer[..end].to_vec()).expect("a head is text");
    let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).expect("a status");
    Answer { status, head, body: answer.split_off(end + 4) }
}

/// Runs a server with these limits in this process while `work` asks it.
pub fn with(limits: Limits, work: impl FnOnce(u16)) {
    let server = Server::bind(0, Start::Preset("compact".to_owned()), limits).unwrap();
    let port = server.address().trim_end_matches('/').rsplit_once(':').unwrap().1.parse().unwrap();
    let (stop, stopped) = channel::<()>();
    let running = std::thread::spawn(move || server.run(move || stopped.recv().is_err()));
    work(port);
    drop(stop);
    assert!(running.join().unwrap().unwrap(), "it ran until it was told to stop");
}
