//! Certificates of specialised hardware, altered and sealed again: none is accepted that says what is not so.
//!
//! Whoever alters a file can seal it, so every alteration here is sealed. What an accepted certificate says is worked
//! out again by this file, point by point and with arithmetic of its own for display codes. `BLYSK_ALTERATIONS` says
//! how many alterations are tried (`make alterations` tries thousands).

use std::sync::atomic::AtomicU64;

use blysk_tests::cli::SMALL;
use hw_model::config::Config;
use hw_model::datapath::Status;
use hw_model::design::Design;
use hw_model::quantise::real;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use scenes::scene::{Scene, Transfer};
use scenes::specialise::{Asked, Certificate, Display, Proved, Refused, certify, check, demands, derive, reduce, rows};
use vectors::checksum::checksum;

const SCENE: &str = r#"{
  "name": "two_balls",
  "image": {"width": 8, "height": 8, "display_bits": 8, "transfer": "srgb"},
  "camera": {"position": [0, 0, 6], "look_at": [0, 0, 0], "field_of_view_degrees": 4},
  "ambient_light": [1, 1, 1],
  "lights": [{"directional": {"towards": [0.02, 0.03, 1], "colour": [1, 1, 1]}}],
  "materials": [
    {"name": "dull", "exponent": 2, "ambient": [0, 0, 0], "diffuse": [0, 0, 0], "specular": [1, 1, 1]},
    {"name": "shiny", "exponent": 8, "ambient": [0, 0, 0], "diffuse": [0, 0, 0], "specular": [1, 1, 1]}
  ],
  "geometry": [
    {"sphere": {"centre": [0, 0, 0], "radius": 2, "material": "dull"}},
    {"sphere": {"centre": [0, 0, 0], "radius": 1.9, "material": "shiny"}}
  ]
}"#;

struct Bench {
    scene: Scene,
    source: Design,
    certificates: Vec<String>,
}

fn scene(json: &str) -> Scene {
    Scene::from_json(json, &mut |_| panic!("it has no mesh")).unwrap()
}

impl Bench {
    /// Certificates of the same bits, and of display codes that may differ by one.
    fn new() -> Self {
        let scene = scene(SCENE);
        let source = Design::new(Config::from_json(SMALL).unwrap()).unwrap();
        let display = Display { bits: 8, transfer: Transfer::Srgb };
        let rows = rows(&source, &demands(&scene)).unwrap();
        let make = |allowed| {
            let bar = AtomicU64::new(0);
            let (specialised, found) = reduce(&source, &rows, &scene.name, display, allowed, &bar).unwrap();
            let designs = (&source, &specialised);
            Certificate::new(&scene.name, "blysk specialise", display, found, designs).to_json()
        };
        let certificates = vec![make(None), make(Some(2))];
        Self { scene, source, certificates }
    }

    fn accepts(&self, text: &str, asked: Asked<'_>) -> bool {
        check(text, asked, &AtomicU64::new(0)).is_ok()
    }

    fn all(&self) -> Asked<'_> {
        Asked { scene: Some(&self.scene), source: Some(self.source.config()), codes: None }
    }
}

/// Written in the one way to write it, and sealed: what whoever alters it would do.
fn sealed(text: &str) -> Option<String> {
    let canonical = Certificate::parse(text).ok()?.to_json();
    let field = "\"sha256\": \"";
    let begin = canonical.rfind(field)? + field.len();
    let end = begin + canonical[begin..].find('"')?;
    let open = format!("{}{}", &canonical[..begin], &canonical[end..]);
    let digest = checksum(open.as_bytes()).unwrap().sha256;
    Some(format!("{}{digest}{}", &canonical[..begin], &canonical[end..]))
}

/// The same with the words that the checker would find: who lies about numbers lies about the words for them as well.
fn sealed_with_words(text: &str) -> Option<String> {
    let sealed_once = sealed(text)?;
    let Err(Refused::Found { field, said, found }) = check(&sealed_once, Asked::default(), &AtomicU64::new(0)) else {
        return Some(sealed_once);
    };
    if field != "statement" {
        return Some(sealed_once);
    }
    sealed(&sealed_once.replace(&said, &found))
}

/// Every place of a JSON text where a number, a word or a list can be altered: (begin, end) of each value in a line.
fn values(text: &str) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut begin = 0;
    for line in text.split_inclusive('\n') {
        let body = line.trim_end().trim_end_matches(',');
        let value = body.find("\": ").map_or_else(|| body.len() - body.trim_start().len(), |colon| colon + 3);
        if value < body.len() && !body[value..].starts_with(['{', '}', '[', ']']) {
            found.push((begin + value, begin + body.len()));
        }
        begin += line.len();
    }
    found
}

