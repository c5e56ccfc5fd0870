//! `blysk certify`: rigorous bounds, and certificates.

mod page;
pub(super) mod print;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::{ArgGroup, Args as ClapArgs};
use hw_model::config::Config;
use hw_model::design::Design;
use hw_model::exponents::Exponents;
use hw_model::fit::{Levels, Method};
use rayon::prelude::*;
use vectors::WholeFile;
use vectors::text_file::{self, CERTIFICATE};

use super::bar::Bar;
use super::configuration::MaybeConfiguration;
use super::methods::Methods;
use super::out::{Out, Outcome};
use super::output;
use super::report::bound;
use super::table::{Format, write_folded};
use analysis::hardware_claim::certify_hardware;
use bounds::certify::certificate::{Certificate, Claim};
use bounds::certify::check::{Checked, check};
use bounds::certify::claim::{Claims, Stretch, subjects};
use bounds::certify::hardware::points;
use bounds::certify::search::{claim_every_exponent, claim_exponent};
use bounds::seal::identity;
use vectors::progress::Progress;

/// Enclose the greatest error rigorously, and write or check a certificate of it.
///
/// Methods with real coefficients, by interval arithmetic: max |f - x^n| and max |f/x^n - 1| over every real
/// x of a region lie between two numbers 10^-6 apart (relative; wider beside an n where the error vanishes,
/// such as 3.0001 for hermite), for each exponent (--exponents) or for every real n >= 1 at once (--all-real-n).
/// The regions are the epicentre, x^n >= Q, and for rational, composite and schlick also the tail, x^n <= Q, where
/// the relative error has no bound. The greater of both errors is the error on all of [0, 1].
///
/// Configurations (--preset, --config), by exhaustion: every representable x of every row.
///
/// --check checks a certificate without the search. Exit status: 0 done, accepted; 1 a bound is exceeded, or the
/// certificate is refused; 2 an error.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk certify --method all --exponents 1..=64\n          \
                        blysk certify --all-real-n --bound 0.00555 --out hermite.json\n          \
                        blysk certify --check hermite.json\n          \
                        blysk certify --config mine.json --out mine-certificate.json")]
pub(super) struct Args {
    #[command(flatten)]
    subject: Subject,
    #[arg(long, value_name = "METHOD", conflicts_with_all = ["preset", "config", "check"], help = help_of_method())]
    method: Option<Methods>,
    /// Q, the level where the epicentre ends.
    #[arg(long, default_value_t = Levels::default().q(), conflicts_with_all = ["preset", "config", "check"])]
    q: f64,
    /// G, the lower level of three_point.
    #[arg(long, default_value_t = Levels::default().g(), conflicts_with_all = ["preset", "config", "check"])]
    g: f64,
    /// Exit with status 1 unless the absolute error on the epicentre is proved to be at most this.
    #[arg(long, value_parser = bound)]
    bound: Option<f64>,
    /// Write the certificate, a JSON file; - is standard output, which then has nothing else.
    #[arg(long, value_name = "FILE", conflicts_with = "check")]
    out: Option<PathBuf>,
    /// Write the bounds as a page of HTML, in one file, with their plot.
    #[arg(long, value_name = "FILE", conflicts_with = "check")]
    html: Option<PathBuf>,
    /// What to print: a summary (table), or every row (csv, json).
    #[arg(long, value_enum, default_value_t, conflicts_with = "check")]
    format: Format,
}

#[derive(ClapArgs)]
#[command(group(ArgGroup::new("what").args(["exponents", "all_real_n", "preset", "config", "check"])
    .required(true).multiple(true)))]
struct Subject {
    /// Methods at these exponents, such as 1..=256, 1,2,8,64 or 2.5,1e6.
    #[arg(long, allow_hyphen_values = true, value_name = "LIST",
          conflicts_with_all = ["all_real_n", "preset", "config", "check"])]
    exponents: Option<Exponents>,
    /// Methods at every real n >= 1, the limit included, on the epicentre.
    #[arg(long, conflicts_with_all = ["preset", "config", "check"])]
    all_real_n: bool,
    #[command(flatten)]
    configuration: MaybeConfiguration,
    /// Check this certificate. What it is about is printed; say --preset or --config to demand a configuration.
    #[arg(long, value_name = "FILE")]
    check: Option<PathBuf>,
}

