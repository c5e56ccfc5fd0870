//! `blysk specialise`: hardware for one scene, with a certificate.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args as ClapArgs;
use hw_model::design::Design;
use hw_model::rtl::TOP;
use vectors::{Bundle, OutputSet, Strategy, rtl};

use super::configuration::{MaybeConfiguration, quoted};
use super::report::Bar;
use super::scene::load;
use super::synthesis;
use super::table::{Cell, Format, Rows, write_folded};
use super::{Out, Outcome};
use crate::render::{Part, Pipeline, Samples, Which, samples};
use crate::scene::Scene;
use crate::specialise::{
    self, Asked, Certificate, Demand, Display, Held, LeftOut, Proved, Row, demands, is_guarded,
    left_out, pixels_outside, reduce, rows,
};

/// Leave out of a configuration what a scene does not use, and prove that nothing is missed.
///
/// For each exponent the interval of x is bounded over every real place of the picture (not only its pixels), and
/// what no x of it needs is left out: ROM words, the tail, clamps, bits of coefficients and registers. The directory
/// gets the smaller configuration.json, certificate.json, left_out.csv and .json, and in rtl its hardware with
/// testbench and vectors. The certificate says that over every (n, x) of the domain the answers are the same
/// bits, or with --allow-codes that they differ by at most so many display codes of the highlight at full strength,
/// in the scene's curve; then the output has fewer bits and widths are derived anew. An x outside the domain gives 0
/// and sets the status flag out_of_domain. With --check, a certificate is checked: both configurations are built
/// again and every x is tried again. Nothing in it is believed: with a scene, its display and its demands are held
/// against it, with --preset or --config the configuration that it is about, with --allow-codes the most codes that
/// answers may differ by; what was not given is named. Exit status 1 says that a certificate does not hold.
#[derive(ClapArgs)]
#[command(
    after_help = "Examples: blysk specialise scene.json --preset paper --out small\n          \
                        blysk specialise scene.json --preset paper --check small/certificate.json"
)]
pub(super) struct Args {
    /// The scene, as JSON; docs/scenes has some to start from.
    #[arg(value_name = "SCENE", required_unless_present = "check")]
    scene: Option<PathBuf>,
    #[command(flatten)]
    configuration: MaybeConfiguration,
    /// Write the files to this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Allow answers that differ by up to this many display codes; without it they are the same bits. With --check, refuse
    /// a certificate of more.
    #[arg(long, value_name = "CODES")]
    allow_codes: Option<u16>,
    /// How many vectors.
    #[arg(long, default_value_t = 4096)]
    count: u64,
    /// Seed of the random ones.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Also synthesise both for an ECP5 with Yosys, and count; f_max is measured by scripts/synth.py --config. The
    /// directory gets source_rtl as well.
    #[arg(long, requires = "out")]
    synth: bool,
    /// Check this certificate instead.
    #[arg(long, value_name = "CERTIFICATE", conflicts_with_all = ["out", "synth"])]
    check: Option<PathBuf>,
    /// How to print what was left out.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl Args {
    /// What made the files, and not where they went.
    fn command(&self) -> String {
        let scene = self.scene.as_ref().and_then(|path| path.file_name()).unwrap_or_default();
        let codes =
            self.allow_codes.map_or_else(String::new, |codes| format!(" --allow-codes {codes}"));
        let Self { count, seed, .. } = self;
        format!(
            "blysk specialise {} {}{codes} --count {count} --seed {seed}",
            quoted(&scene.to_string_lossy()),
            self.configuration.option()
        )
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let scene = args.scene.as_ref().map(|path| load(path)).transpose()?;
    if let Some(path) = &args.check {
        return check(args, path, scene.as_ref(), out);
    }
    let Some(scene) = scene else { bail!("give a scene") };
    let Some(source) = args.configuration.design()? else {
        bail!("say --preset NAME or --config FILE");
    };
    let mut made = Made::new(args, &scene, &source)?;
    if let Some(directory) = &args.out {
        made.write(args, &source, directory)?;
    }
    match args.format {
        Format::Table => made.print(args, &scene, out)?,
        format => made.table().print(out, format, 6)?,
    }
    Ok(Outcome::Good)
}

/// What was made for a scene.
struct Made {
    demands: Vec<Demand>,
    rows: Vec<Row>,
    guarded: bool,
    specialised: Design,
    certificate: Certificate,
    left_out: Vec<LeftOut>,
    pixels: Samples,
}

impl Made {
    fn new(args: &Args, scene: &Scene, source: &Design) -> anyhow::Result<Self> {
        let demands = demands(scene);
        let rows = rows(source, &demands)?;
        let pixels = samples(scene, &std::sync::atomic::AtomicU64::new(0));
        if let Some((exponent, x)) = pixels_outside(scene, &pixels, &demands) {
            bail!(
                "a pixel presents x = {x} with n = {exponent}, outside what was bounded: the scene is too far \
                 away for f64; bring camera, surfaces and lights nearer to each other"
            );
        }
        let display = Display { bits: scene.image.display_bits, transfer: scene.image.transfer };
        let bar = Bar::new(None);
        let (specialised, found) =
            reduce(source, &rows, &scene.name, display, args.allow_codes, &bar)?;
        bar.finish();
        let certificate =
            Certificate::new(&scene.name, &args.command(), display, found, (source, &specialised));
        Ok(Self {
            guarded: is_guarded(source, &rows),
            left_out: left_out(source, &specialised, &rows),
            demands,
            rows,
            specialised,
            certificate,
            pixels,
        })
    }

