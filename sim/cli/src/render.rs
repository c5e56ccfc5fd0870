//! `blysk render`: a scene, every highlight of which is the pipeline's.

use std::io::Write;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use anyhow::Context;
use clap::{ArgGroup, Args as ClapArgs};
use rayon::prelude::*;

use super::bar::Bar;
use super::clock::{delays, delays_file};
use super::configuration::MaybeConfiguration;
use super::out::{Out, Outcome};
use super::output;
use super::picture_size::size;
use super::render_more::{designs, pipelines, print_compared, smoothed, square};
use super::scene::{Loaded, load, resized};
use super::table::{Cell, Format, Rows, counted, digits, write_folded};
use scenes::render::{
    Answers, Codes, Cycles, FrameClock, Picture, RowFor, Samples, ScenePipeline, Which, Zone, by_material, compare,
    difference, encode, heat_map, methods, reference, samples, shade, side_by_side,
};
use scenes::report::{self as files, RenderReport};
use scenes::scene::Scene;

/// Render a scene, every highlight through the pipeline, and compare it with x^n.
///
/// Spheres, planes and meshes are hit by one ray for each pixel; every x goes through the data path, bit for bit,
/// grouped by exponent, and is compared with x^n. With --out, the directory gets both pictures, a heat map of
/// their difference in display codes, the methods side by side, and the figures as render.csv and render.json. The
/// table has the samples (pixels times lights) of each material: on the epicentre, below it where polynomial or divider
/// answer, zero, facing away; and the greatest error of their highlights in display codes of linear light, before
/// colours and transfer curve. Software leaves out samples that face away or lie below the cut: the
/// highlights are computed with and without these samples, compared, and timed. Exit status: 0 when both are the same,
/// 1 when they differ, 2 for an error.
#[derive(ClapArgs)]
#[command(group(ArgGroup::new("hardware").args(["preset", "config", "compare"]).required(true).multiple(true)))]
#[command(after_help = "Examples: blysk render scene.json --preset paper --out pictures\n          \
                        blysk render scene.json --config mine.json --size 64x48 --format json")]
