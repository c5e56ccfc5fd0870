//! `blysk specialise`: hardware for one scene, with a certificate.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::Args as ClapArgs;
use hw_model::design::Design;
use hw_model::names;
use vectors::rtl::Emission;
use vectors::{Bundle, BundleError, OutputSet, Strategy, rtl};

use super::bar::Bar;
use super::configuration::MaybeConfiguration;
use super::out::{Out, Outcome};
use super::output;
use super::scene::{Loaded, load};
use super::specialise_check::{COMMAND, CONFIGURATION, RTL, check};
use super::synthesis;
use super::table::{Cell, Format, Rows, write_folded};
use scenes::render::{RowFor, Samples, ScenePipeline, Which, Zone, samples};
use scenes::scene::Scene;
use scenes::specialise::{
    Asked, AskedRow, Certificate, Demand, Display, LeftOut, Proved, Served, demands, is_guarded, left_out,
    pixels_outside, points, reduce, rows, serve, served_rows, with_words,
};

/// Leave out of a configuration what a scene does not use, and prove that nothing is missed.
///
/// For each exponent the interval of x is bounded over every real place of the picture (not only its pixels), and
/// the parts that no x of the interval needs are left out: ROM words, the tail, clamps, bits of coefficients and
/// registers. The directory gets the smaller configuration.json, certificate.json, left_out.csv and .json, and in rtl
/// the hardware with testbench and vectors. The certificate says that over every (n, x) of the domain the answers are
/// the same bits, or with --allow-codes that they differ by at most that many display codes of the highlight at full
/// strength, in the scene's transfer curve; then the output has fewer bits and widths are derived anew. An x outside
/// the domain gives 0 and sets the status flag out_of_domain.
///
/// With --check, a certificate is checked: both configurations are built again and every x is tried again. The checker
/// believes nothing in a certificate. A scene is compared with the certificate's display and domain, --preset or
/// --config with its source, --allow-codes with the codes that it allows; a subject that was not given is named as not
/// checked. Exit status 1 says that a certificate does not hold.
#[derive(ClapArgs)]
#[command(after_help = "Examples: blysk specialise scene.json --preset paper --out small\n          \
                        blysk specialise scene.json --preset paper --check small/certificate.json")]
pub(super) struct Args {
    /// The scene, as JSON; docs/scenes has some to start from.
    #[arg(value_name = "SCENE", required_unless_present = "check")]
    scene: Option<PathBuf>,
    #[command(flatten)]
    configuration: MaybeConfiguration,
    /// Write the files to this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Allow answers that differ by up to this many display codes; without it they are the same bits. With --check,
    /// refuse a certificate that allows more.
    #[arg(long, value_name = "CODES")]
    allow_codes: Option<u16>,
    /// Let a row of the ROM serve exponents near its own, and take the fewest rows with which no highlight differs by
    /// more than --allow-codes from that by a row of its exponent. Exponents that the configuration has no word for get
    /// one to compare with, so that scenes of any materials can be specialised.
    #[arg(long, requires = "allow_codes", conflicts_with = "check")]
    nearest: bool,
    /// How many vectors the RTL's bundle has.
    #[arg(long, default_value_t = 4096)]
    count: u64,
    /// Seed of the random vectors.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Also synthesise both configurations for an ECP5 with Yosys, and count their cells; scripts/synth.py --config
    /// measures f_max. The directory gets source_rtl as well.
    #[arg(long, requires = "out")]
    synth: bool,
    /// Check this certificate instead.
    #[arg(long, value_name = "CERTIFICATE", conflicts_with_all = ["out", "synth"])]
    check: Option<PathBuf>,
    /// How to print what was left out.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// The files of a set; hardware has directories of its own.
const CERTIFICATE: &str = "certificate.json";
const LEFT_OUT: [(&str, Format); 2] = [("left_out.csv", Format::Csv), ("left_out.json", Format::Json)];
const SOURCE_RTL: &str = "source_rtl";

impl Args {
    /// The names of the files, as far as they are known before the work.
    fn names(&self) -> impl Iterator<Item = String> {
        let hardware = [RTL].into_iter().chain(self.synth.then_some(SOURCE_RTL));
        let hardware =
            hardware.flat_map(|directory| hardware_names().into_iter().map(move |name| format!("{directory}/{name}")));
        let tables = LEFT_OUT.map(|(name, _)| name);
        let own = [CONFIGURATION, CERTIFICATE].into_iter().chain(tables).map(str::to_owned);
        own.chain(hardware)
    }

