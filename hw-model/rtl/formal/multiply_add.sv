// The multiply-add line as it is written on paper: addend +- multiplicand * variable, exact, in a
// width where nothing can overflow, and rounded to an integer of the result's unit (rounded_o).
`default_nettype none

module multiply_add #(
  parameter int MULTIPLICAND_WIDTH  = 1,
  parameter int MULTIPLICAND_SIGNED = 0,
  parameter int VARIABLE_WIDTH      = 1,
  parameter int ADDEND_WIDTH        = 1,
  parameter int ADDEND_SIGNED       = 0,
  parameter int SUBTRACT            = 1,
  parameter int PRODUCT_UP          = 0,
  parameter int ADDEND_UP           = 0,
  parameter int RESULT_UP           = 0,
  parameter int DROP                = 0,
  parameter int ROUNDING            = blysk_pkg::ROUND_NEAREST_UP,
  parameter int WIDE                = 1
) (
  input  logic        [MULTIPLICAND_WIDTH-1:0] multiplicand_i,
  input  logic        [VARIABLE_WIDTH-1:0]     variable_i,
  input  logic        [ADDEND_WIDTH-1:0]       addend_i,
  output logic signed [WIDE-1:0]               exact_o,     // DROP bits finer than the result
  output logic signed [WIDE-1:0]               rounded_o
);

  localparam logic signed [WIDE-1:0] ONE = 1;

  logic signed [WIDE-1:0] multiplicand, variable, addend, product;
  assign multiplicand = MULTIPLICAND_SIGNED != 0 ? WIDE'($signed(multiplicand_i)) : WIDE'(multiplicand_i);
  assign variable     = WIDE'(variable_i);
  assign addend       = ADDEND_SIGNED != 0 ? WIDE'($signed(addend_i)) : WIDE'(addend_i);
  assign product      = multiplicand * variable;
  assign exact_o      = SUBTRACT != 0
      ? ((addend <<< ADDEND_UP) - (product <<< PRODUCT_UP)) <<< RESULT_UP
      : ((addend <<< ADDEND_UP) + (product <<< PRODUCT_UP)) <<< RESULT_UP;

  // floor(exact / 2^DROP), and the part that floor leaves over, in twice the unit of exact.
  logic signed [WIDE-1:0] below, rest;
  assign below = exact_o >>> DROP;
  assign rest  = (exact_o - (below <<< DROP)) <<< 1;

  always_comb begin
    rounded_o = below;
    case (ROUNDING)
      blysk_pkg::ROUND_NEAREST_UP:
        if (rest >= (ONE <<< DROP)) rounded_o = below + ONE;
      blysk_pkg::ROUND_NEAREST_EVEN:
        if (rest > (ONE <<< DROP) || (rest == (ONE <<< DROP) && below[0])) rounded_o = below + ONE;
      blysk_pkg::ROUND_TOWARD_ZERO:
        if (rest != 0 && below < 0) rounded_o = below + ONE;
      default: rounded_o = below;
    endcase
  end

endmodule

`default_nettype wire