pub(super) struct Args {
    /// The scene, as JSON; docs/scenes has some to start from.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    #[command(flatten)]
    configuration: MaybeConfiguration,
    /// Presets beside the configuration, or instead of one: a table of what each makes of the scene and, with --out,
    /// compare.png with all of them side by side and their differences from x^n, compare.csv and compare.json.
    #[arg(long, value_name = "PRESET", value_delimiter = ',')]
    compare: Vec<String>,
    /// Write the files to this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The size of the picture in pixels, such as 1920x1080, instead of the scene's.
    #[arg(long, value_name = "SIZE", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Also write smooth.png, the pipeline's picture with this many samples in a pixel, a square number from 4 to 64:
    /// for looking at. Figures and the other pictures stay those of one sample in a pixel.
    #[arg(long, value_name = "COUNT", requires = "out", value_parser = square)]
    samples_per_pixel: Option<u32>,
    /// The end of the scale of difference.png and compare.png, in display codes, so that several pictures have the same
    /// one; without it the greatest difference that there is, four codes at least.
    #[arg(long, value_name = "CODES", requires = "out", value_parser = clap::value_parser!(u16).range(1..))]
    scale: Option<u16>,
    /// Answer for an exponent without a word in the ROM by the nearest that has one, by ratio. The comparison stays
    /// with x^n of the scene's own n, so that the column `linear codes` tells what each material pays.
    #[arg(long)]
    nearest: bool,
    /// The clock of the hardware, from which frames a second follow, in MHz; without it the one that the pipeline's own
    /// ranks of registers reach on the device, by the estimate of `blysk clock`.
    #[arg(long, value_name = "MHZ", value_parser = clock)]
    clock_mhz: Option<f64>,
    /// The device of that estimate: ecp5, up5k, or a JSON file with its delays in nanoseconds.
    #[arg(long, value_name = "NAME|FILE", default_value = "ecp5", conflicts_with = "clock_mhz")]
    device: String,
    /// How to print; csv and json are those of the files.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

fn clock(text: &str) -> Result<f64, String> {
    let clock = text.parse().ok().filter(|mhz| (1e-3..=1e6).contains(mhz));
    clock.ok_or_else(|| format!("{text:?} is no clock; use MHz from 0.001 to 1000000"))
}

/// Rounds of timing, in each of which both ways have a turn; the least time counts. A round that begins later than this
/// is left out.
const ROUNDS: u32 = 7;
const LATEST_ROUND: Duration = Duration::from_millis(400);

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let designs = designs(&args.configuration, &args.compare)?;
    let design = designs.first().context("say --preset NAME or --config FILE")?;
    let scene_name = || args.scene.display().to_string();
    let Loaded { mut scene, files: read } = load(&args.scene)?;
    resized(&mut scene, args.size)?;
    let clock = frame_clock(args)?;
    let rows = if args.nearest { RowFor::Nearest } else { RowFor::Exactly };
    let pipeline = ScenePipeline::with_rows(design, &scene, rows).with_context(scene_name)?;
    // Made before the work, so that an unwritable place is found at once.
    let delays = delays_file(&args.device).into_iter().collect();
    let inputs = [read, args.configuration.files(), delays].concat();
    let compared = if args.compare.is_empty() { Vec::new() } else { pipelines(&designs, &scene, rows)? };
    let mut more = if compared.is_empty() { Vec::new() } else { files::COMPARED.to_vec() };
    more.extend(args.samples_per_pixel.map(|_| files::SMOOTH));
    let names = files::PICTURES.iter().chain(&files::TABLES).chain(&more);
    let set = args.out.as_deref().map(|out| output::set(out, "render", &inputs, names)).transpose()?;
    let begun = Instant::now();
    let rays = u64::from(scene.image.width) * u64::from(scene.image.height);
    let bar = Bar::counting(Some(rays), "pixels");
    let samples = samples(&scene, &bar);
    bar.finish();
    let traced = begun.elapsed();
    let highlights = Highlights::new(&pipeline, &samples);
    let rendered = Rendered::new(&scene, &samples, &pipeline, &highlights);
    let rows_compared = compare(&scene, &samples, &compared, &clock);
    let report = report(&scene, &samples, &pipeline, &clock, &rendered, &highlights);
    if let Some(mut set) = set {
        let pictures = pictures(&scene, &samples, &pipeline, &rendered, args.scale)?;
        files::write(&mut set, &report, &pictures)?;
        if !compared.is_empty() {
            files::write_compared(&mut set, &rows_compared, &side_by_side(&scene, &samples, &compared, args.scale)?)?;
        }
        if let Some(side) = args.samples_per_pixel {
            set.write(files::SMOOTH, smoothed(&scene, design, rows, side)?)?;
        }
        set.commit()?;
    }
    match args.format {
        Format::Table => {
            print(&report, out)?;
            nearest(&scene, &pipeline, out)?;
            print_compared(&rows_compared, out)?;
            times(&highlights, traced, begun.elapsed(), out)?;
            if let Some(directory) = &args.out {
                let names = [&files::PICTURES[..], &files::TABLES, &more].concat().join(", ");
                write_folded(out, &format!("written to {}: {names}", directory.display()))?;
            }
        }
        Format::Csv => out.write_all(&report.csv()?)?,
        Format::Json => out.write_all(report.json()?.as_bytes())?,
    }
    Ok(if highlights.equal { Outcome::Good } else { Outcome::Fails })
}

/// The pipeline's answers, both ways.
struct Highlights {
    needed: Answers,
    every_requests: u64,
    equal: bool,
    /// Of every sample, and of those that need the pipeline.
    times: [Duration; 2],
}

impl Highlights {
    fn new(pipeline: &ScenePipeline<'_>, samples: &Samples) -> Self {
        let timed = |which| {
            let begun = Instant::now();
            let answers = pipeline.answers(samples, which);
            (answers, begun.elapsed())
        };
        let begun = Instant::now();
        let (every, mut first) = timed(Which::Every);
        let (needed, mut second) = timed(Which::Needed);
        for _ in 1..ROUNDS {
            if begun.elapsed() > LATEST_ROUND {
                break;
            }
            first = first.min(timed(Which::Every).1);
            second = second.min(timed(Which::Needed).1);
        }
        let equal = every.intensities == needed.intensities && every.parts == needed.parts;
        Self { needed, every_requests: every.requests, equal, times: [first, second] }
    }
}

