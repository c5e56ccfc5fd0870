// The tail: x / (A - B*x) by a restoring divider. Twin of src/datapath/tail.rs.
//
// The divisor D = A - B*x is a multiply-add stage. The quotient then comes bit by bit, most significant
// first (blysk_tail_digits), QUOTIENT_BITS_PER_STAGE of them in each rank.
//
// Widths. The dividend is x moved up by DIVIDEND_UP. Its part above the low DIGITS_WIDTH bits is the
// first remainder, less than D because the quotient fits DIGITS_WIDTH bits; its low bits wait in
// `digits`, from whose top they leave as quotient bits come in at the bottom.
//
// load_i has one bit for each rank of the division: those of the divisor's multiply-add, and one for each digit stage.
// A waits outside for as long as it is added late; x goes along to the dividend.
`timescale 1ns / 1ps
`default_nettype none

module blysk_tail (
  input  logic                                 clk_i,
  input  logic [blysk_pkg::OPERAND_RANKS+blysk_pkg::PRODUCT_RANKS+blysk_pkg::SUM_RANKS
                +blysk_pkg::DIGIT_STAGES:0]    load_i,
  input  logic [blysk_pkg::X_WIDTH-1:0]        x_i,
  input  logic [blysk_pkg::TAIL_A_WIDTH-1:0]   a_i,
  input  logic [blysk_pkg::TAIL_B_WIDTH-1:0]   b_i,
  output logic [blysk_pkg::DIVISOR_WIDTH-1:0]  remainder_o,
  output logic [blysk_pkg::DIGITS_WIDTH-1:0]   digits_o
);

  // ---- Of the configuration -----------------------------------------------------------------------
  localparam int OPERAND_RANKS           = blysk_pkg::OPERAND_RANKS;
  localparam int PRODUCT_RANKS           = blysk_pkg::PRODUCT_RANKS;
  localparam int SUM_RANKS               = blysk_pkg::SUM_RANKS;
  localparam int X_WIDTH                 = blysk_pkg::X_WIDTH;
  localparam int TAIL_A_WIDTH            = blysk_pkg::TAIL_A_WIDTH;
  localparam int TAIL_A_SIGNED           = blysk_pkg::TAIL_A_SIGNED;
  localparam int TAIL_B_WIDTH            = blysk_pkg::TAIL_B_WIDTH;
  localparam int TAIL_B_SIGNED           = blysk_pkg::TAIL_B_SIGNED;
  localparam int DIVISOR_WIDTH           = blysk_pkg::DIVISOR_WIDTH;
  localparam int DIGITS_WIDTH            = blysk_pkg::DIGITS_WIDTH;
  localparam int DIVISOR_PRODUCT_UP      = blysk_pkg::DIVISOR_PRODUCT_UP;
  localparam int DIVISOR_ADDEND_UP       = blysk_pkg::DIVISOR_ADDEND_UP;
  localparam int DIVISOR_RESULT_UP       = blysk_pkg::DIVISOR_RESULT_UP;
  localparam int DIVISOR_DROP            = blysk_pkg::DIVISOR_DROP;
  localparam int DIVISOR_SUM_WIDTH       = blysk_pkg::DIVISOR_SUM_WIDTH;
  localparam int DIVISOR_ROUNDING        = blysk_pkg::DIVISOR_ROUNDING;
  localparam int DIVIDEND_UP             = blysk_pkg::DIVIDEND_UP;
  localparam int DIGIT_STAGES            = blysk_pkg::DIGIT_STAGES;
  localparam int QUOTIENT_BITS_PER_STAGE = blysk_pkg::QUOTIENT_BITS_PER_STAGE;

  // What enters each digit stage, side by side; at the end the finished division.
  logic [(DIGIT_STAGES+1)*DIVISOR_WIDTH-1:0] divisor;
  logic [(DIGIT_STAGES+1)*DIVISOR_WIDTH-1:0] remainder;
  logic [(DIGIT_STAGES+1)*DIGITS_WIDTH-1:0]  digits;

  // ---- The divisor, and the dividend cut in two ---------------------------------------------------
  // The divisor's rank.
  localparam int DIVIDED = OPERAND_RANKS + PRODUCT_RANKS + SUM_RANKS;
  logic [X_WIDTH-1:0] x_multiplied, x_divided;
  blysk_stage #(
    .MULTIPLICAND_WIDTH(TAIL_B_WIDTH), .MULTIPLICAND_SIGNED(TAIL_B_SIGNED),
    .MULTIPLICAND_STORED(blysk_pkg::TAIL_B_STORED),
    .VARIABLE_WIDTH(X_WIDTH),
    .ADDEND_WIDTH(TAIL_A_WIDTH), .ADDEND_SIGNED(TAIL_A_SIGNED),
    .T_WIDTH(DIVISOR_WIDTH), .SUBTRACT(1),
    .PRODUCT_UP(DIVISOR_PRODUCT_UP), .ADDEND_UP(DIVISOR_ADDEND_UP),
    .RESULT_UP(DIVISOR_RESULT_UP), .DROP(DIVISOR_DROP),
    .SUM_WIDTH(DIVISOR_SUM_WIDTH), .ROUNDING(DIVISOR_ROUNDING),
    .OPERAND_RANKS(OPERAND_RANKS), .PRODUCT_RANKS(PRODUCT_RANKS), .SUM_RANKS(SUM_RANKS)
  ) divisor_stage (
    .clk_i, .load_i(load_i[DIVIDED:0]),
    .multiplicand_i(b_i), .variable_i(x_i), .addend_i(a_i),
    .variable_o(x_multiplied), .t_o(divisor[DIVISOR_WIDTH-1:0])
  );

  if (DIVIDED > OPERAND_RANKS) begin : x_waits
    blysk_delay #(.WIDTH(X_WIDTH), .RANKS(DIVIDED - OPERAND_RANKS)) x_delay (
      .clk_i, .load_i(load_i[DIVIDED-1:OPERAND_RANKS]), .value_i(x_multiplied), .value_o(x_divided));
  end else begin : x_goes_on
    assign x_divided = x_multiplied;
  end

  logic [DIVISOR_WIDTH+DIGITS_WIDTH-1:0] dividend;
  logic [DIVISOR_WIDTH-1:0]              remainder_q;
  logic [DIGITS_WIDTH-1:0]               digits_q;

  assign dividend = (DIVISOR_WIDTH + DIGITS_WIDTH)'(x_divided) << DIVIDEND_UP;
  always_ff @(posedge clk_i) begin
    if (load_i[DIVIDED]) {remainder_q, digits_q} <= dividend;
  end
  assign remainder[DIVISOR_WIDTH-1:0] = remainder_q;
  assign digits[DIGITS_WIDTH-1:0]     = digits_q;

  // ---- The quotient bits --------------------------------------------------------------------------
  genvar step;
  generate
    for (step = 0; step < DIGIT_STAGES; step = step + 1) begin : digit_stage
      localparam int MOST  = QUOTIENT_BITS_PER_STAGE;
      localparam int LEFT  = DIGITS_WIDTH - step * MOST;
      localparam int COUNT = LEFT < MOST ? LEFT : MOST;
      blysk_tail_digits #(
        .COUNT(COUNT), .LAST(step == DIGIT_STAGES - 1 ? 1 : 0)
      ) quotient_bits (
        .clk_i, .load_i(load_i[DIVIDED+step+1]),
        .divisor_i(divisor[step*DIVISOR_WIDTH+:DIVISOR_WIDTH]),
        .remainder_i(remainder[step*DIVISOR_WIDTH+:DIVISOR_WIDTH]),
        .digits_i(digits[step*DIGITS_WIDTH+:DIGITS_WIDTH]),
        .divisor_o(divisor[(step+1)*DIVISOR_WIDTH+:DIVISOR_WIDTH]),
        .remainder_o(remainder[(step+1)*DIVISOR_WIDTH+:DIVISOR_WIDTH]),
        .digits_o(digits[(step+1)*DIGITS_WIDTH+:DIGITS_WIDTH])
      );
    end
  endgenerate

  assign remainder_o = remainder[DIGIT_STAGES*DIVISOR_WIDTH+:DIVISOR_WIDTH];
  assign digits_o    = digits[DIGIT_STAGES*DIGITS_WIDTH+:DIGITS_WIDTH];

  logic unused;
  assign unused = &{1'b0, divisor[DIGIT_STAGES*DIVISOR_WIDTH+:DIVISOR_WIDTH]};

endmodule

`default_nettype wire