    fn table(&self) -> Rows {
        let mut table = Rows::new(&["part", "before", "after", "saved", "why"]);
        for LeftOut { part, before, after, why } in &self.left_out {
            let (before, after) = (*before as i64, *after as i64);
            let numbers = [before, after, before - after].map(Cell::Integer);
            let mut cells = vec![Cell::from(part.as_str())];
            cells.extend(numbers);
            cells.push(why.as_str().into());
            table.push(cells);
        }
        table
    }

    fn write(&mut self, args: &Args, source: &Design, directory: &Path) -> anyhow::Result<()> {
        let mut set = OutputSet::create(directory)?;
        hardware(&self.specialised, args, &directory.join("rtl"))?;
        if args.synth {
            hardware(source, args, &directory.join("source_rtl"))?;
            self.synthesise(directory)?;
        }
        set.write("configuration.json", self.specialised.config().to_json())?;
        for (name, format) in [("left_out.csv", Format::Csv), ("left_out.json", Format::Json)] {
            let mut text = Vec::new();
            self.table().print(&mut text, format, 6)?;
            set.write(name, text)?;
        }
        // It vouches for the rest.
        set.write("certificate.json", self.certificate.to_json())?;
        set.commit()?;
        Ok(())
    }

    /// What Yosys counts joins what was left out.
    fn synthesise(&mut self, directory: &Path) -> anyhow::Result<()> {
        let before = synthesis::counts(&directory.join("source_rtl"))?;
        let after = synthesis::counts(&directory.join("rtl"))?;
        for (name, (before, after)) in synthesis::NAMES.iter().zip(before.into_iter().zip(after)) {
            let why = "Yosys, synth_ecp5, without pins".to_owned();
            self.left_out.push(LeftOut { part: (*name).to_owned(), before, after, why });
        }
        Ok(())
    }