/// Both pictures, and the highlights in them.
struct Rendered {
    highlights: Vec<f64>,
    ideal: Vec<f64>,
    pipeline: Picture,
    reference: Picture,
}

impl Rendered {
    fn new(scene: &Scene, samples: &Samples, pipeline: &ScenePipeline<'_>, highlights: &Highlights) -> Self {
        let codes = Codes::new(&scene.image);
        let ideal = reference(scene, samples);
        let highlights = pipeline.highlights(&highlights.needed);
        Self {
            pipeline: shade(scene, samples, &codes, &highlights),
            reference: shade(scene, samples, &codes, &ideal),
            highlights,
            ideal,
        }
    }
}

/// The stated clock, or the device to estimate it for.
fn frame_clock(args: &Args) -> anyhow::Result<FrameClock> {
    Ok(match args.clock_mhz {
        Some(mhz) => FrameClock::Stated(mhz),
        None => FrameClock::Estimated { device: args.device.clone(), delays: delays(&args.device)? },
    })
}

fn report(
    scene: &Scene,
    samples: &Samples,
    pipeline: &ScenePipeline<'_>,
    clock: &FrameClock,
    rendered: &Rendered,
    highlights: &Highlights,
) -> RenderReport {
    let (answers, image) = (&highlights.needed, &scene.image);
    let clock_mhz = clock.mhz(pipeline.design());
    let cycles = |requests| Cycles::new(pipeline, requests, clock_mhz);
    RenderReport {
        scene: scene.name.clone(),
        configuration: pipeline.design().config().name.clone(),
        angle: scene.angle.name(),
        width: image.width,
        height: image.height,
        display_bits: image.display_bits,
        transfer: files::transfer_name(image),
        lights: scene.lights.len(),
        background_pixels: files::background(scene, samples.pixels.len()),
        picture: difference(&rendered.pipeline, &rendered.reference),
        materials: by_material(scene, samples, answers, &rendered.highlights, &rendered.ideal),
        clock_mhz,
        clock_device: clock.device().map(str::to_owned),
        every: cycles(highlights.every_requests),
        needed: cycles(answers.requests),
    }
}

fn pictures(
    scene: &Scene,
    samples: &Samples,
    pipeline: &ScenePipeline<'_>,
    rendered: &Rendered,
    scale: Option<u16>,
) -> anyhow::Result<[Vec<u8>; 4]> {
    let transfer = scene.image.transfer;
    let made: Vec<anyhow::Result<Vec<u8>>> = (0..files::PICTURES.len())
        .into_par_iter()
        .map(|index| {
            let picture = match index {
                0 => encode(&rendered.reference, transfer).map_err(anyhow::Error::from),
                1 => encode(&rendered.pipeline, transfer).map_err(anyhow::Error::from),
                2 => heat_map(&rendered.pipeline, &rendered.reference, scale).map_err(anyhow::Error::from),
                _ => methods(scene, samples, pipeline).map_err(anyhow::Error::from),
            };
            picture.with_context(|| files::PICTURES[index])
        })
        .collect();
    let made = made.into_iter().collect::<anyhow::Result<Vec<_>>>()?;
    made.try_into().map_err(|_| anyhow::anyhow!("a picture is missing"))
}

fn print(report: &RenderReport, out: &mut Out) -> anyhow::Result<()> {
    let RenderReport { picture, width, height, display_bits, .. } = report;
    let head = format!(
        "{}: {width} × {height} pixels, {display_bits} bits, {}, {}, angle {}; {}",
        report.scene,
        report.transfer,
        counted(report.lights, "light"),
        report.angle,
        report.configuration
    );
    write_folded(out, &head)?;
    let noise = match picture.psnr {
        Some(psnr) => format!("PSNR {psnr:.2} dB"),
        None => "equal pictures".to_owned(),
    };
    let said = format!(
        "against x^n, in display codes: greatest difference {}, mean {}, {noise}; {} pixels differ",
        picture.greatest,
        digits(picture.mean, 3),
        picture.pixels
    );
    write_folded(out, &said)?;
    writeln!(out)?;
    materials(report).print(out, Format::Table, 4)?;
    writeln!(out)?;
    regions(report, out)?;
    writeln!(out)?;
    cycles(report).print(out, Format::Table, 6)
}