fn help_of_method() -> String {
    format!("{}, or all [default: hermite with --all-real-n, else all].", Method::list())
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    if let Some(path) = &args.subject.check {
        let asked = args.subject.configuration.config()?;
        return check_file(path, asked.as_ref(), args.bound, out);
    }
    if args.bound.is_some() && !args.has_epicentre() {
        bail!("--bound is about the epicentre, and rational is made for the tail; choose another method");
    }
    // Made before the work, so that an unwritable place is found at once.
    let file = output::file(args.out.as_ref(), &args.subject.configuration.files())?;
    let page_file = output::file(args.html.as_ref(), &args.subject.configuration.files())?;
    if file.as_ref().is_some_and(WholeFile::is_standard_output)
        && page_file.as_ref().is_some_and(WholeFile::is_standard_output)
    {
        bail!("--out - and --html -: standard output has one of them; give the other a file");
    }
    let claim = claim(args)?;
    let certificate = Certificate::new(claim);
    let judged = args.bound.map(|bound| (bound, is_proved(bound, certificate.claim())));
    let page = page_file.is_some().then(|| page::page(&certificate, judged, args.command())).transpose()?;
    let alone = output::fill(file, certificate.to_json())? | output::fill(page_file, page.unwrap_or_default())?;
    if !alone {
        print::claim(certificate.claim(), args.format, out)?;
    }
    if let (Some(path), Format::Table, false) = (&args.out, args.format, alone) {
        writeln!(out, "\nwritten to {}", path.display())?;
    }
    if let (Some(path), Format::Table, false) = (&args.html, args.format, alone) {
        writeln!(out, "page: {}", path.display())?;
    }
    match args.bound {
        // In csv and json only the exit status says it.
        Some(bound) if alone => verdict(bound, certificate.claim(), Format::Json, out),
        Some(bound) => verdict(bound, certificate.claim(), args.format, out),
        None => Ok(Outcome::Good),
    }
}

impl Args {
    /// The command, without the places of its files.
    fn command(&self) -> String {
        let Subject { exponents, all_real_n, configuration, .. } = &self.subject;
        let mut command = format!("blysk certify {}", configuration.option()).trim_end().to_owned();
        if let Some(methods) = &self.method {
            let one = |methods: &[Method]| match methods {
                [method] => method.to_string(),
                _ => "all".to_owned(),
            };
            command.push_str(&format!(" --method {}", one(&methods.0)));
        }
        if let Some(exponents) = exponents {
            command.push_str(&format!(" --exponents {exponents}"));
        }
        if *all_real_n {
            command.push_str(" --all-real-n");
        }
        if let Some(bound) = self.bound {
            command.push_str(&format!(" --bound {bound}"));
        }
        command + " --html"
    }

    /// Whether anything is claimed of an epicentre. A preset or configuration has one.
    fn has_epicentre(&self) -> bool {
        let made_for = |&method: &Method| Stretch::of(method).contains(&Stretch::Epicentre);
        self.method.as_ref().is_none_or(|methods| methods.0.iter().any(made_for))
    }
}

fn claim(args: &Args) -> anyhow::Result<Claim> {
    let Subject { exponents, all_real_n, configuration, .. } = &args.subject;
    if let Some(design) = configuration.design()? {
        return hardware(design);
    }
    let levels = Levels::new(args.q, args.g)?;
    if *all_real_n {
        return every_exponent(args.method.as_ref(), levels);
    }
    // clap demands one of them.
    let exponents = exponents.as_ref().context("say --exponents, --all-real-n, --preset or --config")?;
    let methods = args.method.as_ref().map_or(&Method::ALL[..], |methods| &methods.0);
    let pairs = subjects(methods, exponents);
    let bar = Bar::counting(Some(pairs.len() as u64), "claims");
    let claims = pairs
        .into_par_iter()
        .map(|(method, region, exponent)| {
            let claim = claim_exponent(method, exponent, region, levels)
                .with_context(|| format!("{method}, n = {exponent}, {}", region.name()));
            bar.advance(1);
            claim
        })
        .collect::<Result<_, _>>()?;
    bar.finish();
    Ok(Claim::Exponents(Claims { levels, claims }))
}

