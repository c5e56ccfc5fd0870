// One multiply-add stage: t = addend +- multiplicand * variable, rounded once, and its register.
// Twin of src/datapath/stage.rs.
//
// The three stages of the polynomial (Horner's rule) and the divisor of the tail are this module:
//
//   stage    power form        centred form      tail
//   1        t1 = c2 + c3*v    t1 = c2 - c3*v    D = A - B*x
//   2        t2 = c1 + t1*v    t2 = c1 - t1*v
//   3        t3 = c0 + t2*v    t3 = c0 - t2*v
//
// Widths: with m, v, a, t the fraction bits of multiplicand, variable, addend and result, the product
// is kept whole (m + v fraction bits); product and addend are moved up to the larger of m + v and a
// (PRODUCT_UP, ADDEND_UP: no bit is lost), added, and only then rounded to t: DROP bits go, or
// RESULT_UP zeros come. SUM_WIDTH has room for a sign, the carry of the sum and that of the rounding.
// That T_WIDTH holds every result follows from the range analysis of the ROM (src/budget).
`timescale 1ns / 1ps
`default_nettype none

module blysk_stage #(
  parameter int MULTIPLICAND_WIDTH  = 18,
  parameter int MULTIPLICAND_SIGNED = 0,
  parameter int VARIABLE_WIDTH      = 18,
  parameter int ADDEND_WIDTH        = 18,
  parameter int ADDEND_SIGNED       = 0,
  parameter int T_WIDTH             = 18,
  parameter int SUBTRACT            = 1,
  parameter int PRODUCT_UP          = 0,
  parameter int ADDEND_UP           = 0,
  parameter int RESULT_UP           = 0,
  parameter int DROP                = 17,
  parameter int SUM_WIDTH           = 39,
  parameter int ROUNDING            = blysk_pkg::ROUND_NEAREST_UP
) (
  input  logic                          clk_i,
  input  logic                          load_i,
  input  logic [MULTIPLICAND_WIDTH-1:0] multiplicand_i,
  input  logic [VARIABLE_WIDTH-1:0]     variable_i,
  input  logic [ADDEND_WIDTH-1:0]       addend_i,
  output logic [T_WIDTH-1:0]            t_o
);

  // ---- The product, whole -------------------------------------------------------------------------
  logic signed [SUM_WIDTH-1:0] product;

  if (MULTIPLICAND_SIGNED != 0) begin : signed_product
    logic signed [MULTIPLICAND_WIDTH+VARIABLE_WIDTH:0] whole;
    assign whole   = $signed(multiplicand_i) * $signed({1'b0, variable_i});
    assign product = SUM_WIDTH'(whole);
  end else if (MULTIPLICAND_WIDTH == 1) begin : one_bit
    // Coefficients that are all 0 or a power of two: no multiplier.
    assign product = multiplicand_i[0] ? SUM_WIDTH'(variable_i) : '0;
  end else begin : unsigned_product
    logic [MULTIPLICAND_WIDTH+VARIABLE_WIDTH-1:0] whole;
    assign whole   = multiplicand_i * variable_i;
    assign product = SUM_WIDTH'(whole);
  end

  // ---- The sum, at the common place ---------------------------------------------------------------
  logic signed [SUM_WIDTH-1:0] addend, sum;

  if (ADDEND_SIGNED != 0) begin : signed_addend
    assign addend = SUM_WIDTH'($signed(addend_i));
  end else begin : unsigned_addend
    assign addend = SUM_WIDTH'(addend_i);
  end
  if (SUBTRACT != 0) begin : subtract
    assign sum = ((addend <<< ADDEND_UP) - (product <<< PRODUCT_UP)) <<< RESULT_UP;
  end else begin : add
    assign sum = ((addend <<< ADDEND_UP) + (product <<< PRODUCT_UP)) <<< RESULT_UP;
  end

  // ---- Rounded once -------------------------------------------------------------------------------
  logic [T_WIDTH-1:0] t_d, t_q;

  blysk_round_shift #(
    .IN_WIDTH(SUM_WIDTH), .DROP(DROP), .OUT_WIDTH(T_WIDTH), .MODE(ROUNDING)
  ) round_sum (
    .value_i(sum), .rounded_o(t_d)
  );

  always_ff @(posedge clk_i) begin
    if (load_i) t_q <= t_d;
  end
  assign t_o = t_q;

endmodule

`default_nettype wire
