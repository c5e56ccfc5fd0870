// One rank of the divider: COUNT quotient bits by restoring long division, and their registers.
// Twin of Divider::digit in src/datapath/tail.rs.
//
//   remainder <- 2*remainder + (next bit of the dividend)
//   if remainder >= D:  remainder <- remainder - D, quotient bit 1     else: quotient bit 0
//
// Widths: every remainder is less than D, so doubling it takes one bit more than D has.
// After the last quotient bit the divisor is not needed any more and gets no register (LAST = 1).
`timescale 1ns / 1ps
`default_nettype none

module blysk_tail_digits #(
  parameter int COUNT = 2,
  parameter int LAST  = 0
) (
  input  logic                                clk_i,
  input  logic                                load_i,
  input  logic [blysk_pkg::DIVISOR_WIDTH-1:0] divisor_i,
  input  logic [blysk_pkg::DIVISOR_WIDTH-1:0] remainder_i,
  input  logic [blysk_pkg::DIGITS_WIDTH-1:0]  digits_i,
  output logic [blysk_pkg::DIVISOR_WIDTH-1:0] divisor_o,
  output logic [blysk_pkg::DIVISOR_WIDTH-1:0] remainder_o,
  output logic [blysk_pkg::DIGITS_WIDTH-1:0]  digits_o
);

  // ---- Of the configuration -----------------------------------------------------------------------
  localparam int DIVISOR_WIDTH = blysk_pkg::DIVISOR_WIDTH;
  localparam int DIGITS_WIDTH  = blysk_pkg::DIGITS_WIDTH;

  logic [DIVISOR_WIDTH-1:0] remainder_d, remainder_q;
  logic [DIGITS_WIDTH-1:0]  digits_d, digits_q;

  // The bits are taken by shifts and casts: simulators differ in how they follow selects of a variable
  // that is written in the same block.
  logic [DIVISOR_WIDTH:0] doubled;
  logic                   next_bit, goes;

  always_comb begin
    remainder_d = remainder_i;
    digits_d    = digits_i;
    doubled     = '0;
    next_bit    = 1'b0;
    goes        = 1'b0;
    for (int place = 0; place < COUNT; place++) begin
      next_bit    = 1'(digits_d >> (DIGITS_WIDTH - 1));
      doubled     = {remainder_d, next_bit};
      goes        = doubled >= {1'b0, divisor_i};
      remainder_d = DIVISOR_WIDTH'(goes ? doubled - {1'b0, divisor_i} : doubled);
      digits_d    = (digits_d << 1) | DIGITS_WIDTH'(goes);
    end
  end

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      remainder_q <= remainder_d;
      digits_q    <= digits_d;
    end
  end
  assign remainder_o = remainder_q;
  assign digits_o    = digits_q;

  if (LAST != 0) begin : last
    assign divisor_o = '0;
  end else begin : carried
    logic [DIVISOR_WIDTH-1:0] divisor_q;
    always_ff @(posedge clk_i) begin
      if (load_i) divisor_q <= divisor_i;
    end
    assign divisor_o = divisor_q;
  end

endmodule

`default_nettype wire
