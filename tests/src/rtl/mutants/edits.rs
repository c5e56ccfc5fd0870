//! Mutants that are other lines of the RTL: the fault model, written into the sources.

use hw_model::datapath::Datapath;
use hw_model::format::QFormat;
use hw_model::registers::Register;
use hw_model::rounding::Rounding;
use vectors::faults::{Defect, Fault, HANDSHAKE, Logic, pipeline_faults};
use vectors::rtl::{rounding_name, rounding_number};

use crate::rtl::{Failure, failed, source_text};

/// A change of one place of one file.
#[derive(Debug, Clone)]
pub struct Edit {
    /// The name of the fault, for tables.
    pub name: String,
    /// The fault of the model that this is; none where a vector on its own cannot show it.
    pub fault: Option<Fault>,
    /// The name of the RTL file.
    pub file: &'static str,
    /// What stands there, once.
    pub right: String,
    /// The text that takes its place.
    pub wrong: String,
}

impl Edit {
    /// The file with the change.
    ///
    /// # Errors
    /// When the line is not there, or more than once.
    pub fn apply(&self, text: &str) -> Result<String, Failure> {
        source_text::replace_once(text, &self.right, &self.wrong)
            .or_else(|places| failed(format!("{}: {:?} is {places} times in {}", self.name, self.right, self.file)))
    }
}

/// Every fault of the pipeline that is a change of its sources. The registers of later ranks of the
/// divider are not: one line of the RTL makes them all.
#[must_use]
pub fn edits(datapath: &Datapath) -> Vec<Edit> {
    let of_model = pipeline_faults(datapath).into_iter().filter_map(|fault| {
        let (file, right, wrong) = match fault {
            Fault::Rounding(line, mode) => rounding(datapath, line, mode),
            Fault::Register(rank, register, defect) => self::register(datapath, rank, register, defect)?,
            Fault::Logic(logic) => self::logic(logic)?,
            Fault::Field(_) | Fault::Swap(_) => return None,
        };
        Some(Edit { name: fault.to_string(), fault: Some(fault), file, right, wrong })
    });
    of_model.chain(handshake()).collect()
}

