//! A comparison for people: tables on a terminal, and the same as a page.

use std::io::Write;

use super::table::{Cell, Format, Rows, digits, write_folded};
use analysis::pareto::synthesis::Synthesis;
use analysis::pareto::{ParetoReport, TimingReport, TimingRow};
use analysis::report::pareto_figures::shortened;

/// Significant digits of an error.
const DIGITS: usize = 4;

/// Everything on a terminal; `origin` says where synthesis results are from.
pub(super) fn print(report: &ParetoReport, origin: &str, out: &mut dyn Write) -> anyhow::Result<()> {
    for section in sections(report) {
        writeln!(out, "{}\n", section.title)?;
        section.rows.print(out, Format::Table, DIGITS)?;
        writeln!(out)?;
        for note in section.notes {
            write_folded(out, &note)?;
            writeln!(out)?;
        }
    }
    write_folded(out, &scope(report))?;
    for line in &report.left_out {
        write_folded(out, &format!("left out: {line}"))?;
    }
    if report.timing.is_none() {
        writeln!(out, "no run times: --no-timing")?;
    }
    write_folded(out, origin)?;
    if report.synthesis.is_empty() && origin.starts_with("synthesis") {
        writeln!(out, "  none of them is of a preset with these exponents and this input")?;
    }
    Ok(())
}

/// Writes the whole comparison as Markdown, for docs/PARETO.md.
pub(super) fn page(report: &ParetoReport, out: &mut dyn Write) -> anyhow::Result<()> {
    writeln!(out, "{}\n", scope(report))?;
    for section in sections(report) {
        writeln!(out, "### {}\n", section.title)?;
        let columns = &section.rows.columns;
        writeln!(out, "| {} |", columns.join(" | "))?;
        writeln!(out, "|{}|", vec!["---"; columns.len()].join("|"))?;
        for row in &section.rows.rows {
            let cells: Vec<String> = row.iter().map(text).collect();
            writeln!(out, "| {} |", cells.join(" | "))?;
        }
        writeln!(out)?;
        for note in section.notes {
            writeln!(out, "{note}\n")?;
        }
    }
    for line in &report.left_out {
        writeln!(out, "Left out: {line}.\n")?;
    }
    writeln!(out, "### What each computes\n")?;
    for row in &report.contenders {
        writeln!(out, "- `{}`: {}", row.contender, row.what)?;
    }
    Ok(())
}

fn text(cell: &Cell) -> String {
    match cell {
        Cell::Text(text) => text.clone(),
        Cell::Integer(integer) => integer.to_string(),
        Cell::Real(real) | Cell::Exponent(real) => digits(*real, DIGITS),
        Cell::Flag(flag) => flag.to_string(),
        Cell::None => String::new(),
    }
}

pub(super) fn scope(report: &ParetoReport) -> String {
    let ParetoReport { input, every, samples, epicentre_samples, .. } = report;
    let exponents = shortened(&report.exponents);
    let seen = if report.exhaustive {
        "every representable x".to_owned()
    } else {
        format!("SAMPLED, one x in {every}: greater errors may lie between")
    };
    format!(
        "Errors are fractions of full intensity against the exact xⁿ at x in {input}, n = {exponents}; {seen}: \
         {samples} samples each, {epicentre_samples} of them on the epicentre (xⁿ ≥ 1/2)."
    )
}

/// A table with its heading and what is said below it.
pub(super) struct Section {
    pub(super) title: String,
    pub(super) rows: Rows,
    pub(super) notes: Vec<String>,
}

pub(super) fn sections(report: &ParetoReport) -> Vec<Section> {
    let mut sections = vec![errors(report)];
    if let Some(timing) = &report.timing {
        sections.extend(times(report, timing));
    }
    sections.push(hardware(report));
    if !report.synthesis.is_empty() {
        sections.push(synthesis(&report.synthesis));
    }
    sections
}

fn errors(report: &ParetoReport) -> Section {
    let columns = ["contender", "epicentre", "RMS", "at n", "[0, 1]", "RMS", "at n", "x", "table, bits"];
    let mut rows = Rows::new(&columns);
    for row in &report.contenders {
        let short = |error: Option<f64>| -> Cell { error.map(|e| digits(e, DIGITS)).into() };
        let n = |n: Option<f64>| n.map_or(Cell::None, Cell::Exponent);
        rows.push(vec![
            Cell::from(row.contender.clone()),
            short(row.epicentre_worst),
            short(row.epicentre_rms),
            n(row.epicentre_worst_n),
            short(row.whole_worst),
            short(row.whole_rms),
            n(row.whole_worst_n),
            row.whole_worst_x.map(|x| digits(x, 6)).into(),
            Cell::Integer(row.storage_bits as i64),
        ]);
    }
    let seen = if report.exhaustive { "" } else { " (SAMPLED)" };
    let title = format!("Greatest and RMS errors{seen}");
    Section { title, rows, notes: Vec::new() }
}

/// The same where times count: `~` before one that is as quick within the spread, and more exact.
fn standing_in_time(
    timing: &TimingReport,
    row: &TimingRow,
    way: &Way,
    standing: (Option<bool>, Option<&String>),
) -> Cell {
    let by = standing.1.and_then(|name| timing.rows.iter().find(|other| other.contender == *name));
    match by.filter(|by| (way.same)(row, by)) {
        Some(by) => Cell::from(format!("~ {}", by.contender)),
        None => self::standing(standing.0, standing.1),
    }
}

