//! `blysk design`: little hardware that keeps an error.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::Args as ClapArgs;
use hw_model::clock::Clock;
use hw_model::config::{Config, Cut, Form, Tail};
use hw_model::exponents::Exponents;
use hw_model::format::QFormat;
use hw_model::quantise::{decimal, real};
use hw_model::rounding::Rounding;
use vectors::limits::Sweep;

use super::bar::Bar;
use super::clock;
use super::out::{Out, Outcome};
use super::output;
use super::report::bound;
use super::table::{Cell, Format, Rows, digits, write_folded};
use analysis::sizing::{Breaks, CandidateFate, Considered, Fewer, Over, Request, Sized, Witness, samples, size};
use hw_model::stated::Hardware;

/// Search for the least hardware that keeps an error: form, method, degree, segments, widths and rounding.
///
/// Every design that can be built is compared with x^n in real numbers, given widths that are proved to keep the error,
/// and ranked by multiplier bits (the widths of both operands, multiplied, of every multiplier), then ROM bits, then
/// latency, then register bits. The first few are narrowed bit by bit as far as the error allows, measured at
/// every x of the range. The least design that was found is printed. None of its registers can lose a bit: every
/// register gets two witnesses, an n and an x at which a fraction bit less, or an integer bit less, breaks the
/// error or overflows. The last result has the output's fraction bits, and is not narrowed. The configuration that
/// --out writes states all widths. Some exponents with ten bits of x take seconds, 1..=256 with 24 bits some minutes.
/// csv and json print the witnesses.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk design --exponents 1..=8 --input UQ1.10 --output UQ1.10 --error 0.01")]
pub(super) struct Args {
    /// The ROM's exponents, such as 1..=256, 1,2,8,64 or 2.5,1e6.
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    exponents: Exponents,
    /// Format of the intensity, such as UQ1.15.
    #[arg(long, value_name = "FORMAT")]
    output: QFormat,
    /// Format of x, such as UQ1.23.
    #[arg(long, value_name = "FORMAT")]
    input: QFormat,
    /// The greatest error allowed, as a fraction of 1.
    #[arg(long, allow_negative_numbers = true, value_parser = bound)]
    error: f64,
    /// The x over which the error is kept: all of [0, 1], the epicentre (x^n >= 1/2), or where x^n is at least a
    /// number.
    #[arg(long, default_value = "all", value_name = "all|epicentre|LEVEL", value_parser = over)]
    range: Over,
    /// How many designs are narrowed.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=64))]
    finalists: u8,
    /// A clock that the design reaches on --device, in MHz, by as many ranks of registers as that takes.
    #[arg(long, value_name = "MHZ", allow_negative_numbers = true, requires = "device")]
    clock_mhz: Option<f64>,
    /// The device of --clock-mhz: ecp5, up5k, or a JSON file with its delays in nanoseconds.
    #[arg(long, value_name = "NAME|FILE", requires = "clock_mhz")]
    device: Option<String>,
    /// Write the configuration to this file; - is standard output, which then has nothing else.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// How to print the design and its witnesses.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl Args {
    fn clock(&self) -> anyhow::Result<Option<Clock>> {
        let Some((mhz, device)) = self.clock_mhz.zip(self.device.as_deref()) else { return Ok(None) };
        let clock = Clock { mhz, device: clock::device(device)? };
        clock.check().map_err(anyhow::Error::msg).context("--clock-mhz, --device")?;
        Ok(Some(clock))
    }
}

fn over(text: &str) -> Result<Over, String> {
    match (text, text.parse::<f64>()) {
        ("all", _) => Ok(Over::All),
        ("epicentre", _) => Ok(Over::Level(0.5)),
        (_, Ok(level)) if level > 0.0 && level < 1.0 => Ok(Over::Level(level)),
        _ => Err("use all, epicentre, or a number between 0 and 1".to_owned()),
    }
}