type Change = (&'static str, String, String);

fn change(file: &'static str, right: &str, wrong: &str) -> Change {
    (file, right.to_owned(), wrong.to_owned())
}

fn rounding(datapath: &Datapath, line: Register, mode: Rounding) -> Change {
    let (name, own) = match line {
        Register::T(stage) => return stage_rounding(datapath, stage, mode),
        Register::V => ("U", datapath.front_end().rounding()),
        Register::Divisor => ("DIVISOR", datapath.divider().map(|d| d.divisor.rounding())),
        _ => ("QUOTIENT", datapath.divider().map(|d| d.rounding)),
    };
    let text = |mode| format!("{name}_ROUNDING = {};", rounding_name(mode));
    (vectors::rtl::PACKAGE, text(own.unwrap_or_default()), text(mode))
}

/// In the vector of the modes of all stages.
fn stage_rounding(datapath: &Datapath, stage: usize, mode: Rounding) -> Change {
    let own = std::iter::once(0).chain(datapath.stages().iter().map(|line| rounding_number(line.rounding())));
    let own: Vec<u8> = own.collect();
    let mut other = own.clone();
    other[stage] = rounding_number(mode);
    let text = |modes: &[u8]| {
        let words: Vec<String> = modes.iter().rev().map(|mode| format!("32'd{mode}")).collect();
        format!(" T_ROUNDING = {{{}}};", words.join(", "))
    };
    (vectors::rtl::PACKAGE, text(&own), text(&other))
}

/// Where a register is read, or shown to those who read it.
fn register(datapath: &Datapath, rank: usize, register: Register, defect: Defect) -> Option<Change> {
    let held = datapath.registers(rank).into_iter().find(|held| held.register == register)?;
    let (file, before, signal, after) = match register {
        Register::V => ("blysk_front_end.sv", "assign v_o = ", "v_q", ";"),
        Register::T(stage) if stage < datapath.degree() => {
            return Some(stage_register(stage, held.format, defect));
        }
        Register::T(_) => ("blysk.sv", ".t_i(", "t_waited", ")"),
        Register::TailX => ("blysk_front_end.sv", "assign tail_x_o = ", "tail_x_q", ";"),
        Register::Remainder if rank == datapath.rank_of(register) => {
            ("blysk_tail.sv", "assign remainder[DIVISOR_WIDTH-1:0] = ", "remainder_q", ";")
        }
        Register::Digits if rank == datapath.rank_of(register) => {
            ("blysk_tail.sv", "assign digits[DIGITS_WIDTH-1:0] = ", "digits_q", ";")
        }
        Register::Intensity => ("blysk_clamp.sv", "assign intensity_o = ", "intensity_q", ";"),
        _ => return None,
    };
    let top = held.format.width() - 1;
    let wrong = match defect {
        // The bit below is the new sign, or there is none.
        Defect::Short if held.format.is_signed() => {
            format!("{{{signal}[{}], {signal}[{}:0]}}", top - 1, top - 1)
        }
        Defect::Short => format!("{{1'b0, {signal}[{}:0]}}", top - 1),
        Defect::LowBitStuck if top == 0 => "1'b0".to_owned(),
        Defect::LowBitStuck => format!("{{{signal}[{top}:1], 1'b0}}"),
    };
    Some((file, format!("{before}{signal}{after}"), format!("{before}{wrong}{after}")))
}

/// What stage `stage + 1` multiplies, in the loop over the stages.
fn stage_register(stage: usize, format: QFormat, defect: Defect) -> Change {
    let right = "assign multiplicand = stage[j-1].t;";
    let t = "stage[j-1].t";
    let wrong = match defect {
        Defect::Short if format.is_signed() => format!("{{{t}[M_WIDTH-2], {t}[M_WIDTH-2:0]}}"),
        Defect::Short => format!("{{1'b0, {t}[M_WIDTH-2:0]}}"),
        Defect::LowBitStuck => format!("{t} & ~M_WIDTH'(1)"),
    };
    let wrong = format!("assign multiplicand = j == {} ? {wrong} : {t};", stage + 1);
    change("blysk.sv", right, &wrong)
}

fn logic(logic: Logic) -> Option<Change> {
    let front_end = |right: &str, wrong: &str| Some(change("blysk_front_end.sv", right, wrong));
    let clamp = |right: &str, wrong: &str| Some(change("blysk_clamp.sv", right, wrong));
    match logic {
        Logic::CutExclusive => front_end("'(x) >= ", "'(x) > "),
        Logic::ShiftMore(0) => front_end("<< shift;", "<< (|beyond_o ? shift : SHIFT_COMMON_WIDTH'(shift + 1'b1));"),
        Logic::ShiftMore(segment) => {
            let answers = format!("(beyond_o >> {segment}) == SEGMENTS'(1)");
            let wrong = format!("<< ({answers} ? SHIFT_COMMON_WIDTH'(shift + 1'b1) : shift);");
            front_end("<< shift;", &wrong)
        }
        Logic::ShiftLess => {
            front_end("<< shift;", "<< (|beyond_o || shift == '0 ? shift : SHIFT_COMMON_WIDTH'(shift - 1'b1));")
        }
        Logic::HandOverExclusive(segment) => {
            let wrong = format!("(k == {segment} ? COMPARE'(x) <= hand_over : COMPARE'(x) < hand_over);");
            front_end("COMPARE'(x) < hand_over;", &wrong)
        }
        Logic::NoInputClamp => front_end("one_or_more ? X_GREATEST", "1'b0 ? '0"),
        Logic::NegativeAsUnsigned => None,
        Logic::RegionsSwapped => front_end("if (above_cut) ", "if (!above_cut) "),
        Logic::NoClampBelow => clamp("below ? '0 :", "1'b0 ? '0 :"),
        Logic::NoClampAbove => clamp("above ? OUTPUT_GREATEST :", "1'b0 ? OUTPUT_GREATEST :"),
        Logic::NoQuotientClamp => clamp("assign quotient = rounded >", "assign quotient = 1'b0 && rounded >"),
        Logic::NoFlag(flag) => {
            let place = flag.bits().trailing_zeros();
            let mask = format!("status_q & ~(STATUS_WIDTH'(1) << {place})");
            clamp("= status_q;", &format!("= {mask};"))
        }
        Logic::DigitMissing => {
            Some(change("blysk_tail.sv", ".COUNT(COUNT)", ".COUNT(step == DIGIT_STAGES - 1 ? COUNT - 1 : COUNT)"))
        }
    }
}

/// Latency one more and one less, and a stall that is not kept.
fn handshake() -> impl Iterator<Item = Edit> {
    const VALID: &str = "assign out_valid_o = valid_q[RANKS-1];";
    let changes = [
        (
            VALID,
            "logic late_q;\n  always_ff @(posedge clk_i) late_q <= valid_q[RANKS-1];\n  \
             assign out_valid_o = late_q;",
        ),
        (VALID, "assign out_valid_o = valid_q[RANKS-2];"),
        ("out_ready_i || !(&valid_q[RANKS-1:rank])", "1'b1"),
    ];
    HANDSHAKE.into_iter().zip(changes).map(|(name, (right, wrong))| Edit {
        name: name.to_owned(),
        fault: None,
        file: "blysk_handshake.sv",
        right: right.to_owned(),
        wrong: wrong.to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use hw_model::rtl::SOURCES;
    use vectors::rtl::{PACKAGE, package};

    use super::super::preset;
    use super::*;

    /// `make mutants` takes hours; a line of the RTL that was rewritten is found here.
    #[test]
    fn every_edit_of_every_preset_finds_its_line() {
        let mut names = BTreeSet::new();
        for preset_file in hw_model::presets::ALL {
            let design = preset(preset_file.name).unwrap();
            let package = package(&design, "a test");
            for edit in edits(design.datapath()) {
                let source = SOURCES.iter().find(|(name, _)| *name == edit.file);
                let text = match source {
                    Some((_, text)) => text,
                    None if edit.file == PACKAGE => package.as_str(),
                    None => panic!("{} is no file of the RTL", edit.file),
                };
                let wrong = edit.apply(text).unwrap();
                assert_ne!(wrong, text, "{}: {}", preset_file.name, edit.name);
                names.insert(edit.name);
            }
        }
        assert!(names.len() > 40, "{names:?}");
    }
}