    fn print(&self, args: &Args, scene: &Scene, out: &mut Out) -> anyhow::Result<()> {
        let name = &self.specialised.config().name;
        write_folded(out, &format!("{}: {name}", scene.name))?;
        writeln!(out)?;
        self.asked().print(out, Format::Table, 7)?;
        writeln!(out)?;
        self.table().print(out, Format::Table, 6)?;
        writeln!(out)?;
        let proved = match self.certificate.proved {
            Proved::BitIdentical => "bit-identical".to_owned(),
            Proved::Codes { allowed: 1, .. } => "within 1 display code".to_owned(),
            Proved::Codes { allowed, .. } => format!("within {allowed} display codes"),
        };
        let said = &self.certificate.statement;
        write_folded(
            out,
            &format!("proved {proved} over {} points: {said}", self.certificate.points()),
        )?;
        write_folded(out, self.guard())?;
        write_folded(out, &self.software(scene)?)?;
        if let Some(directory) = &args.out {
            let source = if args.synth { ", source_rtl" } else { "" };
            let said = "configuration.json, certificate.json, left_out.csv, left_out.json, rtl";
            write_folded(out, &format!("written to {}: {said}{source}", directory.display()))?;
        }
        Ok(())
    }

    const fn guard(&self) -> &'static str {
        if self.guarded {
            "An x below the domain gives 0 and sets out_of_domain. Stalls stay: what takes the results is not \
             part of a scene."
        } else {
            "Every x from 0 to 1 is answered as before, so there is no x to refuse. Stalls stay: what takes \
             the results is not part of a scene."
        }
    }

    /// What software leaves out before the hardware.
    fn software(&self, scene: &Scene) -> anyhow::Result<String> {
        let answers = Pipeline::new(&self.specialised, scene)?.answers(&self.pixels, Which::Needed);
        let all = answers.parts.len() as u64;
        let away = answers.parts.iter().filter(|&&part| part == Part::FacesAway).count() as u64;
        Ok(format!(
            "Software sends {} of the {all} samples of the picture: {away} face away, and {} lie below a cut where zero \
             answers. blysk render measures the time that this saves.",
            answers.requests,
            all - away - answers.requests
        ))
    }

    /// What the scene asks.
    fn asked(&self) -> Rows {
        let ulp = self.specialised.config().input.ulp();
        let mut table = Rows::new(&[
            "n",
            "least x",
            "greatest x",
            "cut",
            "below it",
            "address",
            "was",
            "bound",
        ]);
        for (index, (row, demand)) in self.rows.iter().zip(&self.demands).enumerate() {
            let below = if row.least >= row.cut { "nothing" } else { "asked" };
            table.push(vec![
                Cell::Exponent(demand.exponent),
                demand.least.into(),
                demand.greatest.into(),
                (row.cut as f64 * ulp).into(),
                below.into(),
                Cell::Integer(index as i64),
                Cell::Integer(row.address.into()),
                if demand.mesh { "a mesh: none" } else { "every place" }.into(),
            ]);
        }
        table
    }
}

/// The RTL of a design with its testbench and vectors.
fn hardware(design: &Design, args: &Args, directory: &Path) -> anyhow::Result<()> {
    let command = args.command();
    let bundle = Bundle::new(design, Strategy::Mixed, args.count, args.seed, &command)?;
    let mut set = OutputSet::create(directory)?;
    rtl::stage(&bundle, TOP, &command, &mut set)?;
    set.commit()?;
    Ok(())
}

fn check(
    args: &Args,
    path: &Path,
    scene: Option<&Scene>,
    out: &mut Out,
) -> anyhow::Result<Outcome> {
    let shown = path.display();
    let text =
        fs::read_to_string(path).with_context(|| format!("cannot read the certificate {shown}"))?;
    let source = args.configuration.config()?;
    let asked = Asked { scene, source: source.as_ref(), codes: args.allow_codes };
    let bar = Bar::new(None);
    let held = specialise::check(&text, asked, &bar);
    bar.finish();
    match held {
        Ok(Held { statement, not_checked }) => {
            write_folded(out, &format!("{shown} holds: {statement}"))?;
            for sentence in not_checked {
                write_folded(out, &sentence)?;
            }
            Ok(Outcome::Good)
        }
        Err(refused) => {
            write_folded(out, &format!("{shown} does not hold: {refused}"))?;
            Ok(Outcome::Fails)
        }
    }
}