/// What the columns of the ranking are, and what a verdict means.
const COLUMNS: &str = "deg, seg: degree and number of the polynomials. cut: they end where x^n is this. below: what \
                       answers below the cut. round: the rounding mode. real: the greatest error in real numbers. \
                       mult, rom: bits of multipliers and of the ROM. lat: latency in cycles. CHOSEN: the least, which \
                       follows. narrowed: widths were taken away bit by bit as far as the error allows. proved: the \
                       widths are, and their hardware is no candidate for narrowing. no widths: none are proved to \
                       keep what the real error leaves, or no ranks reach the clock. too far: more than allowed.";

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let request = Request {
        exponents: args.exponents.clone(),
        input: args.input,
        output: args.output,
        error: args.error,
        over: args.range,
        finalists: args.finalists.into(),
        clock: args.clock()?,
    };
    let samples = check(&request)?;
    // Begun before the work, so that an unwritable place is found at once.
    let read: Vec<PathBuf> = args.device.as_deref().and_then(clock::delays_file).into_iter().collect();
    let file = output::file(args.out.as_ref(), &read)?;
    let bar = Bar::new(Some(samples));
    let sized = size(&request, &bar)?;
    bar.finish();
    if output::fill(file, sized.design.config().to_json())? {
        return Ok(Outcome::Good);
    }
    if args.format != Format::Table {
        witnesses(&sized).print(out, args.format, 17)?;
        return Ok(Outcome::Good);
    }
    ranking(&sized.ranking).print(out, Format::Table, 5)?;
    writeln!(out)?;
    write_folded(out, COLUMNS)?;
    writeln!(out)?;
    write_folded(out, &summary(&request, &sized))?;
    writeln!(out)?;
    for_people(&sized).print(out, Format::Table, 8)?;
    if let Some(path) = &args.out {
        writeln!(out, "\nwritten to {}", path.display())?;
    }
    Ok(Outcome::Good)
}

/// The formats and exponents alone, so that a wrong one is refused by its name and not by every candidate's. Returns
/// the samples of the search.
fn check(request: &Request) -> anyhow::Result<u64> {
    let config = Config {
        exponents: request.exponents.clone(),
        input: request.input,
        output: request.output,
        ..hw_model::presets::ALL[0].config()?
    };
    config.check()?;
    // Trials have a budget too, the greatest a configuration may state; bounds are up to some times the error.
    const MOST_ULP: f64 = 2.5e5;
    let allowed = request.error / request.output.ulp();
    if allowed > MOST_ULP {
        let coarser = (MOST_ULP / request.error).log2().floor();
        bail!(
            "--output: {} is {allowed:.3e} times finer than the error allows; use at most {coarser} fraction bits",
            request.output
        );
    }
    Ok(Sweep::Design.within(samples(request), request.input)?)
}

fn parts(config: &Config) -> [String; 5] {
    let form = match config.form {
        Form::Power => "power",
        Form::Centred => "centred",
    };
    let cut = match config.cut {
        Cut::Epicentre => digits(config.q, 4),
        Cut::Minimum => "minimum".to_owned(),
        Cut::Balanced => "balanced".to_owned(),
    };
    let tail = match config.tail {
        Tail::Zero => "zero",
        Tail::Rational => "ratio",
    };
    let numbers = [config.degree, config.segments].map(|number| number.to_string());
    let [degree, segments] = numbers;
    [form.to_owned(), degree, segments, cut, tail.to_owned()]
}

fn ranking(considered: &[Considered]) -> Rows {
    let mut rows =
        Rows::new(&["method", "form", "deg", "seg", "cut", "below", "round", "real", "mult", "rom", "lat", "verdict"]);
    for one in considered {
        let (hardware, verdict) = match &one.verdict {
            CandidateFate::TooFar => (None, format!("too far, n = {}", one.real.n)),
            CandidateFate::Refused(_) => (None, "no widths".to_owned()),
            CandidateFate::Proved(hardware) => (Some(*hardware), "proved".to_owned()),
            CandidateFate::Narrowed(hardware) => (Some(*hardware), "narrowed".to_owned()),
            CandidateFate::Chosen(hardware) => (Some(*hardware), "CHOSEN".to_owned()),
        };
        let rounding = one.rounding.map_or("any", Rounding::short_name);
        let mut cells = vec![Cell::from(one.config.method.to_string())];
        cells.extend(parts(&one.config).map(Cell::from));
        cells.extend([Cell::from(rounding), Cell::Real(one.real.whole)]);
        let of = |value: fn(&Hardware) -> u64| {
            hardware.map_or(Cell::None, |hardware| Cell::Integer(value(&hardware) as i64))
        };
        cells.extend([of(|h| h.multiplier_bits), of(|h| h.rom_bits), of(|h| h.latency)]);
        cells.push(verdict.into());
        rows.push(cells);
    }
    rows
}

