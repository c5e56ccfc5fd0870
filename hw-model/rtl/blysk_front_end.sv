// The front end: which part answers, and the variable the polynomial is evaluated in.
// Twin of src/datapath/front_end.rs.
//
// x clamps to [0, 1]. Against the row's cut it falls into a region:
//
//   polynomial  x >= cut                                      the stages answer
//   tail        0 <= x < cut, configuration keeps a divider   the divider answers
//   zero        0 <= x < cut without one; x < 0; no ROM word  the intensity is 0
//
// A configuration with a domain has one status bit more, out_of_domain: its cut is the least x that is presented, and
// 0 <= x < cut with a ROM word is refused.
//
// With several segments (SEGMENTS > 1) the last answers from cut up to its hand-over, the one before from there up to
// its own, and so on: beyond_o chooses the coefficients, and the variable counts from the hand-over.
//
// The ROM's cut and hand-overs may have fewer fraction bits than x: CUT_UP and HAND_OVER_UP places of zeros bring
// them to the unit of x.
//
// A part that does not answer is fed a harmless x, for which the ranges of its registers are proved
// too: the polynomial u = 0, or the greatest x in the power form; the divider x = 0.
//
// Where the configuration cuts the front end (FRONT_END_RANKS), a rank of registers stands behind the comparisons. It
// holds the distances from x to where each segment begins, computed beside the comparisons, and the choice between them
// comes behind it: word_i is the ROM word as the comparisons read it, fields_i as the choice does. Without that rank
// both are the same, and one subtraction serves all segments.
//
// Widths: a clamped x has X_WIDTH bits, unsigned. s = 1 - x (or hand-over - x) needs INPUT_FRACTION + 1. u = s * 2^e is
// less than 2^V_WIDTH in its own unit for every row's cut, so U_WIDTH = V_WIDTH + U_DROP and a carry
// bit and a sign hold it before its rounding.
`timescale 1ns / 1ps
`default_nettype none

