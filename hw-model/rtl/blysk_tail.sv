// The tail: x / (A - B*x) by a restoring divider. Twin of src/datapath/tail.rs.
//
// The divisor D = A - B*x is a multiply-add stage. The quotient then comes bit by bit, most significant
// first (blysk_tail_digits), QUOTIENT_BITS_PER_STAGE of them in each rank.
//
// Widths. The dividend is x moved up by DIVIDEND_UP. Its part above the low DIGITS_WIDTH bits is the
// first remainder, less than D because the quotient fits DIGITS_WIDTH bits; its low bits wait in
// `digits`, from whose top they leave as quotient bits come in at the bottom.
//
// load_i has one bit for each rank of the division: the divisor's, and one for each digit stage.
`timescale 1ns / 1ps
`default_nettype none

module blysk_tail (
  input  logic                                 clk_i,
  input  logic [blysk_pkg::DIGIT_STAGES:0]     load_i,
  input  logic [blysk_pkg::X_WIDTH-1:0]        x_i,
  input  logic [blysk_pkg::TAIL_A_WIDTH-1:0]   a_i,
  input  logic [blysk_pkg::TAIL_B_WIDTH-1:0]   b_i,
  output logic [blysk_pkg::DIVISOR_WIDTH-1:0]  remainder_o,
  output logic [blysk_pkg::DIGITS_WIDTH-1:0]   digits_o
);

  localparam int STEPS        = blysk_pkg::DIGIT_STAGES;
  localparam int DIVISOR_BITS = blysk_pkg::DIVISOR_WIDTH;
  localparam int DIGIT_BITS   = blysk_pkg::DIGITS_WIDTH;

  // What enters each digit stage, side by side; at the end the finished division.
  logic [(STEPS+1)*DIVISOR_BITS-1:0] divisor;
  logic [(STEPS+1)*DIVISOR_BITS-1:0] remainder;
  logic [(STEPS+1)*DIGIT_BITS-1:0]   digits;

  // ---- The divisor, and the dividend cut in two ---------------------------------------------------
  blysk_stage #(
    .MULTIPLICAND_WIDTH(blysk_pkg::TAIL_B_WIDTH), .MULTIPLICAND_SIGNED(blysk_pkg::TAIL_B_SIGNED),
    .VARIABLE_WIDTH(blysk_pkg::X_WIDTH),
    .ADDEND_WIDTH(blysk_pkg::TAIL_A_WIDTH), .ADDEND_SIGNED(blysk_pkg::TAIL_A_SIGNED),
    .T_WIDTH(blysk_pkg::DIVISOR_WIDTH), .SUBTRACT(1),
    .PRODUCT_UP(blysk_pkg::DIVISOR_PRODUCT_UP), .ADDEND_UP(blysk_pkg::DIVISOR_ADDEND_UP),
    .RESULT_UP(blysk_pkg::DIVISOR_RESULT_UP), .DROP(blysk_pkg::DIVISOR_DROP),
    .SUM_WIDTH(blysk_pkg::DIVISOR_SUM_WIDTH), .ROUNDING(blysk_pkg::DIVISOR_ROUNDING)
  ) divisor_stage (
    .clk_i, .load_i(load_i[0]),
    .multiplicand_i(b_i), .variable_i(x_i), .addend_i(a_i), .t_o(divisor[DIVISOR_BITS-1:0])
  );

  logic [DIVISOR_BITS+DIGIT_BITS-1:0] dividend;
  logic [DIVISOR_BITS-1:0]            remainder_q;
  logic [DIGIT_BITS-1:0]              digits_q;

  assign dividend = (DIVISOR_BITS + DIGIT_BITS)'(x_i) << blysk_pkg::DIVIDEND_UP;
  always_ff @(posedge clk_i) begin
    if (load_i[0]) {remainder_q, digits_q} <= dividend;
  end
  assign remainder[DIVISOR_BITS-1:0] = remainder_q;
  assign digits[DIGIT_BITS-1:0]      = digits_q;

  // ---- The quotient bits --------------------------------------------------------------------------
  genvar step;
  generate
    for (step = 0; step < STEPS; step = step + 1) begin : digit_stage
      localparam int MOST  = blysk_pkg::QUOTIENT_BITS_PER_STAGE;
      localparam int LEFT  = DIGIT_BITS - step * MOST;
      localparam int COUNT = LEFT < MOST ? LEFT : MOST;
      blysk_tail_digits #(
        .COUNT(COUNT), .LAST(step == STEPS - 1 ? 1 : 0)
      ) quotient_bits (
        .clk_i, .load_i(load_i[step+1]),
        .divisor_i(divisor[step*DIVISOR_BITS+:DIVISOR_BITS]),
        .remainder_i(remainder[step*DIVISOR_BITS+:DIVISOR_BITS]),
        .digits_i(digits[step*DIGIT_BITS+:DIGIT_BITS]),
        .divisor_o(divisor[(step+1)*DIVISOR_BITS+:DIVISOR_BITS]),
        .remainder_o(remainder[(step+1)*DIVISOR_BITS+:DIVISOR_BITS]),
        .digits_o(digits[(step+1)*DIGIT_BITS+:DIGIT_BITS])
      );
    end
  endgenerate

  assign remainder_o = remainder[STEPS*DIVISOR_BITS+:DIVISOR_BITS];
  assign digits_o    = digits[STEPS*DIGIT_BITS+:DIGIT_BITS];

  logic unused;
  assign unused = &{1'b0, divisor[STEPS*DIVISOR_BITS+:DIVISOR_BITS]};

endmodule

`default_nettype wire