fn summary(request: &Request, sized: &Sized) -> String {
    let config = sized.design.config();
    let Hardware { multiplier_bits, rom_bits, latency, register_bits } = sized.hardware;
    let [form, degree, segments, cut, tail] = parts(config);
    let n = sized.design.rows()[sized.worst.address as usize].exponent;
    let x = real(sized.worst.x, config.input);
    let found = format!(
        "{}, {form}, degree {degree}, {segments} segment(s), cut {cut}, {tail} below, {}: {multiplier_bits} \
         multiplier bits, {rom_bits} ROM bits, latency {latency}, {register_bits} bits of stated registers. \
         Greatest error, at every x of the range: {} at n = {n}, x = {}; allowed {}.",
        config.method,
        config.rounding,
        digits(sized.worst.error, 6),
        digits(x, 9),
        request.error,
    );
    let budget = config.error_budget_ulp;
    let real = sized.ranking.first().map_or(0.0, |best| best.real.answered);
    if real + budget * config.output.ulp() <= request.error {
        return found;
    }
    format!(
        "{found} error_budget_ulp is raised to {budget}, which is what the analysis proves of these widths: that \
         they keep the error is measured, not proved."
    )
}

fn breaks(witness: &Witness) -> String {
    match witness.breaks {
        Breaks::Error(error) => format!("error {}", digits(error, 6)),
        Breaks::Overflow { register, bits, format } => {
            // The bits are of the register's unit, whatever its format holds.
            let value = decimal(bits, format);
            format!("{register} = {value}")
        }
        Breaks::MoreRom(bits) => format!("{bits} ROM bits"),
        Breaks::NoSuchBit => "no such bit".to_owned(),
        Breaks::NoHardware => "no such hardware".to_owned(),
        Breaks::OutputHasIt => "the output has it".to_owned(),
        Breaks::Unproved => "no value; not proved".to_owned(),
    }
}

const fn end(fewer: Fewer) -> &'static str {
    match fewer {
        Fewer::Fraction => "fraction",
        Fewer::Integer => "integer",
    }
}

fn for_people(sized: &Sized) -> Rows {
    let input = sized.design.config().input;
    let mut rows = Rows::new(&["register", "format", "a bit less", "n", "x", "breaks"]);
    for witness in &sized.witnesses {
        rows.push(vec![
            witness.register.into(),
            witness.format.to_string().into(),
            end(witness.fewer).into(),
            witness.n.map_or(Cell::None, Cell::Exponent),
            witness.n.map_or(Cell::None, |_| Cell::Real(real(witness.x, input))),
            breaks(witness).into(),
        ]);
    }
    rows
}

fn witnesses(sized: &Sized) -> Rows {
    let columns = [
        "register",
        "format",
        "fewer",
        "n",
        "x_bits",
        "error",
        "overflows",
        "bits",
        "in_format",
        "rom_bits",
        "asked_by",
    ];
    let mut rows = Rows::new(&columns);
    for witness in &sized.witnesses {
        let (error, overflow) = match witness.breaks {
            Breaks::Error(error) => (Some(error), None),
            Breaks::Overflow { register, bits, format } => (None, Some((register, bits, format))),
            _ => (None, None),
        };
        rows.push(vec![
            witness.register.into(),
            witness.format.to_string().into(),
            end(witness.fewer).into(),
            witness.n.map_or(Cell::None, Cell::Exponent),
            witness.n.map_or(Cell::None, |_| Cell::Integer(witness.x)),
            error.into(),
            overflow.map_or(Cell::None, |(register, ..)| register.into()),
            overflow.map_or(Cell::None, |(_, bits, _)| Cell::Integer(bits)),
            overflow.map_or(Cell::None, |(.., format)| format.to_string().into()),
            match witness.breaks {
                Breaks::MoreRom(bits) => Cell::Integer(bits as i64),
                _ => Cell::None,
            },
            match witness.breaks {
                Breaks::OutputHasIt => "output".into(),
                _ => Cell::None,
            },
        ]);
    }
    rows
}