/// A tail reaches to x = 0 for every n, and has no bounded box: epicentres only.
fn every_exponent(methods: Option<&Methods>, levels: Levels) -> anyhow::Result<Claim> {
    let methods = methods.map_or(&[Method::Hermite][..], |methods| &methods.0);
    let formula = |&&method: &&Method| Stretch::has_formula_of_n(method);
    let chosen: Vec<Method> = methods.iter().filter(formula).copied().collect();
    anyhow::ensure!(
        !chosen.is_empty(),
        "--all-real-n: rational is made for the tail and not for the epicentre, and minimax has no formula in \
         n; choose another method"
    );
    let claims = chosen
        .into_par_iter()
        .map(|method| claim_every_exponent(method, levels).with_context(|| method.to_string()))
        .collect::<Result<_, _>>()?;
    Ok(Claim::EveryExponent(Claims { levels, claims }))
}

fn hardware(design: Design) -> anyhow::Result<Claim> {
    let bar = Bar::new(Some(points(&design)?));
    let claim = certify_hardware(&design, &bar)?;
    bar.finish();
    Ok(Claim::Hardware(Box::new(claim)))
}

/// Whether every absolute error on an epicentre is within the bound.
fn is_proved(bound: f64, claim: &Claim) -> bool {
    let greatest = match claim {
        Claim::Exponents(Claims { claims, .. }) => claims
            .iter()
            .filter(|claim| claim.region == Stretch::Epicentre)
            .map(|claim| claim.absolute.upper())
            .reduce(f64::max),
        Claim::EveryExponent(Claims { claims, .. }) => claims.iter().map(|claim| claim.absolute.upper).reduce(f64::max),
        Claim::Hardware(claim) => Some(claim.epicentre.upper),
    };
    // A claim about no epicentre proves nothing of one.
    greatest.is_some_and(|greatest| greatest <= bound)
}

/// Says whether the bound is proved.
fn verdict(bound: f64, claim: &Claim, format: Format, out: &mut Out) -> anyhow::Result<Outcome> {
    let holds = is_proved(bound, claim);
    if format == Format::Table {
        let said = if holds { "proved" } else { "NOT PROVED" };
        let about = claim.epicentres();
        write_folded(out, &format!("absolute error on the epicentre at most {bound}: {said} ({about})"))?;
    }
    Ok(if holds { Outcome::Good } else { Outcome::Fails })
}

/// What was accepted is shown in full: a certificate of [0, 9] is as true as one of a narrow interval.
fn check_file(path: &Path, asked: Option<&Config>, bound: Option<f64>, out: &mut Out) -> anyhow::Result<Outcome> {
    let shown = path.display();
    let text = text_file::read(path, CERTIFICATE)?;
    let certificate = Certificate::parse(&text).with_context(|| shown.to_string())?;
    let (about, work) = match certificate.claim() {
        Claim::Hardware(claim) => (Some(&claim.configuration), Some(claim.points)),
        _ => (None, None),
    };
    if let Some(refused) = asked.and_then(|asked| not_about(about, asked)) {
        write_folded(out, &format!("REFUSED {refused}"))?;
        return Ok(Outcome::Fails);
    }
    let bar = Bar::new(work);
    let result = check(&certificate, &text, &bar);
    bar.finish();
    match result {
        Ok(checked) => {
            write_folded(out, certificate.statement())?;
            writeln!(out)?;
            print::claim(certificate.claim(), Format::Table, out)?;
            writeln!(out, "\nACCEPTED {}", looked_at(checked))?;
            if let (Some(about), None) = (about, asked) {
                write_folded(out, &identity(about))?;
            }
            match bound {
                Some(bound) => verdict(bound, certificate.claim(), Format::Table, out),
                None => Ok(Outcome::Good),
            }
        }
        Err(refused) => {
            write_folded(out, &format!("REFUSED {refused}"))?;
            Ok(Outcome::Fails)
        }
    }
}

/// Why the certificate is not about the configuration that was asked about.
fn not_about(about: Option<&Config>, asked: &Config) -> Option<String> {
    let name = &asked.name;
    match about {
        Some(about) if about == asked => None,
        Some(about) if about.name == *name => {
            Some(format!("configuration: it is about another configuration of the name {name}"))
        }
        Some(about) => Some(format!("configuration: it is about {}, not {name}", about.name)),
        None => Some(format!("it is about methods, and not about the configuration {name}")),
    }
}

fn looked_at(checked: Checked) -> String {
    let Checked { enclosures, boxes, points } = checked;
    if points > 0 {
        format!("{points} points, each through the data path")
    } else {
        format!("{enclosures} enclosures, {boxes} boxes, each with its own interval evaluation")
    }
}
