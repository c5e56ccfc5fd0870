// One multiply-add stage: t = addend +- multiplicand * variable, rounded once, and its registers.
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
//
// The result has a register; copies of the operands, the product and the sum have one each where OPERAND_RANKS,
// PRODUCT_RANKS and SUM_RANKS say so. load_i has one bit for each of these ranks, the result's last. The addend comes
// as late as it is added, and variable_o is the variable as the multiplier reads it.
`timescale 1ns / 1ps
`default_nettype none

module blysk_stage #(
  parameter int MULTIPLICAND_WIDTH  = 18,
  parameter int MULTIPLICAND_SIGNED = 0,
  parameter int MULTIPLICAND_STORED = 1,
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
  parameter int ROUNDING            = blysk_pkg::ROUND_NEAREST_UP,
  parameter int OPERAND_RANKS       = 0,
  parameter int PRODUCT_RANKS       = 0,
  parameter int SUM_RANKS           = 0
) (
  input  logic                          clk_i,
  input  logic [OPERAND_RANKS+PRODUCT_RANKS+SUM_RANKS:0] load_i,
  input  logic [MULTIPLICAND_WIDTH-1:0] multiplicand_i,
  input  logic [VARIABLE_WIDTH-1:0]     variable_i,
  input  logic [ADDEND_WIDTH-1:0]       addend_i,
  output logic [VARIABLE_WIDTH-1:0]     variable_o,
  output logic [T_WIDTH-1:0]            t_o
);

  // ---- The operands -------------------------------------------------------------------------------
  logic [MULTIPLICAND_WIDTH-1:0] multiplicand;
  logic [VARIABLE_WIDTH-1:0]     variable;
  assign variable_o = variable;

  if (OPERAND_RANKS != 0) begin : operands
    blysk_delay #(.WIDTH(MULTIPLICAND_WIDTH), .RANKS(1), .STORED(MULTIPLICAND_STORED)) multiplicand_copy (
      .clk_i, .load_i(load_i[0]), .value_i(multiplicand_i), .value_o(multiplicand));
    blysk_delay #(.WIDTH(VARIABLE_WIDTH), .RANKS(1)) variable_copy (
      .clk_i, .load_i(load_i[0]), .value_i(variable_i), .value_o(variable));
  end else begin : no_operands
    assign multiplicand = multiplicand_i;
    assign variable     = variable_i;
  end

  // ---- The product, whole -------------------------------------------------------------------------
  // A signed multiplicand meets a variable that is given a sign, which makes one bit more.
  localparam int WHOLE = MULTIPLICAND_WIDTH + VARIABLE_WIDTH + (MULTIPLICAND_SIGNED != 0 ? 1 : 0);
  logic        [WHOLE-1:0]     whole, product_d, kept;
  logic signed [SUM_WIDTH-1:0] product;

  if (MULTIPLICAND_SIGNED != 0) begin : signed_product
    assign whole   = $signed(multiplicand) * $signed({1'b0, variable});
    assign product = SUM_WIDTH'($signed(kept));
  end else if (MULTIPLICAND_WIDTH == 1) begin : one_bit
    // Coefficients that are all 0 or a power of two: no multiplier.
    assign whole   = multiplicand[0] ? WHOLE'(variable) : '0;
    assign product = SUM_WIDTH'(kept);
  end else begin : unsigned_product
    assign whole   = multiplicand * variable;
    assign product = SUM_WIDTH'(kept);
  end

  // Where the product takes two ranks, an operand of more than PIECE bits has a lower piece of PIECE bits and an upper
  // one with the others. Each multiplier takes a piece of both; their products, at their places, make up the whole.
  if (PRODUCT_RANKS > 1) begin : pieces
    localparam int PIECE   = blysk_pkg::PRODUCT_PIECE;
    localparam int UPPERS  = MULTIPLICAND_WIDTH > PIECE ? 2 : 1;
    localparam int COLUMNS = VARIABLE_WIDTH > PIECE ? 2 : 1;
    // The products at their places, side by side.
    logic [UPPERS*COLUMNS*WHOLE-1:0] placed;
    always_comb begin
      product_d = '0;
      for (int part = 0; part < UPPERS * COLUMNS; part++) product_d = product_d + placed[part*WHOLE+:WHOLE];
    end
    genvar m, v;
    for (m = 0; m < UPPERS; m = m + 1) begin : upper
      localparam int M_WIDTH  = m + 1 < UPPERS ? PIECE : MULTIPLICAND_WIDTH - m * PIECE;
      localparam int M_SIGNED = m + 1 < UPPERS ? 0 : MULTIPLICAND_SIGNED;
      for (v = 0; v < COLUMNS; v = v + 1) begin : by
        localparam int V_WIDTH = v + 1 < COLUMNS ? PIECE : VARIABLE_WIDTH - v * PIECE;
        localparam int WIDTH   = M_WIDTH + V_WIDTH + (M_SIGNED != 0 ? 1 : 0);
        localparam int NUMBER  = m * COLUMNS + v;
        logic [M_WIDTH-1:0] of_multiplicand;
        logic [V_WIDTH-1:0] of_variable;
        logic [WIDTH-1:0]   part_d, part_q;
        assign of_multiplicand = multiplicand[m*PIECE+:M_WIDTH];
        assign of_variable     = variable[v*PIECE+:V_WIDTH];
        always_ff @(posedge clk_i) begin
          if (load_i[OPERAND_RANKS]) part_q <= part_d;
        end
        if (M_SIGNED != 0) begin : signed_part
          assign part_d = $signed(of_multiplicand) * $signed({1'b0, of_variable});
          assign placed[NUMBER*WHOLE+:WHOLE] = WHOLE'($signed(part_q)) << ((m + v) * PIECE);
        end else if (M_WIDTH == 1) begin : one_bit_part
          assign part_d = of_multiplicand[0] ? WIDTH'(of_variable) : '0;
          assign placed[NUMBER*WHOLE+:WHOLE] = WHOLE'(part_q) << ((m + v) * PIECE);
        end else begin : unsigned_part
          assign part_d = of_multiplicand * of_variable;
          assign placed[NUMBER*WHOLE+:WHOLE] = WHOLE'(part_q) << ((m + v) * PIECE);
        end
      end
    end
    logic unused;
    assign unused = &{1'b0, whole};
  end else begin : whole_at_once
    assign product_d = whole;
  end

  if (PRODUCT_RANKS != 0) begin : product_register
    logic [WHOLE-1:0] product_q;
    always_ff @(posedge clk_i) begin
      if (load_i[OPERAND_RANKS+PRODUCT_RANKS-1]) product_q <= product_d;
    end
    assign kept = product_q;
  end else begin : no_product_register
    assign kept = product_d;
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

  // A bit more than the result and what is rounded off: rounding may bring a sum into its format from just outside.
  logic signed [SUM_WIDTH-1:0] rounded_sum;

  if (SUM_RANKS != 0) begin : sum_register
    localparam int KEPT = T_WIDTH + DROP + 1;
    logic [KEPT-1:0] sum_q;
    always_ff @(posedge clk_i) begin
      if (load_i[OPERAND_RANKS+PRODUCT_RANKS]) sum_q <= KEPT'(sum);
    end
    assign rounded_sum = SUM_WIDTH'($signed(sum_q));
    // A format wider than its values has copies of the sign.
    logic unused;
    assign unused = &{1'b0, sum_q, sum};
  end else begin : no_sum_register
    assign rounded_sum = sum;
  end

  // ---- Rounded once -------------------------------------------------------------------------------
  localparam int LAST = OPERAND_RANKS + PRODUCT_RANKS + SUM_RANKS;
  logic [T_WIDTH-1:0] t_d, t_q;

  blysk_round_shift #(
    .IN_WIDTH(SUM_WIDTH), .DROP(DROP), .OUT_WIDTH(T_WIDTH), .MODE(ROUNDING)
  ) round_sum (
    .value_i(rounded_sum), .rounded_o(t_d)
  );

  always_ff @(posedge clk_i) begin
    if (load_i[LAST]) t_q <= t_d;
  end
  assign t_o = t_q;

endmodule

`default_nettype wire
