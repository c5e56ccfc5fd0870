// The last rank, for every input: the answer is in [0, 1], and is the part's own value where that is.
`default_nettype none

module clamp_proof (
  input logic                                clk_i,
  input logic                                load_i,
  input logic [blysk_pkg::REGION_WIDTH-1:0]  region_i,
  input logic [blysk_pkg::STATUS_WIDTH-1:0]  status_i,
  input logic [blysk_pkg::POLYNOMIAL_WIDTH-1:0]      t_i,
  input logic [blysk_pkg::DIVISOR_WIDTH-1:0] remainder_i,
  input logic [blysk_pkg::DIGITS_WIDTH-1:0]  digits_i
);

  localparam int WIDE = blysk_pkg::POLYNOMIAL_WIDTH + blysk_pkg::DIGITS_WIDTH + blysk_pkg::OUTPUT_WIDTH + 4;
  localparam logic signed [WIDE-1:0] GREATEST = WIDE'(blysk_pkg::OUTPUT_GREATEST);

  logic [blysk_pkg::OUTPUT_WIDTH-1:0] intensity;
  logic [blysk_pkg::STATUS_WIDTH-1:0] status;
  blysk_clamp clamp (
    .clk_i, .load_i, .region_i, .status_i, .t_i, .remainder_i, .digits_i,
    .intensity_o(intensity), .status_o(status)
  );

  // The quotient in quarters of an output bit: its guard bit, and the sticky one.
  logic [WIDE-1:0]        sticky;
  logic signed [WIDE-1:0] quotient, value, expected, was_value;
  assign sticky = WIDE'(remainder_i != '0);
  multiply_add #(
    .MULTIPLICAND_WIDTH(blysk_pkg::DIGITS_WIDTH), .VARIABLE_WIDTH(2), .ADDEND_WIDTH(1), .SUBTRACT(0),
    .DROP(2), .ROUNDING(blysk_pkg::QUOTIENT_ROUNDING), .WIDE(WIDE)
  ) line (
    .multiplicand_i(digits_i), .variable_i(2'd2), .addend_i(sticky[0]), .exact_o(), .rounded_o(quotient)
  );

  always_comb begin
    case (region_i)
      blysk_pkg::REGION_POLYNOMIAL: begin
        value = blysk_pkg::POLYNOMIAL_SIGNED != 0 ? WIDE'($signed(t_i)) : WIDE'(t_i);
        if (blysk_pkg::HAS_POLYNOMIAL == 0) value = '0;
      end
      blysk_pkg::REGION_TAIL: value = blysk_pkg::HAS_TAIL != 0 ? quotient : '0;
      default:                value = '0;
    endcase
    expected = value < 0 ? '0 : value > GREATEST ? GREATEST : value;
  end

  logic                               loaded, was_polynomial;
  logic signed [WIDE-1:0]             was_expected;
  logic [blysk_pkg::STATUS_WIDTH-1:0] was_status;
  initial loaded = 1'b0;
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      loaded         <= 1'b1;
      was_value      <= value;
      was_expected   <= expected;
      was_status     <= status_i;
      was_polynomial <= region_i == blysk_pkg::REGION_POLYNOMIAL && blysk_pkg::HAS_POLYNOMIAL != 0;
    end
  end

  localparam logic [blysk_pkg::STATUS_WIDTH-1:0] CLAMPED =
      blysk_pkg::STATUS_WIDTH'(1) << blysk_pkg::STATUS_CLAMPED;

  always_comb begin
    if (loaded) begin
      at_most_one:    assert (intensity <= blysk_pkg::OUTPUT_GREATEST);
      clamped_value:  assert (WIDE'(intensity) == was_expected);
      flag_of_clamp:  assert (status[blysk_pkg::STATUS_CLAMPED] == (was_polynomial && was_value != was_expected));
      other_flags:    assert ((status | CLAMPED) == (was_status | CLAMPED));
    end
  end
endmodule

`default_nettype wire
