// The coefficient ROM: one word for each exponent, and the fields of a word. Twin of src/rom.rs.
//
// The word is read into a register, as a block RAM does it, when rank 0 (fetch) loads. Fields that are
// the same in every row take no place in the word; they are constants here. An address without a word
// reads the first one, so that nothing stands between the memory and its register; no_word_o says
// that the address had none.
`timescale 1ns / 1ps
`default_nettype none

module blysk_rom #(
  parameter ROM_FILE = "rom.mem"
) (
  input  logic                                clk_i,
  input  logic                                load_i,
  input  logic [blysk_pkg::ADDRESS_WIDTH-1:0] address_i,
  output logic                                no_word_o,
  output logic [blysk_pkg::C3_WIDTH-1:0]      c3_o,
  output logic [blysk_pkg::C2_WIDTH-1:0]      c2_o,
  output logic [blysk_pkg::C1_WIDTH-1:0]      c1_o,
  output logic [blysk_pkg::C0_WIDTH-1:0]      c0_o,
  output logic [blysk_pkg::CUT_WIDTH-1:0]     cut_o,
  output logic [blysk_pkg::SHIFT_WIDTH-1:0]   shift_o,
  output logic [blysk_pkg::C3_OUTER_WIDTH-1:0] c3_outer_o,
  output logic [blysk_pkg::C2_OUTER_WIDTH-1:0] c2_outer_o,
  output logic [blysk_pkg::C1_OUTER_WIDTH-1:0] c1_outer_o,
  output logic [blysk_pkg::C0_OUTER_WIDTH-1:0] c0_outer_o,
  output logic [blysk_pkg::HAND_OVER_WIDTH-1:0]   hand_over_o,
  output logic [blysk_pkg::SHIFT_OUTER_WIDTH-1:0] shift_outer_o,
  output logic [blysk_pkg::TAIL_A_WIDTH-1:0]  tail_a_o,
  output logic [blysk_pkg::TAIL_B_WIDTH-1:0]  tail_b_o
);

  // ---- The memory -------------------------------------------------------------------------------
  logic [blysk_pkg::ROM_WIDTH-1:0] words[0:blysk_pkg::ROM_DEPTH-1];
  initial $readmemh(ROM_FILE, words);

  logic                       has_word;
  logic [blysk_pkg::ROM_INDEX_WIDTH-1:0] index;
  logic [blysk_pkg::ROM_WIDTH-1:0]       word_q;
  logic                       no_word_q;

  // The address port has at least one value more than there are words.
  assign has_word = address_i < blysk_pkg::ADDRESS_WIDTH'(blysk_pkg::ROM_DEPTH);
  assign index    = has_word ? address_i[blysk_pkg::ROM_INDEX_WIDTH-1:0] : '0;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      word_q    <= words[index];
      no_word_q <= !has_word;
    end
  end
  assign no_word_o = no_word_q;

  // ---- The fields of the word, or their constants -------------------------------------------------
  if (blysk_pkg::C3_STORED != 0) begin : c3
    assign c3_o = word_q[blysk_pkg::C3_LSB+:blysk_pkg::C3_WIDTH];
  end else begin : c3_constant
    assign c3_o = blysk_pkg::C3_CONSTANT;
  end
  if (blysk_pkg::C2_STORED != 0) begin : c2
    assign c2_o = word_q[blysk_pkg::C2_LSB+:blysk_pkg::C2_WIDTH];
  end else begin : c2_constant
    assign c2_o = blysk_pkg::C2_CONSTANT;
  end
  if (blysk_pkg::C1_STORED != 0) begin : c1
    assign c1_o = word_q[blysk_pkg::C1_LSB+:blysk_pkg::C1_WIDTH];
  end else begin : c1_constant
    assign c1_o = blysk_pkg::C1_CONSTANT;
  end
  if (blysk_pkg::C0_STORED != 0) begin : c0
    assign c0_o = word_q[blysk_pkg::C0_LSB+:blysk_pkg::C0_WIDTH];
  end else begin : c0_constant
    assign c0_o = blysk_pkg::C0_CONSTANT;
  end
  if (blysk_pkg::CUT_STORED != 0) begin : cut
    assign cut_o = word_q[blysk_pkg::CUT_LSB+:blysk_pkg::CUT_WIDTH];
  end else begin : cut_constant
    assign cut_o = blysk_pkg::CUT_CONSTANT;
  end
  if (blysk_pkg::SHIFT_STORED != 0) begin : shift
    assign shift_o = word_q[blysk_pkg::SHIFT_LSB+:blysk_pkg::SHIFT_WIDTH];
  end else begin : shift_constant
    assign shift_o = blysk_pkg::SHIFT_CONSTANT;
  end
  if (blysk_pkg::TAIL_A_STORED != 0) begin : tail_a
    assign tail_a_o = word_q[blysk_pkg::TAIL_A_LSB+:blysk_pkg::TAIL_A_WIDTH];
  end else begin : tail_a_constant
    assign tail_a_o = blysk_pkg::TAIL_A_CONSTANT;
  end
  if (blysk_pkg::TAIL_B_STORED != 0) begin : tail_b
    assign tail_b_o = word_q[blysk_pkg::TAIL_B_LSB+:blysk_pkg::TAIL_B_WIDTH];
  end else begin : tail_b_constant
    assign tail_b_o = blysk_pkg::TAIL_B_CONSTANT;
  end
  if (blysk_pkg::C3_OUTER_STORED != 0) begin : c3_outer
    assign c3_outer_o = word_q[blysk_pkg::C3_OUTER_LSB+:blysk_pkg::C3_OUTER_WIDTH];
  end else begin : c3_outer_constant
    assign c3_outer_o = blysk_pkg::C3_OUTER_CONSTANT;
  end
  if (blysk_pkg::C2_OUTER_STORED != 0) begin : c2_outer
    assign c2_outer_o = word_q[blysk_pkg::C2_OUTER_LSB+:blysk_pkg::C2_OUTER_WIDTH];
  end else begin : c2_outer_constant
    assign c2_outer_o = blysk_pkg::C2_OUTER_CONSTANT;
  end
  if (blysk_pkg::C1_OUTER_STORED != 0) begin : c1_outer
    assign c1_outer_o = word_q[blysk_pkg::C1_OUTER_LSB+:blysk_pkg::C1_OUTER_WIDTH];
  end else begin : c1_outer_constant
    assign c1_outer_o = blysk_pkg::C1_OUTER_CONSTANT;
  end
  if (blysk_pkg::C0_OUTER_STORED != 0) begin : c0_outer
    assign c0_outer_o = word_q[blysk_pkg::C0_OUTER_LSB+:blysk_pkg::C0_OUTER_WIDTH];
  end else begin : c0_outer_constant
    assign c0_outer_o = blysk_pkg::C0_OUTER_CONSTANT;
  end
  if (blysk_pkg::HAND_OVER_STORED != 0) begin : hand_over
    assign hand_over_o = word_q[blysk_pkg::HAND_OVER_LSB+:blysk_pkg::HAND_OVER_WIDTH];
  end else begin : hand_over_constant
    assign hand_over_o = blysk_pkg::HAND_OVER_CONSTANT;
  end
  if (blysk_pkg::SHIFT_OUTER_STORED != 0) begin : shift_outer
    assign shift_outer_o = word_q[blysk_pkg::SHIFT_OUTER_LSB+:blysk_pkg::SHIFT_OUTER_WIDTH];
  end else begin : shift_outer_constant
    assign shift_outer_o = blysk_pkg::SHIFT_OUTER_CONSTANT;
  end

