// In place of blysk_rom: the request brings its own ROM word, so that what is proved holds for every
// content. The address port is as wide as a word, plus a bit that says that there is none.
`default_nettype none

module blysk_rom #(
  parameter ROM_FILE = ""
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
  output logic [blysk_pkg::HAND_OVER_WIDTH-1:0] hand_over_o,
  output logic [blysk_pkg::SHIFT_OUTER_WIDTH-1:0] shift_outer_o,
  output logic [blysk_pkg::TAIL_A_WIDTH-1:0]  tail_a_o,
  output logic [blysk_pkg::TAIL_B_WIDTH-1:0]  tail_b_o
);

  logic [blysk_pkg::ROM_WIDTH-1:0] word;
  logic                            no_word;

  always_ff @(posedge clk_i) begin
    if (load_i) {no_word, word} <= address_i;
  end
  assign no_word_o = no_word;

  blysk_fields fields (
    .word_i(word),
    .c3_o, .c2_o, .c1_o, .c0_o, .cut_o, .shift_o, .tail_a_o, .tail_b_o,
    .c3_outer_o, .c2_outer_o, .c1_outer_o, .c0_outer_o, .hand_over_o, .shift_outer_o
  );

endmodule

`default_nettype wire