module blysk_front_end (
  input  logic                               clk_i,
  input  logic [blysk_pkg::FRONT_END_RANKS:0] load_i,
  input  logic [blysk_pkg::INPUT_WIDTH-1:0]  x_i,
  input  logic [blysk_pkg::STATUS_WIDTH-1:0] status_i,
  input  logic [blysk_pkg::FIELDS_WIDTH-1:0] word_i,
  input  logic [blysk_pkg::FIELDS_WIDTH-1:0] fields_i,
  output logic [blysk_pkg::SEGMENTS-1:0]     beyond_o,      // as the choice reads it
  output logic [blysk_pkg::V_WIDTH-1:0]      v_o,
  output logic [blysk_pkg::X_WIDTH-1:0]      tail_x_o,
  output logic [blysk_pkg::REGION_WIDTH-1:0] region_o,
  output logic [blysk_pkg::STATUS_WIDTH-1:0] status_o
);

  // ---- Of the configuration -----------------------------------------------------------------------
  localparam int HAS_POLYNOMIAL          = blysk_pkg::HAS_POLYNOMIAL;
  localparam int HAS_TAIL                = blysk_pkg::HAS_TAIL;
  localparam int CENTRED                 = blysk_pkg::CENTRED;
  localparam int SEGMENTS                = blysk_pkg::SEGMENTS;
  localparam int FRONT_END_RANKS         = blysk_pkg::FRONT_END_RANKS;
  localparam int INPUT_WIDTH             = blysk_pkg::INPUT_WIDTH;
  localparam int INPUT_SIGNED            = blysk_pkg::INPUT_SIGNED;
  localparam int INPUT_FRACTION          = blysk_pkg::INPUT_FRACTION;
  localparam int INPUT_EXCEEDS_ONE       = blysk_pkg::INPUT_EXCEEDS_ONE;
  localparam int X_WIDTH                 = blysk_pkg::X_WIDTH;
  localparam int CUT_WIDTH               = blysk_pkg::CUT_WIDTH;
  localparam int CUT_PLACE               = blysk_pkg::CUT_PLACE;
  localparam int CUT_UP                  = blysk_pkg::CUT_UP;
  localparam int CUT_COMPARE_WIDTH       = blysk_pkg::CUT_COMPARE_WIDTH;
  localparam int HAND_OVER_UP            = blysk_pkg::HAND_OVER_UP;
  localparam int HAND_OVER_COMPARE_WIDTH = blysk_pkg::HAND_OVER_COMPARE_WIDTH;
  localparam int SHIFT_COMMON_WIDTH      = blysk_pkg::SHIFT_COMMON_WIDTH;
  localparam int U_UP                    = blysk_pkg::U_UP;
  localparam int U_DROP                  = blysk_pkg::U_DROP;
  localparam int U_ROUNDING              = blysk_pkg::U_ROUNDING;
  localparam int V_WIDTH                 = blysk_pkg::V_WIDTH;
  localparam int REGION_WIDTH            = blysk_pkg::REGION_WIDTH;
  localparam int STATUS_WIDTH            = blysk_pkg::STATUS_WIDTH;
  localparam int STATUS_NO_WORD          = blysk_pkg::STATUS_NO_WORD;
  localparam int STATUS_ABOVE_ONE        = blysk_pkg::STATUS_ABOVE_ONE;
  localparam int STATUS_FACING_AWAY      = blysk_pkg::STATUS_FACING_AWAY;
  localparam int STATUS_CLAMPED          = blysk_pkg::STATUS_CLAMPED;
  localparam logic [X_WIDTH-1:0]      X_GREATEST        = blysk_pkg::X_GREATEST;
  localparam logic [32*SEGMENTS-1:0]  SHIFT_WIDTHS      = blysk_pkg::SHIFT_WIDTHS;
  localparam logic [32*SEGMENTS-1:0]  SHIFT_PLACES      = blysk_pkg::SHIFT_PLACES;
  localparam logic [32*SEGMENTS-1:0]  HAND_OVER_WIDTHS  = blysk_pkg::HAND_OVER_WIDTHS;
  localparam logic [32*SEGMENTS-1:0]  HAND_OVER_PLACES  = blysk_pkg::HAND_OVER_PLACES;
  localparam logic [REGION_WIDTH-1:0] REGION_ZERO       = blysk_pkg::REGION_ZERO;
  localparam logic [REGION_WIDTH-1:0] REGION_POLYNOMIAL = blysk_pkg::REGION_POLYNOMIAL;
  localparam logic [REGION_WIDTH-1:0] REGION_TAIL       = blysk_pkg::REGION_TAIL;

  // ---- Clamp x to [0, 1] --------------------------------------------------------------------------
  // Integer bits alone tell that x is 1 or more, and it is taken as 1 then. That it is more is for the status, which
  // nothing waits for.
  logic               facing_away, one_or_more, above_one;
  logic [X_WIDTH-1:0] x;

  if (INPUT_SIGNED != 0) begin : signed_input
    assign facing_away = x_i[INPUT_WIDTH-1];
  end else begin : unsigned_input
    assign facing_away = 1'b0;
  end
  if (INPUT_EXCEEDS_ONE != 0) begin : wide_input
    assign one_or_more = !facing_away && |x_i[INPUT_WIDTH-1:INPUT_FRACTION];
    assign above_one   = !facing_away && x_i > INPUT_WIDTH'(X_GREATEST);
  end else begin : narrow_input
    assign one_or_more = 1'b0;
    assign above_one   = 1'b0;
  end
  assign x = facing_away ? '0 : one_or_more ? X_GREATEST : x_i[X_WIDTH-1:0];

  // ---- Which part answers -------------------------------------------------------------------------
  logic [REGION_WIDTH-1:0] region_d, region, region_q;
  logic                    above_cut, no_word;
  assign no_word = status_i[STATUS_NO_WORD];

  if (HAS_POLYNOMIAL != 0) begin : cut
    logic [CUT_WIDTH-1:0]         of_row;
    logic [CUT_COMPARE_WIDTH-1:0] least_x;
    assign of_row    = word_i[CUT_PLACE+:CUT_WIDTH];
    assign least_x   = CUT_COMPARE_WIDTH'(of_row) << CUT_UP;
    assign above_cut = CUT_COMPARE_WIDTH'(x) >= least_x;
  end else begin : no_cut
    assign above_cut = 1'b0;
  end

  always_comb begin
    region_d = REGION_ZERO;
    if (!no_word && !facing_away) begin
      if (above_cut)          region_d = REGION_POLYNOMIAL;
      else if (HAS_TAIL != 0) region_d = REGION_TAIL;
    end
  end

  // ---- What the choice reads: behind a rank of registers, where there is one -----------------------
  // The power form and the divider read x; u is made of the distances.
  localparam int X_HELD = FRONT_END_RANKS != 0 && (CENTRED == 0 || HAS_POLYNOMIAL == 0 || HAS_TAIL != 0) ? 1 : 0;
  logic [X_WIDTH-1:0]  x_chosen;
  logic [SEGMENTS-1:0] below;

  blysk_delay #(.WIDTH(X_WIDTH), .RANKS(1), .STORED(X_HELD)) held_x (
    .clk_i, .load_i(load_i[0]), .value_i(x), .value_o(x_chosen));
  blysk_delay #(.WIDTH(REGION_WIDTH), .RANKS(1), .STORED(FRONT_END_RANKS)) held_region (
    .clk_i, .load_i(load_i[0]), .value_i(region_d), .value_o(region));
  if (SEGMENTS > 1) begin : several_segments
    blysk_delay #(.WIDTH(SEGMENTS-1), .RANKS(1), .STORED(FRONT_END_RANKS)) held_beyond (
      .clk_i, .load_i(load_i[0]), .value_i(below[SEGMENTS-1:1]), .value_o(beyond_o[SEGMENTS-1:1]));
  end

  always_ff @(posedge clk_i) begin
    if (load_i[FRONT_END_RANKS]) region_q <= region;
  end
  assign region_o = region_q;

  // ---- Which segment ------------------------------------------------------------------------------
  // Bit k: x lies below the hand-over to segment k. The highest bit set is the segment that answers.
  assign below[0]    = 1'b0;
  assign beyond_o[0] = 1'b0;

  // How far x lies below where v counts from (s), and the places it is moved up (shift): of segment k, or of the one
  // before it that answers. Without a rank of registers before the choice it is the start that is chosen.
  localparam int S_WIDTH  = INPUT_FRACTION + 1;
  localparam int MEASURED = FRONT_END_RANKS != 0 && CENTRED != 0 && HAS_POLYNOMIAL != 0 ? 1 : 0;

  genvar k;
  generate
    for (k = 0; k < SEGMENTS; k = k + 1) begin : segment
      localparam int SHIFT_WIDTH = SHIFT_WIDTHS[32*k+:32];
      localparam int SHIFT_PLACE = SHIFT_PLACES[32*k+:32];
      logic [SHIFT_COMMON_WIDTH-1:0] own_shift, shift;
      logic [S_WIDTH-1:0]            start, own_start;
      if (CENTRED != 0 && HAS_POLYNOMIAL != 0) begin : shifted
        assign own_shift = SHIFT_COMMON_WIDTH'(fields_i[SHIFT_PLACE+:SHIFT_WIDTH]);
      end else begin : not_shifted
        assign own_shift = '0;
      end

      if (k == 0) begin : first
        assign own_start = S_WIDTH'(1) << INPUT_FRACTION;
        assign start     = own_start;
        assign shift     = own_shift;
      end else begin : further
        localparam int WIDTH   = HAND_OVER_WIDTHS[32*k+:32];
        localparam int PLACE   = HAND_OVER_PLACES[32*k+:32];
        localparam int COMPARE = HAND_OVER_COMPARE_WIDTH;
        logic [WIDTH-1:0]   of_row;
        logic [COMPARE-1:0] hand_over;
        assign of_row      = word_i[PLACE+:WIDTH];
        assign hand_over   = COMPARE'(of_row) << HAND_OVER_UP;
        assign below[k]    = region_d == REGION_POLYNOMIAL && COMPARE'(x) < hand_over;
        assign own_start   = S_WIDTH'(of_row) << HAND_OVER_UP;
        assign start       = beyond_o[k] ? own_start : segment[k-1].start;
        assign shift       = beyond_o[k] ? own_shift : segment[k-1].shift;
      end

      if (MEASURED != 0) begin : distance
        // Signed where x may lie above the start of the segment.
        localparam int WIDTH = S_WIDTH + (k == 0 ? 0 : 1);
        logic [WIDTH-1:0]   computed, at_choice;
        logic [S_WIDTH-1:0] choice;
        assign computed = WIDTH'(own_start) - WIDTH'(x);
        blysk_delay #(.WIDTH(WIDTH), .RANKS(1)) held (
          .clk_i, .load_i(load_i[0]), .value_i(computed), .value_o(at_choice));
        if (k == 0) begin : nearest
          assign choice = at_choice;
        end else begin : chosen
          assign choice = beyond_o[k] ? S_WIDTH'(at_choice) : segment[k-1].distance.choice;
          logic at_choice_unused;
          assign at_choice_unused = &{1'b0, at_choice};
        end
      end
    end
  endgenerate

  // ---- The polynomial's variable: x, or u = (start - x) * 2^shift ---------------------------------
  if (HAS_POLYNOMIAL != 0) begin : variable
    logic [V_WIDTH-1:0] v_d, v_q;

    if (CENTRED != 0) begin : centred
      localparam int U_WIDTH = V_WIDTH + U_DROP + 2;
      logic        [S_WIDTH-1:0]            distance, s;
      logic        [SHIFT_COMMON_WIDTH-1:0] shift;
      logic signed [U_WIDTH-1:0]            u;
      assign shift = segment[SEGMENTS-1].shift;
      if (MEASURED != 0) begin : measured
        assign distance = segment[SEGMENTS-1].distance.choice;
      end else begin : not_measured
        assign distance = segment[SEGMENTS-1].start - S_WIDTH'(x_chosen);
      end
      assign s = region == REGION_POLYNOMIAL ? distance : '0;
      assign u = (U_WIDTH'(s) << U_UP) << shift;
      blysk_round_shift #(
        .IN_WIDTH(U_WIDTH), .DROP(U_DROP), .OUT_WIDTH(V_WIDTH), .MODE(U_ROUNDING)
      ) round_u (
        .value_i(u), .rounded_o(v_d)
      );
    end else begin : power
      assign v_d = region == REGION_POLYNOMIAL ? x_chosen : X_GREATEST;
    end

    always_ff @(posedge clk_i) begin
      if (load_i[FRONT_END_RANKS]) v_q <= v_d;
    end
    assign v_o = v_q;
  end else begin : no_variable
    assign v_o = '0;
  end

  // ---- The divider's x ----------------------------------------------------------------------------
  if (HAS_TAIL != 0) begin : tail
    logic [X_WIDTH-1:0] tail_x_d, tail_x_q;
    assign tail_x_d = region == REGION_TAIL ? x_chosen : '0;
    always_ff @(posedge clk_i) begin
      if (load_i[FRONT_END_RANKS]) tail_x_q <= tail_x_d;
    end
    assign tail_x_o = tail_x_q;
  end else begin : no_tail
    assign tail_x_o = '0;
  end

  // ---- Status -------------------------------------------------------------------------------------
  logic [STATUS_WIDTH-1:0] status_d, status, status_q;

  if (STATUS_WIDTH > STATUS_CLAMPED + 1) begin : domain
    // The flag behind the last of the others: the cut is the least x that is presented.
    always_comb begin
      status_d                                = status_i;
      status_d[STATUS_ABOVE_ONE]   = above_one;
      status_d[STATUS_FACING_AWAY] = facing_away;
      status_d[STATUS_WIDTH-1]     = !no_word && !facing_away && !above_cut;
    end
  end else begin : every_x
    always_comb begin
      status_d                                = status_i;
      status_d[STATUS_ABOVE_ONE]   = above_one;
      status_d[STATUS_FACING_AWAY] = facing_away;
    end
  end

  blysk_delay #(.WIDTH(STATUS_WIDTH), .RANKS(1), .STORED(FRONT_END_RANKS)) held_status (
    .clk_i, .load_i(load_i[0]), .value_i(status_d), .value_o(status));
  always_ff @(posedge clk_i) begin
    if (load_i[FRONT_END_RANKS]) status_q <= status;
  end
  assign status_o = status_q;

  // The fields that other ranks read, and what a form does not have.
  logic unused;
  assign unused = &{1'b0, word_i, fields_i, x_chosen, below, segment[SEGMENTS-1].start, segment[SEGMENTS-1].shift};

endmodule

`default_nettype wire