/// Another value in the place of one, by chance.
fn other(value: &str, random: &mut ChaCha8Rng) -> String {
    let mut pick = |count: u64| random.next_u64() % count;
    if let Some(word) = value.strip_prefix('"') {
        let word = word.trim_end_matches('"');
        const WORDS: [&str; 12] = [
            "three_point",
            "hermite",
            "power",
            "centred",
            "zero",
            "rational",
            "srgb",
            "linear",
            "UQ1.1",
            "UQ1.8",
            "floor",
            "bit_identical",
        ];
        return match pick(3) {
            0 => format!("\"{}\"", WORDS[pick(12) as usize]),
            1 => format!("\"{word}x\""),
            _ => {
                let digit = |c: char| if c.is_ascii_digit() { '3' } else { c };
                format!("\"{}\"", word.chars().map(digit).collect::<String>())
            }
        };
    }
    let number: f64 = value.parse().unwrap_or(0.0);
    match pick(12) {
        0 => "0".to_owned(),
        1 => "1".to_owned(),
        2 => (number + 1.0).to_string(),
        3 => (number - 1.0).to_string(),
        4 => number.next_up().to_string(),
        5 => number.next_down().to_string(),
        6 => "4294967295".to_owned(),
        7 => "9223372036854775807".to_owned(),
        8 => (-number).to_string(),
        9 => (number * 0.5).to_string(),
        10 => "null".to_owned(),
        _ => {
            let places: Vec<usize> =
                value.char_indices().filter(|(_, c)| c.is_ascii_digit()).map(|(at, _)| at).collect();
            if places.is_empty() {
                return "7".to_owned();
            }
            let at = places[pick(places.len() as u64) as usize];
            let digit = (value.as_bytes()[at] - b'0' + 1 + pick(9) as u8) % 10;
            format!("{}{digit}{}", &value[..at], &value[at + 1..])
        }
    }
}

/// The certificate with one thing altered: the value at a place that goes through all of them as `round` rises, there
/// or wherever it stands, or the whole line; or every eighth time a part more, a part fewer, or two exchanged.
fn altered(text: &str, round: usize, random: &mut ChaCha8Rng) -> String {
    if round % 8 == 7 {
        return other_parts(text, random);
    }
    let places = values(text);
    let (begin, end) = places[round % places.len()];
    let value = &text[begin..end];
    let new = other(value, random);
    match random.next_u64() % 8 {
        0 => text.replace(value, &new),
        1 => {
            let (from, to) = (text[..begin].rfind('\n').map_or(0, |at| at + 1), end);
            format!("{}{}", &text[..from], text[to..].trim_start_matches([',', '\n']))
        }
        _ => format!("{}{new}{}", &text[..begin], &text[end..]),
    }
}

fn other_parts(text: &str, random: &mut ChaCha8Rng) -> String {
    let mut json: serde_json::Value = serde_json::from_str(text).unwrap();
    let parts = json["parts"].as_array_mut().expect("a list of parts");
    let mut place = || (random.next_u64() % parts.len() as u64) as usize;
    let (one, another) = (place(), place());
    match random.next_u64() % 4 {
        0 => drop(parts.remove(one)),
        1 => parts.insert(another, parts[one].clone()),
        2 => parts.clear(),
        _ => parts.swap(one, another),
    }
    json.to_string()
}

/// The display code of linear light, by the definition and not by a table.
fn code(light: f64, display: Display) -> i64 {
    let greatest = ((1_u64 << display.bits) - 1) as f64;
    let light = light.clamp(0.0, 1.0);
    let shown = match display.transfer {
        Transfer::Linear => light,
        Transfer::Srgb if light <= 0.04045 / 12.92 => light * 12.92,
        Transfer::Srgb => 1.055 * light.powf(1.0 / 2.4) - 0.055,
    };
    (shown * greatest + 0.5).floor() as i64
}

