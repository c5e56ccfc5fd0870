// One line of the three: what a stage's register has to hold.
`default_nettype none

module line #(
  parameter int MULTIPLICAND_WIDTH  = 1,
  parameter int MULTIPLICAND_SIGNED = 0,
  parameter int VARIABLE_WIDTH      = 1,
  parameter int ADDEND_WIDTH        = 1,
  parameter int ADDEND_SIGNED       = 0,
  parameter int T_WIDTH             = 1,
  parameter int SUBTRACT            = 1,
  parameter int PRODUCT_UP          = 0,
  parameter int ADDEND_UP           = 0,
  parameter int RESULT_UP           = 0,
  parameter int DROP                = 0,
  parameter int SUM_WIDTH           = 1,
  parameter int ROUNDING            = blysk_pkg::ROUND_NEAREST_UP
) (
  input  logic [MULTIPLICAND_WIDTH-1:0] multiplicand_i,
  input  logic [VARIABLE_WIDTH-1:0]     variable_i,
  input  logic [ADDEND_WIDTH-1:0]       addend_i,
  output logic [T_WIDTH-1:0]            t_o
);

  logic signed [SUM_WIDTH-1:0] rounded;
  multiply_add #(
    .MULTIPLICAND_WIDTH(MULTIPLICAND_WIDTH), .MULTIPLICAND_SIGNED(MULTIPLICAND_SIGNED),
    .VARIABLE_WIDTH(VARIABLE_WIDTH), .ADDEND_WIDTH(ADDEND_WIDTH), .ADDEND_SIGNED(ADDEND_SIGNED),
    .SUBTRACT(SUBTRACT), .PRODUCT_UP(PRODUCT_UP), .ADDEND_UP(ADDEND_UP), .RESULT_UP(RESULT_UP),
    .DROP(DROP), .ROUNDING(ROUNDING), .WIDE(SUM_WIDTH)
  ) exact (
    .multiplicand_i, .variable_i, .addend_i, .exact_o(), .rounded_o(rounded)
  );
  assign t_o = T_WIDTH'(rounded);

endmodule

`default_nettype wire
