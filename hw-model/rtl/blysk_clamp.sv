// The last rank: the answer of the part that has it, clamped to [0, 1], and the status.
// Twin of src/datapath/clamp.rs and of Divider::finish in src/datapath/tail.rs.
//
// t, the result of the last stage, has the output's fraction bits already, with integer bits (and a sign) for every
// value the polynomial can take. It may dip below zero above its cut, or round to one ulp above 1; both are
// clamped, and said so in the status.
//
// The quotient has one fraction bit more than the output; the last remainder, zero or not, stands for
// all further bits (sticky), so that every rounding mode is exact: round((2*quotient + sticky) / 4).
`timescale 1ns / 1ps
`default_nettype none

module blysk_clamp (
  input  logic                                clk_i,
  input  logic                                load_i,
  input  logic [blysk_pkg::REGION_WIDTH-1:0]     region_i,
  input  logic [blysk_pkg::STATUS_WIDTH-1:0]     status_i,
  input  logic [blysk_pkg::POLYNOMIAL_WIDTH-1:0] t_i,
  input  logic [blysk_pkg::DIVISOR_WIDTH-1:0]    remainder_i,
  input  logic [blysk_pkg::DIGITS_WIDTH-1:0]     digits_i,
  output logic [blysk_pkg::OUTPUT_WIDTH-1:0]     intensity_o,
  output logic [blysk_pkg::STATUS_WIDTH-1:0]     status_o
);

  // ---- Of the configuration -----------------------------------------------------------------------
  localparam int HAS_POLYNOMIAL         = blysk_pkg::HAS_POLYNOMIAL;
  localparam int HAS_TAIL               = blysk_pkg::HAS_TAIL;
  localparam int OUTPUT_WIDTH           = blysk_pkg::OUTPUT_WIDTH;
  localparam int POLYNOMIAL_EXCEEDS_ONE = blysk_pkg::POLYNOMIAL_EXCEEDS_ONE;
  localparam int POLYNOMIAL_WIDTH       = blysk_pkg::POLYNOMIAL_WIDTH;
  localparam int POLYNOMIAL_SIGNED      = blysk_pkg::POLYNOMIAL_SIGNED;
  localparam int DIGITS_WIDTH           = blysk_pkg::DIGITS_WIDTH;
  localparam int QUOTIENT_ROUNDING      = blysk_pkg::QUOTIENT_ROUNDING;
  localparam int REGION_WIDTH           = blysk_pkg::REGION_WIDTH;
  localparam int STATUS_WIDTH           = blysk_pkg::STATUS_WIDTH;
  localparam int STATUS_CLAMPED         = blysk_pkg::STATUS_CLAMPED;
  localparam logic [OUTPUT_WIDTH-1:0] OUTPUT_GREATEST   = blysk_pkg::OUTPUT_GREATEST;
  localparam logic [REGION_WIDTH-1:0] REGION_POLYNOMIAL = blysk_pkg::REGION_POLYNOMIAL;
  localparam logic [REGION_WIDTH-1:0] REGION_TAIL       = blysk_pkg::REGION_TAIL;

  // ---- The polynomial -----------------------------------------------------------------------------
  logic [OUTPUT_WIDTH-1:0] polynomial;
  logic                    clamped;

  if (HAS_POLYNOMIAL != 0) begin : clamp
    logic below, above;
    if (POLYNOMIAL_SIGNED != 0) begin : signed_t
      assign below = t_i[POLYNOMIAL_WIDTH-1];
    end else begin : unsigned_t
      assign below = 1'b0;
    end
    if (POLYNOMIAL_EXCEEDS_ONE != 0) begin : wide_t
      assign above = !below && t_i > POLYNOMIAL_WIDTH'(OUTPUT_GREATEST);
    end else begin : narrow_t
      assign above = 1'b0;
    end
    assign polynomial = below ? '0 : above ? OUTPUT_GREATEST : OUTPUT_WIDTH'(t_i);
    assign clamped    = region_i == REGION_POLYNOMIAL && (below || above);
  end else begin : no_clamp
    assign polynomial = '0;
    assign clamped    = 1'b0;
    logic unused;
    assign unused = &{1'b0, t_i};
  end

  // ---- The quotient -------------------------------------------------------------------------------
  logic [OUTPUT_WIDTH-1:0] quotient;

  if (HAS_TAIL != 0) begin : finish
    localparam int GUARD_BITS = 2;
    // A sign, a carry, the quotient, the sticky bit; DIGITS_WIDTH bits are left after the rounding.
    localparam int WIDE = DIGITS_WIDTH + 3;
    logic signed [WIDE-1:0]  wide;
    logic [DIGITS_WIDTH-1:0] rounded;
    assign wide = {2'b00, digits_i, |remainder_i};
    blysk_round_shift #(
      .IN_WIDTH(WIDE), .DROP(GUARD_BITS), .OUT_WIDTH(DIGITS_WIDTH), .MODE(QUOTIENT_ROUNDING)
    ) round_quotient (
      .value_i(wide), .rounded_o(rounded)
    );
    assign quotient = rounded > DIGITS_WIDTH'(OUTPUT_GREATEST)
        ? OUTPUT_GREATEST : OUTPUT_WIDTH'(rounded);
  end else begin : no_finish
    assign quotient = '0;
    logic unused;
    assign unused = &{1'b0, remainder_i, digits_i};
  end

  // ---- The answer ---------------------------------------------------------------------------------
  logic [OUTPUT_WIDTH-1:0] intensity_d, intensity_q;
  logic [STATUS_WIDTH-1:0] status_d, status_q;

  always_comb begin
    case (region_i)
      REGION_POLYNOMIAL: intensity_d = polynomial;
      REGION_TAIL:       intensity_d = quotient;
      default:           intensity_d = '0;
    endcase
    status_d                 = status_i;
    status_d[STATUS_CLAMPED] = clamped;
  end

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      intensity_q <= intensity_d;
      status_q    <= status_d;
    end
  end
  assign intensity_o = intensity_q;
  assign status_o    = status_q;

endmodule

`default_nettype wire
