// The coefficient ROM: one word for each exponent, and the fields of a word. Twin of src/rom.rs.
//
// The word is read into a register, as a block RAM does it, when rank 0 (fetch) loads, and where the configuration has
// one (ROM_RANKS), into another register behind that. Fields that are
// the same in every row take no place in the word; they are constants here. An address without a word
// reads the first one, so that nothing stands between the memory and its register; no_word_o says
// that the address had none.
`timescale 1ns / 1ps
`default_nettype none

module blysk_rom #(
  parameter ROM_FILE = "rom.mem"
) (
  input  logic                                clk_i,
  input  logic [blysk_pkg::ROM_RANKS:0]       load_i,       // of the memory, and of the register behind it
  input  logic [blysk_pkg::ADDRESS_WIDTH-1:0] address_i,
  output logic                                no_word_o,    // of the memory's register
  // Every field, stored or constant, at its place in the package.
  output logic [blysk_pkg::FIELDS_WIDTH-1:0]  fields_o
);

  // ---- Of the configuration -----------------------------------------------------------------------
  localparam int ADDRESS_WIDTH   = blysk_pkg::ADDRESS_WIDTH;
  localparam int ROM_DEPTH       = blysk_pkg::ROM_DEPTH;
  localparam int ROM_INDEX_WIDTH = blysk_pkg::ROM_INDEX_WIDTH;
  localparam int ROM_WIDTH       = blysk_pkg::ROM_WIDTH;
  localparam int ROM_RANKS       = blysk_pkg::ROM_RANKS;
  localparam int FIELDS          = blysk_pkg::FIELDS;
  localparam int FIELDS_WIDTH    = blysk_pkg::FIELDS_WIDTH;
  localparam logic [32*FIELDS-1:0]    FIELD_WIDTH    = blysk_pkg::FIELD_WIDTH;
  localparam logic [32*FIELDS-1:0]    FIELD_STORED   = blysk_pkg::FIELD_STORED;
  localparam logic [32*FIELDS-1:0]    FIELD_LSB      = blysk_pkg::FIELD_LSB;
  localparam logic [32*FIELDS-1:0]    FIELD_PLACE    = blysk_pkg::FIELD_PLACE;
  localparam logic [FIELDS_WIDTH-1:0] FIELD_CONSTANT = blysk_pkg::FIELD_CONSTANT;

  // ---- The memory -------------------------------------------------------------------------------
  logic [ROM_WIDTH-1:0] words[0:ROM_DEPTH-1];
  initial $readmemh(ROM_FILE, words);

  logic                       has_word;
  logic [ROM_INDEX_WIDTH-1:0] index;
  logic [ROM_WIDTH-1:0]       word_q, word;
  logic                       no_word_q;

  // The address port has at least one value more than there are words.
  assign has_word = address_i < ADDRESS_WIDTH'(ROM_DEPTH);
  assign index    = has_word ? address_i[ROM_INDEX_WIDTH-1:0] : '0;

  always_ff @(posedge clk_i) begin
    if (load_i[0]) begin
      word_q    <= words[index];
      no_word_q <= !has_word;
    end
  end
  assign no_word_o = no_word_q;

  blysk_delay #(.WIDTH(ROM_WIDTH), .RANKS(1), .STORED(ROM_RANKS)) word_behind (
    .clk_i, .load_i(load_i[ROM_RANKS]), .value_i(word_q), .value_o(word));

  // ---- The fields of the word, or their constants -------------------------------------------------
  genvar i;
  generate
    for (i = 0; i < FIELDS; i = i + 1) begin : field
      localparam int WIDTH = FIELD_WIDTH[32*i+:32];
      localparam int PLACE = FIELD_PLACE[32*i+:32];
      localparam int LSB   = FIELD_LSB[32*i+:32];
      logic [WIDTH-1:0] value;
      if (FIELD_STORED[32*i]) begin : stored
        assign value = word[LSB+:WIDTH];
      end else begin : constant
        assign value = FIELD_CONSTANT[PLACE+:WIDTH];
      end
      assign fields_o[PLACE+:WIDTH] = value;
      if (ROM_RANKS != 0 && FIELD_STORED[32*i]) begin : behind
        // For testbenches: the field before the register behind the memory.
        logic [WIDTH-1:0] fetched;
        assign fetched = word_q[LSB+:WIDTH];
        logic unused;
        assign unused = &{1'b0, fetched};
      end
    end
  endgenerate

`ifndef SYNTHESIS
`ifndef FORMAL
  // ---- The image, in simulators ---------------------------------------------------------------------
  // Where an image gives no word, $readmemh leaves x or 0, and the intensity becomes a valid 0: `if` and `case`
  // take x for false. So a simulation ends at once unless the image is ROM_DEPTH words of ROM_WIDTH bits in
  // hex, between spaces, ends of lines and // comments.
  localparam int WORD_DIGITS = (ROM_WIDTH + 3) / 4;
  // The first digit of a word that has all its digits is less.
  localparam int FIRST_BELOW = 1 << (ROM_WIDTH - 4 * (WORD_DIGITS - 1));

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
      $fatal(1, "%0s, line %0d: no words of %0d bits in hex", ROM_FILE, wrong, ROM_WIDTH);
    else if (found != ROM_DEPTH)
      $fatal(1, "%0s: the ROM image has %0d words and must have %0d", ROM_FILE, found, ROM_DEPTH);
    else
      $fclose(file);
  end
`endif
`endif

endmodule

`default_nettype wire