/// Which materials are served by the row of another exponent.
fn nearest(scene: &Scene, pipeline: &ScenePipeline<'_>, out: &mut Out) -> anyhow::Result<()> {
    let served = scene.materials.iter().zip(pipeline.rows());
    let said: Vec<String> = served
        .filter(|(material, row)| material.exponent != *row)
        .map(|(material, row)| format!("{} (n = {}) by the row of {row}", material.name, material.exponent))
        .collect();
    if said.is_empty() {
        return Ok(());
    }
    writeln!(out)?;
    Ok(write_folded(out, &format!("served by the nearest row: {}", said.join(", ")))?)
}

fn materials(report: &RenderReport) -> Rows {
    let mut rows = Rows::new(&["material", "n", "samples", "epicentre", "below it", "zero", "away", "linear codes"]);
    for row in &report.materials {
        let mut cells = vec![row.material.as_str().into(), Cell::Exponent(row.exponent)];
        cells.push(Cell::Integer(row.samples as i64));
        cells.extend(Zone::ALL.map(|part| Cell::Integer(row.count(part) as i64)));
        cells.push(Cell::Real(row.highlight_greatest_codes));
        rows.push(cells);
    }
    rows
}

/// What part of the picture each region is.
fn regions(report: &RenderReport, out: &mut Out) -> anyhow::Result<()> {
    let pixels = u64::from(report.width) * u64::from(report.height);
    let places = (pixels * report.lights as u64).max(1) as f64;
    let share = |count: u64| format!("{:.2}\u{a0}%", 100.0 * count as f64 / places);
    let mut said: Vec<String> = Zone::ALL
        .iter()
        .map(|&part| {
            let count = report.materials.iter().map(|row| row.count(part)).sum();
            format!("{} {}", part.name(), share(count))
        })
        .collect();
    said.push(format!("background {}", share(report.background_pixels * report.lights as u64)));
    let of = if report.lights > 1 { "pixels times lights" } else { "pixels" };
    Ok(write_folded(out, &format!("share of {of}: {}", said.join(", ")))?)
}

fn cycles(report: &RenderReport) -> Rows {
    let clock = match &report.clock_device {
        Some(device) => format!("frames a second at {:.1} MHz, estimated for {device}", report.clock_mhz),
        None => format!("frames a second at {} MHz", digits(report.clock_mhz, 6)),
    };
    let mut rows = Rows::new(&["to the pipeline", "requests", "cycles of a frame", &clock]);
    for (name, cycles) in [("every sample", &report.every), ("those that need it", &report.needed)] {
        rows.push(vec![
            name.into(),
            Cell::Integer(cycles.requests as i64),
            Cell::Integer(cycles.cycles as i64),
            cycles.frames_per_second.into(),
        ]);
    }
    rows
}

fn times(highlights: &Highlights, traced: Duration, all: Duration, out: &mut Out) -> anyhow::Result<()> {
    writeln!(out)?;
    let [every, needed] = highlights.times.map(|time| time.as_secs_f64() * 1e3);
    let left_out = highlights.every_requests - highlights.needed.requests;
    let equal = if highlights.equal { "every bit is the same" } else { "BITS DIFFER" };
    let saved = match every - needed {
        saved if left_out > 0 && saved > 0.0 => {
            format!("{saved:.2} ms ({:.0}\u{a0}%)", 100.0 * saved / every)
        }
        _ => "nothing".to_owned(),
    };
    let said = format!(
        "{left_out} of {} samples left out, as they face away or lie below the cut; {equal}. Highlights took \
         {every:.2} ms with them and {needed:.2} ms without, which saved {saved}; rays {:.2} s, everything {:.2} s.",
        highlights.every_requests,
        traced.as_secs_f64(),
        all.as_secs_f64()
    );
    Ok(write_folded(out, &said)?)
}
