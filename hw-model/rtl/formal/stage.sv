// One multiply-add stage against the line on paper, for all operands of their widths.
//
//   exact     with a result register that is wide enough for anything (SUM_WIDTH), the stage gives the
//             rounded exact value: so no product, sum or carry of the rounding overflows
//   in_format where that value lies in the format of the register, the register holds it
//
// load_i is free: the register may wait any time.
`default_nettype none

module stage_proof #(
  parameter int MULTIPLICAND_WIDTH  = 1,
  parameter int MULTIPLICAND_SIGNED = 0,
  parameter int VARIABLE_WIDTH      = 1,
  parameter int ADDEND_WIDTH        = 1,
  parameter int ADDEND_SIGNED       = 0,
  parameter int T_WIDTH             = 1,
  parameter int T_SIGNED            = 0,
  parameter int SUBTRACT            = 1,
  parameter int PRODUCT_UP          = 0,
  parameter int ADDEND_UP           = 0,
  parameter int RESULT_UP           = 0,
  parameter int DROP                = 0,
  parameter int SUM_WIDTH           = 1,
  parameter int ROUNDING            = blysk_pkg::ROUND_NEAREST_UP
) (
  input logic                          clk_i,
  input logic                          load_i,
  input logic [MULTIPLICAND_WIDTH-1:0] multiplicand_i,
  input logic [VARIABLE_WIDTH-1:0]     variable_i,
  input logic [ADDEND_WIDTH-1:0]       addend_i
);

  localparam int PRODUCT_BITS = MULTIPLICAND_WIDTH + VARIABLE_WIDTH + PRODUCT_UP;
  localparam int ADDEND_BITS  = ADDEND_WIDTH + ADDEND_UP;
  localparam int WIDE         = (PRODUCT_BITS > ADDEND_BITS ? PRODUCT_BITS : ADDEND_BITS) + RESULT_UP + 5;
  localparam logic signed [WIDE-1:0] ONE      = 1;
  localparam logic signed [WIDE-1:0] LEAST    = T_SIGNED != 0 ? -(ONE <<< (T_WIDTH - 1)) : 0;
  localparam logic signed [WIDE-1:0] GREATEST = (ONE <<< (T_SIGNED != 0 ? T_WIDTH - 1 : T_WIDTH)) - ONE;

  logic        [T_WIDTH-1:0]   t;
  logic signed [SUM_WIDTH-1:0] t_wide;

  blysk_stage #(
    .MULTIPLICAND_WIDTH(MULTIPLICAND_WIDTH), .MULTIPLICAND_SIGNED(MULTIPLICAND_SIGNED),
    .VARIABLE_WIDTH(VARIABLE_WIDTH), .ADDEND_WIDTH(ADDEND_WIDTH), .ADDEND_SIGNED(ADDEND_SIGNED),
    .T_WIDTH(T_WIDTH), .SUBTRACT(SUBTRACT), .PRODUCT_UP(PRODUCT_UP), .ADDEND_UP(ADDEND_UP),
    .RESULT_UP(RESULT_UP), .DROP(DROP), .SUM_WIDTH(SUM_WIDTH), .ROUNDING(ROUNDING)
  ) stage (
    .clk_i, .load_i, .multiplicand_i, .variable_i, .addend_i, .t_o(t)
  );

  blysk_stage #(
    .MULTIPLICAND_WIDTH(MULTIPLICAND_WIDTH), .MULTIPLICAND_SIGNED(MULTIPLICAND_SIGNED),
    .VARIABLE_WIDTH(VARIABLE_WIDTH), .ADDEND_WIDTH(ADDEND_WIDTH), .ADDEND_SIGNED(ADDEND_SIGNED),
    .T_WIDTH(SUM_WIDTH), .SUBTRACT(SUBTRACT), .PRODUCT_UP(PRODUCT_UP), .ADDEND_UP(ADDEND_UP),
    .RESULT_UP(RESULT_UP), .DROP(DROP), .SUM_WIDTH(SUM_WIDTH), .ROUNDING(ROUNDING)
  ) wide_stage (
    .clk_i, .load_i, .multiplicand_i, .variable_i, .addend_i, .t_o(t_wide)
  );

  logic signed [WIDE-1:0] exact, rounded;
  multiply_add #(
    .MULTIPLICAND_WIDTH(MULTIPLICAND_WIDTH), .MULTIPLICAND_SIGNED(MULTIPLICAND_SIGNED),
    .VARIABLE_WIDTH(VARIABLE_WIDTH), .ADDEND_WIDTH(ADDEND_WIDTH), .ADDEND_SIGNED(ADDEND_SIGNED),
    .SUBTRACT(SUBTRACT), .PRODUCT_UP(PRODUCT_UP), .ADDEND_UP(ADDEND_UP), .RESULT_UP(RESULT_UP),
    .DROP(DROP), .ROUNDING(ROUNDING), .WIDE(WIDE)
  ) line (
    .multiplicand_i, .variable_i, .addend_i, .exact_o(exact), .rounded_o(rounded)
  );

  logic                   loaded;
  logic signed [WIDE-1:0] expected;
  initial loaded = 1'b0;
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      loaded   <= 1'b1;
      expected <= rounded;
    end
  end

  always_comb begin
    if (loaded) begin
      exact_result: assert (WIDE'(t_wide) == expected);
      if (expected >= LEAST && expected <= GREATEST)
        in_format: assert ((T_SIGNED != 0 ? WIDE'($signed(t)) : WIDE'(t)) == expected);
    end
  end

  logic unused;
  assign unused = &{1'b0, exact};

endmodule

`default_nettype wire