`ifndef SYNTHESIS
`ifndef FORMAL
  // ---- The image, in simulators ---------------------------------------------------------------------
  // Where an image gives no word, $readmemh leaves x or 0, and the intensity becomes a valid 0: `if` and `case`
  // take x for false. So a simulation ends at once unless the image is ROM_DEPTH words of ROM_WIDTH bits in
  // hex, between spaces, ends of lines and // comments.
  localparam int WORD_DIGITS = (blysk_pkg::ROM_WIDTH + 3) / 4;
  // The first digit of a word that has all its digits is less.
  localparam int FIRST_BELOW = 1 << (blysk_pkg::ROM_WIDTH - 4 * (WORD_DIGITS - 1));

  initial begin : image
    // A letter is its number in ASCII.
    integer file, letter, slashes, digit, digits, first, line, found, wrong;
    file = $fopen(ROM_FILE, "r");
    line = 1;
    slashes = 0;
    digits = 0;
    first = 0;
    found = 0;
    wrong = 0;
    letter = file == 0 ? -1 : $fgetc(file);
    while (letter >= 0 && wrong == 0) begin
      digit = -1;
      if (letter >= 48 && letter <= 57) digit = letter - 48;
      if (letter >= 65 && letter <= 70) digit = letter - 65 + 10;
      if (letter >= 97 && letter <= 102) digit = letter - 97 + 10;
      if (slashes == 2 && letter != 10) begin
        // The rest of the line is a comment.
      end else if (letter == 47) begin
        slashes = slashes + 1;
        digits = 0;
      end else if (slashes == 1 || (digit < 0 && letter != 32 && (letter < 9 || letter > 13))) begin
        wrong = line;
      end else if (digit < 0) begin
        slashes = 0;
        digits = 0;
        if (letter == 10) line = line + 1;
      end else begin
        if (digits == 0) begin
          first = digit;
          found = found + 1;
        end
        digits = digits + 1;
        if (digits > WORD_DIGITS || (digits == WORD_DIGITS && first >= FIRST_BELOW)) wrong = line;
      end
      letter = $fgetc(file);
    end
    if (file == 0)
      $fatal(1, "%0s: the ROM image is not there", ROM_FILE);
    else if (wrong != 0)
      $fatal(1, "%0s, line %0d: no words of %0d bits in hex", ROM_FILE, wrong, blysk_pkg::ROM_WIDTH);
    else if (found != blysk_pkg::ROM_DEPTH)
      $fatal(1, "%0s: the ROM image has %0d words and must have %0d", ROM_FILE, found, blysk_pkg::ROM_DEPTH);
    else
      $fclose(file);
  end
`endif
`endif

endmodule

`default_nettype wire