/// `FRONT`, or the contender that dominates.
fn standing(front: Option<bool>, dominated_by: Option<&String>) -> Cell {
    match (front, dominated_by) {
        (Some(true), _) => Cell::from("FRONT"),
        (_, Some(by)) => Cell::from(format!("< {by}")),
        _ => Cell::None,
    }
}

/// What one way to be asked says of a contender: median, quartiles, and the two standings.
type Timed<'a> = (f64, [f64; 2], [(Option<bool>, Option<&'a String>); 2]);

/// A way to be asked: what it says of a contender, and whether the times of two are the same.
struct Way {
    of: fn(&TimingRow) -> Option<Timed<'_>>,
    same: fn(&TimingRow, &TimingRow) -> bool,
}

fn block(row: &TimingRow) -> Option<Timed<'_>> {
    Some((
        row.block_median,
        [row.block_lower_quartile, row.block_upper_quartile],
        [
            (row.block_epicentre_front, row.block_epicentre_dominated_by.as_ref()),
            (row.block_whole_front, row.block_whole_dominated_by.as_ref()),
        ],
    ))
}

fn mixed(row: &TimingRow) -> Option<Timed<'_>> {
    Some((
        row.mixed_median?,
        [row.mixed_lower_quartile?, row.mixed_upper_quartile?],
        [
            (row.mixed_epicentre_front, row.mixed_epicentre_dominated_by.as_ref()),
            (row.mixed_whole_front, row.mixed_whole_dominated_by.as_ref()),
        ],
    ))
}

fn times(report: &ParetoReport, timing: &TimingReport) -> [Section; 2] {
    let seen = if report.exhaustive { "" } else { " (errors SAMPLED)" };
    let section = |what: &str, way: Way, notes: Vec<String>| {
        let mut rows = Rows::new(&["contender", "ns/sample", "quartiles", "epicentre", "[0, 1]"]);
        for row in &timing.rows {
            let Some((median, [low, high], [epicentre, whole])) = (way.of)(row) else { continue };
            rows.push(vec![
                Cell::from(row.contender.clone()),
                Cell::from(format!("{median:.2}")),
                Cell::from(format!("{low:.2}-{high:.2}")),
                standing_in_time(timing, row, &way, epicentre),
                standing_in_time(timing, row, &way, whole),
            ]);
        }
        Section { title: format!("Run time against error, {what}{seen}"), rows, notes }
    };
    let TimingReport { rounds, seed, samples, block: length, .. } = timing;
    let note = format!(
        "Median of {rounds} rounds, everybody in turn over the same {samples} random x (seed {seed}), one thread. \
         Times are told apart where their quartiles do not overlap. FRONT: nobody else is quicker and as exact, or \
         as quick and more exact. < X: X is quicker; ~ X: X is as quick within the spread, and more exact. The \
         times are those of one machine. Of the presets it is the model that is timed, not the hardware."
    );
    [
        section(
            &format!("{length} samples of one exponent"),
            Way { of: block, same: TimingRow::same_block_time },
            Vec::new(),
        ),
        section("an exponent for each sample", Way { of: mixed, same: TimingRow::same_mixed_time }, vec![note]),
    ]
}

fn hardware(report: &ParetoReport) -> Section {
    let mut rows =
        Rows::new(&["preset", "latency", "multipliers", "bits", "divider, bits", "ROM, bits", "epicentre", "[0, 1]"]);
    let whole = |count: Option<u64>| count.map(|count| count as i64).into();
    for row in report.contenders.iter().filter(|row| row.kind == "hardware") {
        let divider = match row.divider_bits {
            Some(0) => Cell::from("none"),
            bits => bits.map(|bits| bits.to_string()).into(),
        };
        rows.push(vec![
            Cell::from(row.contender.trim_start_matches("preset ")),
            whole(row.latency),
            row.multipliers.clone().into(),
            whole(row.multiplier_bits),
            divider,
            Cell::Integer(row.storage_bits as i64),
            standing(row.hardware_epicentre_front, row.hardware_epicentre_dominated_by.as_ref()),
            standing(row.hardware_whole_front, row.hardware_whole_dominated_by.as_ref()),
        ]);
    }
    let notes = vec![
        "Dominated: another preset has no greater error, multipliers (partial-product bits), divider (quotient \
         digits times divisor bits), ROM and latency, and one of them less."
            .to_owned(),
    ];
    let seen = if report.exhaustive { "" } else { " (errors SAMPLED)" };
    Section { title: format!("Hardware against error{seen}"), rows, notes }
}

fn synthesis(found: &[Synthesis]) -> Section {
    let mut rows = Rows::new(&["preset", "device", "LUTs", "flip-flops", "DSP", "RAM", "f_max, MHz"]);
    for row in found {
        rows.push(vec![
            Cell::from(row.configuration.clone()),
            Cell::from(row.device.clone()),
            Cell::Integer(row.luts as i64),
            Cell::Integer(row.flip_flops as i64),
            Cell::Integer(row.dsp_blocks as i64),
            Cell::Integer(row.block_rams as i64),
            row.f_max_mhz.map_or_else(|| Cell::from("does not fit"), |f| Cell::from(f.to_string())),
        ]);
    }
    Section { title: "Synthesised".to_owned(), rows, notes: Vec::new() }
}
