// In place of blysk_stage, and of the line it computes: a function in which every bit of every operand
// counts, but which costs the solver nothing. With it the pipeline is proved at its full widths: that
// the operands of each line are those of one result. The lines themselves are proved in stage.sv.
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

  // Each operand at a place of its own, folded to the width of the result.
  localparam int WIDE  = MULTIPLICAND_WIDTH + VARIABLE_WIDTH + ADDEND_WIDTH;
  localparam int FOLDS = (WIDE + T_WIDTH - 1) / T_WIDTH;
  logic [FOLDS*T_WIDTH-1:0] operands;
  assign operands = (FOLDS*T_WIDTH)'({multiplicand_i, variable_i, addend_i});
  always_comb begin
    t_o = '0;
    for (int fold = 0; fold < FOLDS; fold++) t_o = t_o ^ operands[fold*T_WIDTH+:T_WIDTH];
  end

endmodule

module blysk_stage #(
  parameter int MULTIPLICAND_WIDTH  = 1,
  parameter int MULTIPLICAND_SIGNED = 0,
  parameter int MULTIPLICAND_STORED = 1,
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

  // Up to the last rank operands wait for each other as product and sum would; the addend comes with the product.
  localparam int LAST = OPERAND_RANKS + PRODUCT_RANKS + SUM_RANKS;
  logic [MULTIPLICAND_WIDTH-1:0] multiplicand;
  logic [VARIABLE_WIDTH-1:0]     variable;
  logic [ADDEND_WIDTH-1:0]       addend;

  if (LAST > 0) begin : operands_wait
    blysk_delay #(.WIDTH(MULTIPLICAND_WIDTH), .RANKS(LAST), .STORED(MULTIPLICAND_STORED)) multiplicand_delay (
      .clk_i, .load_i(load_i[LAST-1:0]), .value_i(multiplicand_i), .value_o(multiplicand));
    blysk_delay #(.WIDTH(VARIABLE_WIDTH), .RANKS(LAST)) variable_delay (
      .clk_i, .load_i(load_i[LAST-1:0]), .value_i(variable_i), .value_o(variable));
  end else begin : operands_go_on
    assign multiplicand = multiplicand_i;
    assign variable     = variable_i;
  end
  if (SUM_RANKS > 0) begin : addend_waits
    blysk_delay #(.WIDTH(ADDEND_WIDTH), .RANKS(1)) addend_delay (
      .clk_i, .load_i(load_i[LAST-1]), .value_i(addend_i), .value_o(addend));
  end else begin : addend_goes_on
    assign addend = addend_i;
  end
  if (OPERAND_RANKS > 0) begin : operand_copy
    blysk_delay #(.WIDTH(VARIABLE_WIDTH), .RANKS(1)) variable_copy (
      .clk_i, .load_i(load_i[0]), .value_i(variable_i), .value_o(variable_o));
  end else begin : no_operand_copy
    assign variable_o = variable_i;
  end

  logic [T_WIDTH-1:0] t_d, t_q;
  line #(
    .MULTIPLICAND_WIDTH(MULTIPLICAND_WIDTH), .VARIABLE_WIDTH(VARIABLE_WIDTH), .ADDEND_WIDTH(ADDEND_WIDTH),
    .T_WIDTH(T_WIDTH)
  ) operands (
    .multiplicand_i(multiplicand), .variable_i(variable), .addend_i(addend), .t_o(t_d)
  );
  always_ff @(posedge clk_i) begin
    if (load_i[LAST]) t_q <= t_d;
  end
  assign t_o = t_q;

endmodule

`default_nettype wire
