// One multiply-add stage against the line on paper, for all operands of their widths.
//
//   exact     with a result register that is wide enough for anything (SUM_WIDTH), the stage gives the
//             rounded exact value: so no product, sum or carry of the rounding overflows
//   in_format where that value lies in the format of the register, the register holds it
//
// load_i is free where the stage has one rank: the register may wait any time. With more ranks, all of them load in
// every cycle here; that they wait for each other is proved of the pipeline (pipeline.svh).
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
  parameter int ROUNDING            = blysk_pkg::ROUND_NEAREST_UP,
  parameter int OPERAND_RANKS       = 0,
  parameter int PRODUCT_RANKS       = 0,
  parameter int SUM_RANKS           = 0
) (
  input logic                          clk_i,
  input logic [OPERAND_RANKS+PRODUCT_RANKS+SUM_RANKS:0] load_i,
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
    .RESULT_UP(RESULT_UP), .DROP(DROP), .SUM_WIDTH(SUM_WIDTH), .ROUNDING(ROUNDING),
    .OPERAND_RANKS(OPERAND_RANKS), .PRODUCT_RANKS(PRODUCT_RANKS), .SUM_RANKS(SUM_RANKS)
  ) stage (
    .clk_i, .load_i, .multiplicand_i, .variable_i, .addend_i, .variable_o(), .t_o(t)
  );

  blysk_stage #(
    .MULTIPLICAND_WIDTH(MULTIPLICAND_WIDTH), .MULTIPLICAND_SIGNED(MULTIPLICAND_SIGNED),
    .VARIABLE_WIDTH(VARIABLE_WIDTH), .ADDEND_WIDTH(ADDEND_WIDTH), .ADDEND_SIGNED(ADDEND_SIGNED),
    .T_WIDTH(SUM_WIDTH), .SUBTRACT(SUBTRACT), .PRODUCT_UP(PRODUCT_UP), .ADDEND_UP(ADDEND_UP),
    .RESULT_UP(RESULT_UP), .DROP(DROP), .SUM_WIDTH(SUM_WIDTH), .ROUNDING(ROUNDING),
    .OPERAND_RANKS(OPERAND_RANKS), .PRODUCT_RANKS(PRODUCT_RANKS), .SUM_RANKS(SUM_RANKS)
  ) wide_stage (
    .clk_i, .load_i, .multiplicand_i, .variable_i, .addend_i, .variable_o(), .t_o(t_wide)
  );

  // The operands of an addend come before it, and its sum may wait behind it.
  localparam int BEFORE = OPERAND_RANKS + PRODUCT_RANKS;
  localparam int LAST   = BEFORE + SUM_RANKS;
  logic [MULTIPLICAND_WIDTH-1:0] multiplicand;
  logic [VARIABLE_WIDTH-1:0]     variable;
  if (LAST > 0) begin : several_ranks
    always_comb assume (load_i == '1);
  end
  if (BEFORE > 0) begin : operands_before
    blysk_delay #(.WIDTH(MULTIPLICAND_WIDTH), .RANKS(BEFORE)) multiplicand_delay (
      .clk_i, .load_i(load_i[BEFORE-1:0]), .value_i(multiplicand_i), .value_o(multiplicand));
    blysk_delay #(.WIDTH(VARIABLE_WIDTH), .RANKS(BEFORE)) variable_delay (
      .clk_i, .load_i(load_i[BEFORE-1:0]), .value_i(variable_i), .value_o(variable));
  end else begin : operands_beside
    assign multiplicand = multiplicand_i;
    assign variable     = variable_i;
  end

  logic signed [WIDE-1:0] exact, rounded;
  multiply_add #(
    .MULTIPLICAND_WIDTH(MULTIPLICAND_WIDTH), .MULTIPLICAND_SIGNED(MULTIPLICAND_SIGNED),
    .VARIABLE_WIDTH(VARIABLE_WIDTH), .ADDEND_WIDTH(ADDEND_WIDTH), .ADDEND_SIGNED(ADDEND_SIGNED),
    .SUBTRACT(SUBTRACT), .PRODUCT_UP(PRODUCT_UP), .ADDEND_UP(ADDEND_UP), .RESULT_UP(RESULT_UP),
    .DROP(DROP), .ROUNDING(ROUNDING), .WIDE(WIDE)
  ) line (
    .multiplicand_i(multiplicand), .variable_i(variable), .addend_i, .exact_o(exact), .rounded_o(rounded)
  );

  logic signed [WIDE-1:0] rounded_late, expected;
  blysk_delay #(.WIDTH(WIDE), .RANKS(1), .STORED(SUM_RANKS)) rounded_delay (
    .clk_i, .load_i(load_i[BEFORE]), .value_i(rounded), .value_o(rounded_late));

  logic [LAST:0] ranks_filled;
  logic          loaded;
  filled #(.RANKS(LAST + 1)) stage_filled (.clk_i, .load_i, .filled_o(ranks_filled));
  assign loaded = ranks_filled[LAST];
  always_ff @(posedge clk_i) begin
    if (load_i[LAST]) expected <= rounded_late;
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
