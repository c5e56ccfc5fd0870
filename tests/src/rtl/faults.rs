//! Single-line changes of the RTL that a testbench must report, with the stage they are in.

use std::path::Path;

use super::{Failure, failed, source_text};

/// One line of the RTL, written wrongly on purpose.
#[derive(Debug, Clone, Copy)]
pub struct Fault {
    /// What is wrong, in a few words.
    pub name: &'static str,
    /// The preset it is planted in.
    pub preset: &'static str,
    /// The name of the RTL file.
    pub file: &'static str,
    /// The right text, which stands there once.
    pub right: &'static str,
    /// The wrong text that takes its place.
    pub wrong: &'static str,
    /// What the verdict must name: a register, or the handshake.
    pub named: &'static str,
}

macro_rules! fault {
    ($name:literal, $preset:literal, $file:literal, $right:literal => $wrong:literal, $named:literal) => {
        Fault { name: $name, preset: $preset, file: $file, right: $right, wrong: $wrong, named: $named }
    };
}

/// The faults: arithmetic and handshake, one line each.
pub const FAULTS: &[Fault] = &[
    fault!("rounding dropped in every line", "compact", "blysk_round_shift.sv",
        "assign added = HALF;" => "assign added = '0;", "front_end.v"),
    fault!("stage 1 adds", "compact", "blysk.sv",
        ".SUBTRACT(CENTRED)" => ".SUBTRACT(j == 1 ? 0 : CENTRED)", "stage1.t1"),
    fault!("stage 2 shifts the addend one place less", "compact", "blysk.sv",
        ".ADDEND_UP(T_ADDEND_UP[32*j+:32])"
            => ".ADDEND_UP(T_ADDEND_UP[32*j+:32] - (j == 2 ? 1 : 0))", "stage2.t2"),
    fault!("stage 3 drops one bit more", "compact", "blysk.sv",
        ".DROP(T_DROP[32*j+:32])" => ".DROP(T_DROP[32*j+:32] + (j == 3 ? 1 : 0))", "stage3.t3"),
    fault!("cut off by one", "compact", "blysk_front_end.sv",
        "'(x) >= " => "'(x) > ", "front_end."),
    fault!("no region still answers", "compact", "blysk_clamp.sv",
        "intensity_d = '0;" => "intensity_d = polynomial;", "clamp.intensity"),
    fault!("x above 1 not clamped", "compact", "blysk_front_end.sv",
        "one_or_more ? X_GREATEST :" => "1'b0 ? X_GREATEST :", "front_end.v"),
    fault!("ROM reads a row too far", "compact", "blysk_rom.sv",
        "address_i[ROM_INDEX_WIDTH-1:0] : '0"
            => "address_i[ROM_INDEX_WIDTH-1:0] + 1'b1 : '0", "fetch."),
    fault!("v does not wait for stage 3", "compact", "blysk.sv",
        ".value_i(stage[j-1].v_multiplied)" => ".value_i(j == 3 ? v : stage[j-1].v_multiplied)", "stage2.v"),
    fault!("the pipeline does not stall", "compact", "blysk_handshake.sv",
        "out_ready_i || !(&valid_q[RANKS-1:rank])" => "1'b1", "handshake"),
    fault!("the pipeline does not stall", "small_compact", "blysk_handshake.sv",
        "out_ready_i || !(&valid_q[RANKS-1:rank])" => "1'b1", "handshake"),
    fault!("a stage loads while it stalls", "small_compact", "blysk_stage.sv",
        "if (load_i[LAST]) t_q <= t_d;" => "t_q <= t_d;", "stage"),
    fault!("bubbles do not collapse", "compact", "blysk_handshake.sv",
        "out_ready_i || !(&valid_q[RANKS-1:rank])" => "out_ready_i || !valid_q[RANKS-1]", "handshake"),
    fault!("reset leaves what is in flight", "compact", "blysk_handshake.sv",
        "@(posedge clk_i) begin if (rst_i) valid_q <= '0;" => "@(posedge clk_i) begin if (rst_i) valid_q <= valid_d;",
        "handshake"),
    fault!("ready in reset", "compact", "blysk.sv",
        "slice_ready && (READY_IN_RESET != 0 || !rst)" => "slice_ready", "handshake"),
    fault!("a rank loads though nothing is offered", "compact", "blysk_handshake.sv",
        "assign load_o  = advance & offered;" => "assign load_o  = advance;", "or the handshake"),
    fault!("a request is loaded in reset", "compact", "blysk_handshake.sv",
        "in_valid_i && !rst_i}" => "in_valid_i || rst_i}", "or the handshake"),
    fault!("nothing moves in reset", "compact", "blysk_handshake.sv",
        "assign load_o  = advance & offered;" => "assign load_o  = rst_i ? '0 : advance & offered;", " is "),
    fault!("a valid flag out of nothing", "compact", "blysk_handshake.sv",
        "assign valid_d = (advance & offered)"
            => "assign valid_d = {3'b0, valid_q == 6'b1, 2'b0} | (advance & offered)",
        "valid flag of rank 2 is 1, expected 0"),
    fault!("c1 loads while it stalls", "compact", "blysk.sv",
        ".load_i(load[FRONT_END+HELD-1:FRONT_END]), .value_i(chosen)"
            => ".load_i(load[FRONT_END+HELD-1:FRONT_END] | {HELD{i == 1}}), .value_i(chosen)", ".c1 is"),
    fault!("a stage loads while it stalls", "compact", "blysk_stage.sv",
        "if (load_i[LAST]) t_q <= t_d;" => "t_q <= t_d;", "stage"),
    fault!("the outer segment takes the inner one's c2", "precise", "blysk.sv",
        "beyond[k] ? fields[PLACE+:WIDTH]" => "beyond[k] && i != 2 ? fields[PLACE+:WIDTH]", ".c2 is"),
    fault!("the cut not in the unit of x", "small_ends", "blysk_front_end.sv",
        "'(of_row) << CUT_UP;" => "'(of_row);", "front_end."),
    fault!("the second segment counts from the hand-over in its own unit", "small_ends", "blysk_front_end.sv",
        "S_WIDTH'(of_row) << HAND_OVER_UP" => "S_WIDTH'(of_row)", "front_end.v is"),
    fault!("the product loads while it stalls", "small_deep", "blysk_stage.sv",
        "if (load_i[OPERAND_RANKS+PRODUCT_RANKS-1]) product_q <= product_d;" => "product_q <= product_d;", "product"),
    fault!("the sum loses a bit that rounding needs", "small_deep", "blysk_stage.sv",
        "localparam int KEPT = T_WIDTH + DROP + 1;" => "localparam int KEPT = T_WIDTH + DROP - 1;", "_sum.sum"),
    fault!("a copied operand loads while it stalls", "small_deep", "blysk_stage.sv",
        ".load_i(load_i[0]), .value_i(variable_i)" => ".load_i(1'b1), .value_i(variable_i)", "operands.v"),
    fault!("the word loads a rank before the comparisons", "small_lines_deep", "blysk.sv",
        ".load_i(load[COMPARE]), .value_i(word" => ".load_i(load[COMPARE-1]), .value_i(word", "compare."),
    fault!("the divisor's x does not wait for its sum", "small_tail_deep", "blysk_tail.sv",
        "DIGITS_WIDTH)'(x_divided) << DIVIDEND_UP" => "DIGITS_WIDTH)'(x_i) << DIVIDEND_UP", "tail3."),
    fault!("the spare entry is overwritten", "small_sliced", "blysk_ready_slice.sv",
        "in_valid_i && !valid_q[1];" => "in_valid_i;", "output_slice"),
    fault!("the head takes what comes before what waits", "small_sliced_input", "blysk_ready_slice.sv",
        "valid_q[1] ? spare_q : value_i" => "value_i", "input_slice.head"),
    fault!("what advances is worked out from too few ranks", "small_sliced", "blysk_handshake.sv",
        "!(&valid_d[RANKS-1:rank])" => "!valid_d[RANKS-1]", "handshake"),
    fault!("bubbles collapse where they stay", "small_enable", "blysk_handshake.sv",
        "advance = {RANKS{out_ready_i}};" => "advance = {RANKS{out_ready_i}} | ~valid_q;", "handshake"),
    fault!("the reset waits for the clock", "small_enable", "blysk.sv",
        ".RANKS(RANKS), .KIND(HANDSHAKE), .READY_AHEAD(OUTPUT_SLICE), .RESET_ASYNCHRONOUS(ASYNCHRONOUS)"
            => ".RANKS(RANKS), .KIND(HANDSHAKE), .READY_AHEAD(OUTPUT_SLICE)", "handshake"),
    fault!("the divisor adds", "paper", "blysk_tail.sv",
        ".SUBTRACT(1)" => ".SUBTRACT(0)", "tail0.divisor is"),
    fault!("the dividend a place too low", "paper", "blysk_tail.sv",
        "<< DIVIDEND_UP;" => "<< (DIVIDEND_UP - 1);", "tail0.remainder is"),
    fault!("a quotient bit wrong at equality", "schlick", "blysk_tail_digits.sv",
        "doubled >= {1'b0, divisor_i}" => "doubled > {1'b0, divisor_i}", "remainder is"),
    fault!("the divisor is not carried", "paper", "blysk_tail_digits.sv",
        "if (load_i) divisor_q <= divisor_i;" => "if (load_i) divisor_q <= '0;", "tail1.divisor is"),
    fault!("quotient not rounded", "paper", "blysk_clamp.sv",
        ".MODE(QUOTIENT_ROUNDING)" => ".MODE(blysk_pkg::ROUND_FLOOR)", "clamp.intensity"),
    fault!("polynomial and tail swapped", "paper", "blysk_clamp.sv",
        "REGION_POLYNOMIAL: intensity_d = polynomial;"
            => "REGION_POLYNOMIAL: intensity_d = quotient;", "clamp.intensity"),
];

