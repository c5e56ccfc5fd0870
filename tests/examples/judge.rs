//! Scratch.
use blysk_tests::rtl::mutants::{preset, proof::Prover};
use std::path::Path;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let dir = Path::new(&args[1]);
    let design = preset(&args[2]).unwrap();
    let seconds = args[3].parse().unwrap();
    let start = Instant::now();
    let prover = Prover::new(dir, "right.il", design.datapath(), seconds).unwrap();
    println!("prepared in {:?}", start.elapsed());
    let list = std::fs::read_to_string(dir.join("mutations.ys")).unwrap();
    for n in &args[4..] {
        let n: usize = n.parse().unwrap();
        let line = list.lines().nth(n - 1).unwrap();
        let words: Vec<&str> = line.split_whitespace().collect();
        let at = words.iter().position(|w| *w == "-ctrl").unwrap();
        let plain = [&words[..at], &words[at + 4..]].concat().join(" ");
        let start = Instant::now();
        let verdict = prover.judge(n, &plain);
        println!(
            "{n} {:.1?} {verdict:?} {}",
            start.elapsed(),
            &plain.chars().take(140).collect::<String>()
        );
    }
}