    /// What made the files, and not where they went.
    fn command(&self) -> String {
        let scene = self.scene.as_ref().and_then(|path| path.file_name()).unwrap_or_default();
        let codes = self.allow_codes.map_or_else(String::new, |codes| format!(" --allow-codes {codes}"));
        let nearest = if self.nearest { " --nearest" } else { "" };
        let Self { count, seed, .. } = self;
        format!(
            "blysk specialise {} {}{codes}{nearest} --count {count} --seed {seed}",
            names::shell(scene),
            self.configuration.option()
        )
    }
}

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let loaded = args.scene.as_ref().map(|path| load(path)).transpose()?;
    if let Some(path) = &args.check {
        let (scene, source) = (loaded.as_ref().map(|loaded| &loaded.scene), args.configuration.config()?);
        return check(Asked { scene, source: source.as_ref(), codes: args.allow_codes }, path, out);
    }
    let Some(Loaded { scene, files }) = loaded else { bail!("give a scene") };
    let Some(source) = args.configuration.design()? else {
        bail!("say --preset NAME or --config FILE");
    };
    // Before the work, and not after it.
    Bundle::check_count(Strategy::Mixed, args.count)?;
    let inputs = [files, args.configuration.files()].concat();
    let begin = |out| output::set(out, COMMAND, &inputs, args.names());
    let set = args.out.as_deref().map(begin).transpose()?;
    let demands = demands(&scene);
    let source = if args.nearest {
        let exponents = demands.iter().map(|demand| demand.exponent);
        Design::new(with_words(source.config(), exponents)?).context("with a word for each exponent of the scene")?
    } else {
        source
    };
    let mut made = Made::new(args, &scene, &source, demands)?;
    if let Some(set) = set {
        made.write(args, &source, set)?;
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
    rows: Vec<AskedRow>,
    guarded: bool,
    specialised: Design,
    certificate: Certificate,
    left_out: Vec<LeftOut>,
    pixels: Samples,
}

impl Made {
    fn new(args: &Args, scene: &Scene, source: &Design, demands: Vec<Demand>) -> anyhow::Result<Self> {
        let mut rows = rows(source, &demands)?;
        let points = points(source, &rows)?;
        let rays = u64::from(scene.image.width) * u64::from(scene.image.height);
        let bar = Bar::counting(Some(rays), "pixels");
        let pixels = samples(scene, &bar);
        bar.finish();
        if let Some((exponent, x)) = pixels_outside(scene, &pixels, &demands) {
            bail!(
                "a pixel presents x = {x} with n = {exponent}, outside what was bounded: the scene is too far \
                 away for f64; bring camera, surfaces and lights nearer to each other"
            );
        }
        let display = Display { bits: scene.image.display_bits, transfer: scene.image.transfer };
        if let (true, Some(codes)) = (args.nearest, args.allow_codes) {
            let bar = Bar::new(None);
            rows = served_rows(source, &demands, &serve(source, &rows, display, codes, &bar))?;
            bar.finish();
        }
        // With fewer codes allowed to be told apart there is a pass for each width of the output, at most.
        let passes = match args.allow_codes {
            Some(_) => u64::from(source.config().output.fraction_bits()),
            None => 1,
        };
        let bar = Bar::new(Some(points * passes));
        let (specialised, found) = reduce(source, &rows, &scene.name, display, args.allow_codes, &bar)?;
        bar.finish();
        let certificate = Certificate::new(&scene.name, &args.command(), display, found, (source, &specialised));
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

    fn write(&mut self, args: &Args, source: &Design, mut set: OutputSet) -> anyhow::Result<()> {
        set.within(RTL, |set| hardware(&self.specialised, args, set))?;
        set.within(SOURCE_RTL, |set| {
            // Of another source, it would not be what this was made of.
            hardware_names().iter().for_each(|name| set.obsolete(name));
            if args.synth { hardware(source, args, set) } else { Ok(()) }
        })?;
        if args.synth {
            self.synthesise(source)?;
        }
        set.write(CONFIGURATION, self.specialised.config().to_json())?;
        for (name, format) in LEFT_OUT {
            let mut text = Vec::new();
            self.table().print(&mut text, format, 6)?;
            set.write(name, text)?;
        }
        // It vouches for the rest.
        set.seal(CERTIFICATE, self.certificate.to_json())?;
        set.commit()?;
        Ok(())
    }

    /// What Yosys counts joins what was left out.
    fn synthesise(&mut self, source: &Design) -> anyhow::Result<()> {
        let before = synthesis::counts(source)?;
        let after = synthesis::counts(&self.specialised)?;
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
        if args.nearest {
            self.served(scene).print(out, Format::Table, 6)?;
            writeln!(out)?;
        }
        self.table().print(out, Format::Table, 6)?;
        writeln!(out)?;
        let proved = match self.certificate.proved {
            Proved::BitIdentical => "bit-identical".to_owned(),
            Proved::Codes { allowed: 1, .. } => "within 1 display code".to_owned(),
            Proved::Codes { allowed, .. } => format!("within {allowed} display codes"),
        };
        let said = &self.certificate.statement;
        write_folded(out, &format!("proved {proved} over {} points: {said}", self.certificate.points()))?;
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
        let served: Vec<(f64, f64)> = self.rows.iter().map(|row| (row.demand.exponent, row.serving)).collect();
        let pipeline = ScenePipeline::with_rows(&self.specialised, scene, RowFor::Served(&served))?;
        let answers = pipeline.answers(&self.pixels, Which::Needed);
        let all = answers.parts.len() as u64;
        let away = answers.parts.iter().filter(|&&part| part == Zone::FacesAway).count() as u64;
        Ok(format!(
            "Software sends {} of the {all} samples of the picture: {away} face away, and {} lie below a cut where \
             zero answers. blysk render measures the time that this saves.",
            answers.requests,
            all - away - answers.requests
        ))
    }

    /// Which row serves each material, and by how many display codes that differs from a row of its own.
    fn served(&self, scene: &Scene) -> Rows {
        let mut table = Rows::new(&["material", "n", "row", "codes"]);
        for material in &scene.materials {
            let n = material.exponent;
            let place = self.rows.iter().position(|row| row.demand.exponent == n);
            let served = place.and_then(|place| self.certificate.parts.get(place)?.served);
            let own = place.map(|_| Served { row: n, codes: 0 });
            let (row, codes) = match served.or(own) {
                Some(Served { row, codes }) => (Cell::Exponent(row), Cell::Integer(codes.into())),
                None => ("not seen in any light".into(), "-".into()),
            };
            table.push(vec![material.name.as_str().into(), Cell::Exponent(n), row, codes]);
        }
        table
    }

    /// What the scene asks.
    fn asked(&self) -> Rows {
        let ulp = self.specialised.config().input.ulp();
        let mut table = Rows::new(&["n", "least x", "greatest x", "cut", "below it", "address", "was"]);
        let exponents = self.specialised.rom().exponents();
        for (row, demand) in self.rows.iter().zip(&self.demands) {
            let below = if row.least >= row.cut { "nothing" } else { "asked" };
            table.push(vec![
                Cell::Exponent(demand.exponent),
                demand.least.into(),
                demand.greatest.into(),
                (row.cut as f64 * ulp).into(),
                below.into(),
                Cell::Integer(exponents.position(row.serving).unwrap_or_default() as i64),
                Cell::Integer(row.address.into()),
            ]);
        }
        table
    }
}

/// The names of the files of [`hardware`].
fn hardware_names() -> Vec<String> {
    rtl::names(&Emission::default(), Strategy::Mixed)
}

/// The RTL of a design with its testbench and vectors.
fn hardware(design: &Design, args: &Args, set: &mut OutputSet) -> Result<(), BundleError> {
    let command = args.command();
    let bundle = Bundle::new(design, Strategy::Mixed, args.count, args.seed, &command)?;
    rtl::stage(&bundle, &Emission::default(), &command, set).map(drop)
}