impl Fault {
    /// The file with the wrong line.
    ///
    /// # Errors
    /// When the right text does not stand there exactly once.
    pub fn apply(&self, text: &str) -> Result<String, Failure> {
        source_text::replace_once(text, self.right, self.wrong)
            .or_else(|places| failed(format!("{}: {:?} is {places} times in {}", self.name, self.right, self.file)))
    }

    /// Plants the fault into a directory of RTL.
    ///
    /// # Errors
    /// As [`Fault::apply`], and when the file cannot be read or written.
    pub fn plant(&self, directory: &Path) -> Result<(), Failure> {
        let path = directory.join(self.file);
        let text = std::fs::read_to_string(&path)
            .map_err(|error| Failure(format!("cannot read {}: {error}", path.display())))?;
        std::fs::write(&path, self.apply(&text)?)
            .map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))
    }
}

#[cfg(test)]
mod tests {
    use hw_model::rtl::SOURCES;

    use super::*;

    /// The simulators are the last part of `make test`; a line that was rewritten is found here.
    #[test]
    fn every_fault_finds_its_line() {
        assert!(FAULTS.len() > 20);
        for fault in FAULTS {
            let (_, text) = SOURCES.iter().find(|(name, _)| *name == fault.file).unwrap();
            assert_ne!(fault.apply(text).unwrap(), *text, "{}", fault.name);
        }
    }
}
