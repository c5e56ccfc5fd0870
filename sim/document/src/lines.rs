//! Every line of arithmetic with its alignment.

use hw_model::datapath::Datapath;
use hw_model::datapath::front_end::Variable;
use hw_model::datapath::stage::MultiplyAdd;
use hw_model::format::QFormat;
use hw_model::registers::Register;
use hw_model::rounding::Rounding;

use super::table::Table;
use super::words::{ORDINALS, line_formula, moved_up, multiplicand};

/// What meets in a multiply-add line.
struct Meeting<'a> {
    name: String,
    formula: String,
    line: &'a MultiplyAdd,
    multiplicand: (&'static str, QFormat),
    variable: (&'static str, QFormat),
    addend: (&'static str, QFormat),
    result: (&'static str, QFormat),
}

/// The multiply-add lines: the stages, and the divisor.
pub(super) fn lines(datapath: &Datapath) -> Table {
    let mut table = Table::new(&[
        "line",
        "formula",
        "in integers",
        "product: operands, fraction bits",
        "moved up: product, addend",
        "sum: fraction bits, width with sign",
        "dropped, mode",
        "result",
    ]);
    for meeting in meetings(datapath) {
        let Meeting { name, formula, line, multiplicand, variable, addend, result } = &meeting;
        let product = multiplicand.1.fraction_bits() + variable.1.fraction_bits();
        let widths = [multiplicand.1, variable.1, addend.1].map(QFormat::width);
        let bits = line.lane_bits(widths[0], widths[1], widths[2]);
        table.row([
            name.clone(),
            formula.clone(),
            format!("`{}`", in_integers(&meeting)),
            format!("{} × {}, {product}", widths[0], widths[1]),
            format!("{}, {}", line.product_up(), line.addend_up()),
            format!("{}, {bits}", product + line.product_up()),
            rounding(line.dropped_bits(), line.rounding()),
            format!("{} {}", result.0, result.1),
        ]);
        debug_assert_eq!(addend.1.fraction_bits() + line.addend_up(), product + line.product_up());
    }
    table
}

fn meetings(datapath: &Datapath) -> Vec<Meeting<'_>> {
    let formats = datapath.formats();
    let mut meetings = Vec::new();
    if let Some(formats) = &formats.polynomial {
        let degree = formats.degree();
        for (stage, (line, &result)) in (1..).zip(datapath.stages().iter().zip(formats.t())) {
            meetings.push(Meeting {
                name: format!("stage {stage}"),
                formula: line_formula(stage, degree, line.subtracts()),
                line,
                multiplicand: (multiplicand(stage, degree).name(), formats.multiplicand(stage)),
                variable: ("v", formats.v),
                addend: (Register::C(0, degree - stage).name(), formats.addend(stage)),
                result: (Register::T(stage).name(), result),
            });
        }
    }
    if let (Some(divider), Some(formats)) = (datapath.divider(), &formats.tail) {
        meetings.push(Meeting {
            name: "divisor".to_owned(),
            formula: "D = A − B·x".to_owned(),
            line: &divider.divisor,
            multiplicand: ("tail_b", formats.b),
            variable: ("tail_x", datapath.tail_x_format()),
            addend: ("tail_a", formats.a),
            result: ("divisor", formats.divisor),
        });
    }
    meetings
}

/// The line over the bits of its operands.
fn in_integers(meeting: &Meeting<'_>) -> String {
    let line = meeting.line;
    let product = format!("{}·{}", meeting.multiplicand.0, meeting.variable.0);
    let product = moved_up(&product, line.product_up());
    let addend = moved_up(meeting.addend.0, line.addend_up());
    let sign = if line.subtracts() { '−' } else { '+' };
    let sum = format!("{addend} {sign} {product}");
    let result = meeting.result.0;
    match (line.result_up(), line.dropped_bits()) {
        (0, 0) => format!("{result} = {sum}"),
        (0, drop) => format!("{result} = round(({sum}) / 2^{drop})"),
        (up, _) => format!("{result} = ({sum})·2^{up}"),
    }
}

/// What a line drops, and how.
pub(super) fn rounding(drop: u32, mode: Rounding) -> String {
    if drop == 0 { "0, exact".to_owned() } else { format!("{drop}, {mode}") }
}

/// The line of the variable.
pub(super) fn variable(datapath: &Datapath) -> String {
    let input = datapath.formats().input;
    match datapath.front_end().variable {
        None => String::new(),
        Some(Variable::X) => format!(
            "The polynomial's variable is v = x, clamped. Where the polynomial does not answer it is \
             fed v = {} (the greatest x), for which the ranges hold too.",
            datapath.front_end().greatest
        ),
        Some(Variable::U { up, drop, rounding: mode }) => {
            let one = format!("2^{} − x", input.fraction_bits());
            let moved = moved_up(&format!("({one})·2^shift"), up);
            let line = if drop == 0 { format!("v = {moved}") } else { format!("v = round({moved} / 2^{drop})") };
            let second: String = (1..datapath.segment_count()).map(|segment| further(datapath, segment)).collect();
            format!(
                "The polynomial's variable is v = u = (1 − x)·2^e. In integers, with the clamped x: \
                 `{line}`; fraction bits dropped and mode: {}.{second} Where the polynomial does not \
                 answer it is fed v = 0, for which the ranges hold too.",
                rounding(drop, mode)
            )
        }
    }
}

/// What takes the places of the first segment's fields in another one.
fn further(datapath: &Datapath, segment: usize) -> String {
    let name = |of: &dyn Fn(usize) -> Register| {
        let powers = (0..=datapath.degree()).rev();
        powers.map(|power| of(power).name()).collect::<Vec<_>>().join(", ")
    };
    let (hand_over, shift) = (Register::HandOver(segment), Register::Shift(segment));
    let until = match segment + 1 {
        next if next < datapath.segment_count() => {
            format!(" and no further segment does (x ≥ {})", Register::HandOver(next))
        }
        _ => String::new(),
    };
    format!(
        " The {} segment answers where the polynomial does and x < {hand_over}{until}: `{hand_over}` \
         then stands for `2^{}`, `{shift}` for `shift`, and what rank {} loads into {} is {}.",
        ORDINALS[segment],
        datapath.formats().input.fraction_bits(),
        datapath.rank_of(Register::V),
        name(&|power| Register::C(0, power)),
        name(&|power| Register::C(segment, power)),
    )
}

/// Which part answers.
pub(super) fn regions(datapath: &Datapath) -> Table {
    let mut table = Table::new(&["region", "code", "when", "intensity"]);
    let mut row = |name: &str, code: u8, when: &str, what: &str| {
        table.row([name.to_owned(), code.to_string(), when.to_owned(), what.to_owned()]);
    };
    let clamped = format!("t{}, clamped", datapath.degree());
    let below = match (datapath.degree() > 0, datapath.divider().is_some()) {
        (true, false) => {
            row("polynomial", 1, "x ≥ cut, and a ROM word", &clamped);
            "x < cut (so x < 0 too); or no ROM word"
        }
        (true, true) => {
            row("polynomial", 1, "x ≥ cut, and a ROM word", &clamped);
            row("tail", 2, "0 ≤ x < cut, and a ROM word", "the quotient, rounded");
            "x < 0; or no ROM word"
        }
        (false, _) => {
            row("tail", 2, "x ≥ 0, and a ROM word", "the quotient, rounded");
            "x < 0; or no ROM word"
        }
    };
    row("zero", 0, below, "0");
    table
}
