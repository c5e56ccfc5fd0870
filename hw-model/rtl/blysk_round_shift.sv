// The one place where fraction bits are dropped: value / 2^DROP, rounded to an integer by MODE.
// Twin of src/rounding.rs.
//
//   MODE                chooses                               added before the shift
//   ROUND_FLOOR         the integer below                     0
//   ROUND_NEAREST_UP    the nearest, a tie to the one above   half
//   ROUND_NEAREST_EVEN  the nearest, a tie to the even one    half - 1 + (last bit of the integer below)
//   ROUND_TOWARD_ZERO   the integer beside it nearer to zero  2^DROP - 1 where the value is negative
//
// Widths: IN_WIDTH has room for the carry of what is added. OUT_WIDTH holds every result that can
// occur (argued where the module is instantiated); the bits above it are copies of the sign.
`timescale 1ns / 1ps
`default_nettype none

module blysk_round_shift #(
  parameter int IN_WIDTH  = 8,
  parameter int DROP      = 2,
  parameter int OUT_WIDTH = 6,
  parameter int MODE      = blysk_pkg::ROUND_NEAREST_UP
) (
  input  logic signed [IN_WIDTH-1:0]  value_i,
  output logic        [OUT_WIDTH-1:0] rounded_o
);

  logic signed [IN_WIDTH-1:0] shifted;
  assign rounded_o = OUT_WIDTH'(shifted);

  if (DROP == 0) begin : exact
    assign shifted = value_i;
  end else begin : dropping
    localparam logic [IN_WIDTH-1:0] HALF = IN_WIDTH'(1) << (DROP - 1);
    logic [IN_WIDTH-1:0] added;
    if (MODE == blysk_pkg::ROUND_FLOOR) begin : floor
      assign added = '0;
    end else if (MODE == blysk_pkg::ROUND_NEAREST_UP) begin : nearest_up
      assign added = HALF;
    end else if (MODE == blysk_pkg::ROUND_NEAREST_EVEN) begin : nearest_even
      assign added = HALF - IN_WIDTH'(1) + IN_WIDTH'(value_i[DROP]);
    end else begin : toward_zero
      assign added = value_i[IN_WIDTH-1] ? (HALF << 1) - IN_WIDTH'(1) : '0;
    end
    logic signed [IN_WIDTH-1:0] sum;
    assign sum     = value_i + $signed(added);
    assign shifted = sum >>> DROP;
  end

  // Copies of the sign, and what the rounding dropped.
  logic unused;
  assign unused = &{1'b0, shifted, value_i};

endmodule

`default_nettype wire