/// Whether what an accepted certificate says is so, point by point.
fn is_so(certificate: &Certificate) -> Result<(), String> {
    let design = |config: &Config| Design::new(config.clone()).map_err(|error| error.to_string());
    let (source, small) = (design(&certificate.source)?, design(&certificate.specialised)?);
    let (mut codes, mut points) = (0, 0);
    for part in &certificate.parts {
        let place =
            |design: &Design| design.rom().exponents().position(part.n).map(|place| place as u32).ok_or("no word");
        let (was, is) = (place(&source)?, place(&small)?);
        let guarded = !certificate.specialised.domain.is_empty();
        let ulp = certificate.source.input.ulp();
        let first = if guarded { (part.least / ulp).floor() as i64 } else { 0 };
        let last = certificate.source.input.max_bits().min(certificate.source.input.one());
        let (mut differing, mut greatest, mut refused) = (0, 0.0_f64, 0);
        for x in 0..=last {
            let answer = small.datapath().evaluate(is, x);
            if x < first {
                if answer.intensity != 0 || answer.status != Status::OUT_OF_DOMAIN {
                    return Err(format!("n = {}, x = {x} is answered", part.n));
                }
                refused += 1;
                continue;
            }
            let wanted = source.datapath().evaluate(was, x);
            let numbers = [
                real(wanted.intensity, certificate.source.output),
                real(answer.intensity, certificate.specialised.output),
            ];
            points += 1;
            if numbers[0] != numbers[1] || wanted.status != answer.status {
                differing += 1;
                greatest = greatest.max((numbers[0] - numbers[1]).abs());
                let [a, b] = numbers.map(|number| code(number, certificate.display));
                codes = codes.max((a - b).abs());
            }
        }
        if (part.differing, part.greatest, part.refused) != (differing, greatest, refused) {
            return Err(format!("n = {}: {part:?}, found {differing} {greatest} {refused}", part.n));
        }
    }
    let said = match certificate.proved {
        Proved::BitIdentical => 0,
        Proved::Codes { greatest, .. } => i64::from(greatest),
    };
    if points != certificate.points() || codes != said {
        return Err(format!("{points} points, {codes} codes"));
    }
    for number in [points.to_string(), certificate.scene.clone(), certificate.source.name.clone()] {
        if !certificate.statement.contains(&number) {
            return Err(format!("{number} is not in the statement {}", certificate.statement));
        }
    }
    Ok(())
}

/// Forgeries of each certificate.
fn alterations() -> usize {
    std::env::var("BLYSK_ALTERATIONS").ok().map_or(1000, |text| text.parse().expect("a number"))
}

/// What came of the forgeries.
#[derive(Debug, Default)]
struct Tally {
    /// Texts that are no certificate any more: they are refused without a look at what they say.
    unreadable: usize,
    /// Certificates that say something else, sealed.
    forged: usize,
    /// Accepted without scene and configuration.
    alone: usize,
    /// Accepted with both.
    with_all: usize,
}

/// What is accepted although altered: true, and with the scene and the configuration about no less than they ask.
fn judge(bench: &Bench, honest: &Certificate, text: &str, tally: &mut Tally) {
    let forged = Certificate::parse(text).unwrap();
    if bench.accepts(text, Asked::default()) {
        tally.alone += 1;
        assert_eq!(is_so(&forged), Ok(()), "accepted: {text}");
    }
    if !bench.accepts(text, bench.all()) {
        return;
    }
    tally.with_all += 1;
    assert_eq!(is_so(&forged), Ok(()), "accepted: {text}");
    assert_eq!(forged.source, honest.source, "accepted: {text}");
    assert_eq!(forged.display, honest.display, "accepted: {text}");
    // Widths may be others, as long as every x is answered the same; and a domain may reach further.
    let mut hardware = honest.specialised.clone();
    hardware.widths = forged.specialised.widths;
    hardware.domain = forged.specialised.domain.clone();
    assert_eq!(forged.specialised, hardware, "accepted: {text}");
    let mut pairs = forged.parts.iter().zip(&honest.parts);
    let covers = pairs.all(|(forged, honest)| forged.n == honest.n && forged.least <= honest.least);
    assert!(covers && forged.parts.len() == honest.parts.len(), "accepted: {text}");
}

#[test]
fn no_altered_certificate_is_accepted_unless_it_is_so() {
    let bench = Bench::new();
    let mut random = ChaCha8Rng::seed_from_u64(14);
    let mut tally = Tally::default();
    for (index, honest) in bench.certificates.iter().enumerate() {
        assert!(bench.accepts(honest, bench.all()) && bench.accepts(honest, Asked::default()));
        let told = Certificate::parse(honest).unwrap();
        assert_eq!(is_so(&told), Ok(()));
        for round in 0.. {
            if tally.forged == (index + 1) * alterations() {
                break;
            }
            let text = altered(honest, round, &mut random);
            // Without a seal of its own every one is refused.
            assert!(text == *honest || !bench.accepts(&text, Asked::default()), "{text}");
            match sealed_with_words(&text) {
                None => tally.unreadable += 1,
                Some(text) if text == *honest => {}
                Some(text) => {
                    tally.forged += 1;
                    judge(&bench, &told, &text, &mut tally);
                }
            }
        }
    }
    println!(
        "{} forgeries, sealed, beside {} texts that are no certificates: {} accepted without scene and configuration, \
         {} with them; each says what is so",
        tally.forged, tally.unreadable, tally.alone, tally.with_all
    );
    assert_eq!(tally.forged, bench.certificates.len() * alterations());
    assert!(tally.alone > 0, "some alterations leave it true");
}

