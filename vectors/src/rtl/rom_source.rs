//! The ROM's words in the source, for tools that read no memory files.
//!
//! The words stand in a `case`, which every synthesiser takes: those for ASICs leave out initial values of memories,
//! and those for FPGAs find the block RAM in it. The module has no `ROM_FILE` then, and nothing looks for an image.

use hw_model::design::Design;

use crate::rom_image::words;

/// What is exchanged in `blysk_rom.sv` and `blysk.sv`, each of which has some of it.
const PARAMETER: &str = " #(\n  parameter ROM_FILE = \"rom.mem\"\n)";
const HANDED_ON: &str = " #(\n    .ROM_FILE(ROM_FILE)\n  )";
const MEMORY: &str = "  logic [ROM_WIDTH-1:0] words[0:ROM_DEPTH-1];\n  initial $readmemh(ROM_FILE, words);\n";
const READ: &str = "words[index]";
/// The last part of the ROM's source, up to its end: what simulators look for in an image.
const IMAGE: [&str; 2] = ["`ifndef SYNTHESIS\n", "endmodule\n"];

/// The text of a source in which the words of the design stand where the memory was.
#[must_use]
pub fn in_source(text: &str, design: &Design) -> String {
    let text = text.replace(PARAMETER, "").replace(HANDED_ON, "");
    let Some((before, after)) = text.split_once(MEMORY) else { return text };
    let text = format!("{before}{}{after}", memory(design)).replace(READ, "content(index)");
    match text.split_once(IMAGE[0]).and_then(|(kept, rest)| Some((kept, rest.split_once(IMAGE[1])?.1))) {
        Some((kept, rest)) => format!("{kept}{}{rest}", IMAGE[1]),
        None => text,
    }
}

/// The words by their index, and 0 behind the last one, which no address reads.
fn memory(design: &Design) -> String {
    let width = design.rom().layout().word_width().max(1);
    let digits = width.div_ceil(4) as usize;
    let mut text =
        "  function automatic logic [ROM_WIDTH-1:0] content(input logic [ROM_INDEX_WIDTH-1:0] place);\n".to_owned();
    text += "    case (place)\n";
    for (index, word) in words(design).enumerate() {
        text += &format!("      ROM_INDEX_WIDTH'({index}): content = {width}'h{word:0digits$x};\n");
    }
    text + "      default: content = '0;\n    endcase\n  endfunction\n"
}
