// The fields of a ROM word, by the layout in the package.
`default_nettype none

module blysk_fields (
  input  logic [blysk_pkg::ROM_WIDTH-1:0]    word_i,
  output logic [blysk_pkg::C3_WIDTH-1:0]     c3_o,
  output logic [blysk_pkg::C2_WIDTH-1:0]     c2_o,
  output logic [blysk_pkg::C1_WIDTH-1:0]     c1_o,
  output logic [blysk_pkg::C0_WIDTH-1:0]     c0_o,
  output logic [blysk_pkg::CUT_WIDTH-1:0]    cut_o,
  output logic [blysk_pkg::SHIFT_WIDTH-1:0]  shift_o,
  output logic [blysk_pkg::C3_OUTER_WIDTH-1:0] c3_outer_o,
  output logic [blysk_pkg::C2_OUTER_WIDTH-1:0] c2_outer_o,
  output logic [blysk_pkg::C1_OUTER_WIDTH-1:0] c1_outer_o,
  output logic [blysk_pkg::C0_OUTER_WIDTH-1:0] c0_outer_o,
  output logic [blysk_pkg::HAND_OVER_WIDTH-1:0] hand_over_o,
  output logic [blysk_pkg::SHIFT_OUTER_WIDTH-1:0] shift_outer_o,
  output logic [blysk_pkg::TAIL_A_WIDTH-1:0] tail_a_o,
  output logic [blysk_pkg::TAIL_B_WIDTH-1:0] tail_b_o
);

  assign c3_o = blysk_pkg::C3_STORED != 0
    ? blysk_pkg::C3_WIDTH'(word_i >> blysk_pkg::C3_LSB) : blysk_pkg::C3_CONSTANT;
  assign c2_o = blysk_pkg::C2_STORED != 0
    ? blysk_pkg::C2_WIDTH'(word_i >> blysk_pkg::C2_LSB) : blysk_pkg::C2_CONSTANT;
  assign c1_o = blysk_pkg::C1_STORED != 0
    ? blysk_pkg::C1_WIDTH'(word_i >> blysk_pkg::C1_LSB) : blysk_pkg::C1_CONSTANT;
  assign c0_o = blysk_pkg::C0_STORED != 0
    ? blysk_pkg::C0_WIDTH'(word_i >> blysk_pkg::C0_LSB) : blysk_pkg::C0_CONSTANT;
  assign cut_o = blysk_pkg::CUT_STORED != 0
    ? blysk_pkg::CUT_WIDTH'(word_i >> blysk_pkg::CUT_LSB) : blysk_pkg::CUT_CONSTANT;
  assign shift_o = blysk_pkg::SHIFT_STORED != 0
    ? blysk_pkg::SHIFT_WIDTH'(word_i >> blysk_pkg::SHIFT_LSB) : blysk_pkg::SHIFT_CONSTANT;
  assign tail_a_o = blysk_pkg::TAIL_A_STORED != 0
    ? blysk_pkg::TAIL_A_WIDTH'(word_i >> blysk_pkg::TAIL_A_LSB) : blysk_pkg::TAIL_A_CONSTANT;
  assign tail_b_o = blysk_pkg::TAIL_B_STORED != 0
    ? blysk_pkg::TAIL_B_WIDTH'(word_i >> blysk_pkg::TAIL_B_LSB) : blysk_pkg::TAIL_B_CONSTANT;
  assign c3_outer_o = blysk_pkg::C3_OUTER_STORED != 0
    ? blysk_pkg::C3_OUTER_WIDTH'(word_i >> blysk_pkg::C3_OUTER_LSB) : blysk_pkg::C3_OUTER_CONSTANT;
  assign c2_outer_o = blysk_pkg::C2_OUTER_STORED != 0
    ? blysk_pkg::C2_OUTER_WIDTH'(word_i >> blysk_pkg::C2_OUTER_LSB) : blysk_pkg::C2_OUTER_CONSTANT;
  assign c1_outer_o = blysk_pkg::C1_OUTER_STORED != 0
    ? blysk_pkg::C1_OUTER_WIDTH'(word_i >> blysk_pkg::C1_OUTER_LSB) : blysk_pkg::C1_OUTER_CONSTANT;
  assign c0_outer_o = blysk_pkg::C0_OUTER_STORED != 0
    ? blysk_pkg::C0_OUTER_WIDTH'(word_i >> blysk_pkg::C0_OUTER_LSB) : blysk_pkg::C0_OUTER_CONSTANT;
  assign hand_over_o = blysk_pkg::HAND_OVER_STORED != 0
    ? blysk_pkg::HAND_OVER_WIDTH'(word_i >> blysk_pkg::HAND_OVER_LSB) : blysk_pkg::HAND_OVER_CONSTANT;
  assign shift_outer_o = blysk_pkg::SHIFT_OUTER_STORED != 0
    ? blysk_pkg::SHIFT_OUTER_WIDTH'(word_i >> blysk_pkg::SHIFT_OUTER_LSB) : blysk_pkg::SHIFT_OUTER_CONSTANT;

endmodule

`default_nettype wire