/// An honest certificate about something else: what the user gives decides what it must be about.
#[test]
fn a_true_certificate_about_something_else_is_refused() {
    let bench = Bench::new();
    let scene = &bench.scene;
    let rows = rows(&bench.source, &demands(scene)).unwrap();
    let bar = AtomicU64::new(0);
    let small = derive(&bench.source, &rows, &scene.name).unwrap();
    let display = |bits, transfer| Display { bits, transfer };
    let made = |name: &str, display, allowed, specialised: &Design| {
        let found = certify(&bench.source, specialised, &rows, display, allowed, &bar).unwrap();
        Certificate::new(name, "", display, found, (&bench.source, specialised)).to_json()
    };
    let usual = display(8, Transfer::Srgb);
    assert!(bench.accepts(&made("two_balls", usual, Some(0), &small), bench.all()));
    // Another display, transfer curve or scene: true, and not about this scene.
    for (name, display) in [
        ("two_balls", display(12, Transfer::Srgb)),
        ("two_balls", display(10, Transfer::Srgb)),
        ("two_balls", display(8, Transfer::Linear)),
    ] {
        let text = made(name, display, Some(2), &small);
        assert!(bench.accepts(&text, Asked::default()), "it is true");
        assert!(!bench.accepts(&text, Asked { scene: Some(scene), ..Asked::default() }));
    }
    let other = made("three_balls", usual, None, &small);
    assert!(!bench.accepts(&other, bench.all()));
    // Another source than the one asked for, even of the same name.
    let honest = &bench.certificates[0];
    let mut source = bench.source.config().clone();
    source.error_budget_ulp += 1.0;
    assert!(!bench.accepts(honest, Asked { source: Some(&source), ..Asked::default() }));
    // More codes than the user allows.
    let codes = &bench.certificates[1];
    let Proved::Codes { greatest, .. } = Certificate::parse(codes).unwrap().proved else { panic!("it is about codes") };
    assert!(greatest > 0, "fewer output bits change codes");
    for (most, accepted) in [(greatest, true), (greatest - 1, false)] {
        assert_eq!(bench.accepts(codes, Asked { codes: Some(most), ..Asked::default() }), accepted);
    }
}

/// Hardware that is not the source with parts left out, however many codes are allowed.
#[test]
fn other_hardware_is_refused_whatever_it_allows() {
    let bench = Bench::new();
    let rows = rows(&bench.source, &demands(&bench.scene)).unwrap();
    let small = derive(&bench.source, &rows, &bench.scene.name).unwrap();
    let display = Display { bits: 8, transfer: Transfer::Srgb };
    for (from, to) in [("\"hermite\"", "\"three_point\""), ("\"UQ1.8\"", "\"UQ1.9\""), ("\"q\": 0.5", "\"q\": 0.4")] {
        let mut json = small.config().to_json();
        assert!(json.contains(from), "{from} in {json}");
        json = json.replace(from, to);
        let mut config = Config::from_json(&json).unwrap();
        config.widths = hw_model::widths::StatedWidths::default();
        let Ok(other) = Design::new(config) else { continue };
        let bar = AtomicU64::new(0);
        let Ok(found) = certify(&bench.source, &other, &rows, display, Some(255), &bar) else {
            continue;
        };
        let text = Certificate::new(&bench.scene.name, "", display, found, (&bench.source, &other)).to_json();
        assert!(!bench.accepts(&text, Asked::default()), "{from} became {to}");
    }
}

/// What a certificate says of its display is not a size to be believed.
#[test]
fn a_display_that_no_scene_has_is_refused_before_the_work() {
    let bench = Bench::new();
    for bits in [0, 1, 7, 9, 16, 31, 32, 4_294_967_295_u32] {
        let text = bench.certificates[1].replace("\"bits\": 8", &format!("\"bits\": {bits}"));
        let text = sealed(&text).expect("it is a certificate");
        let refused = check(&text, Asked::default(), &AtomicU64::new(0)).unwrap_err();
        assert!(refused.to_string().contains("a scene has 8, 10 or 12"), "{refused}");
    }
}
