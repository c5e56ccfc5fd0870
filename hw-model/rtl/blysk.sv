// The highlight pipeline: cos(angle)^n for x = cos(angle) and the address of an exponent n.
// Twin of src/datapath/ranks.rs; the widths and constants of one configuration are in blysk_pkg.
//
//   (address, x) -> ROM word -+-> front end -> stage 1 -> stage 2 -> stage 3 -+-> clamp -> intensity
//                             +-> front end -> divisor, quotient digits ------+
//
//   rank      polynomial       tail
//   0         ROM word         ROM word                    fetch
//   1         v                x                           front end
//   2         stage 1: t1      divisor, first remainder    middle
//   3         stage 2: t2      quotient bits
//   4         stage 3: t3      quotient bits
//   5 ...     t3 waits         quotient bits
//   last      intensity        intensity                   clamp
//
// RANKS is the latency in clock cycles; one result a cycle when nothing stalls. A configuration keeps
// the polynomial, the tail, or both; what it does not keep is not built.
`timescale 1ns / 1ps
`default_nettype none

module blysk #(
  parameter ROM_FILE = "rom.mem"
) (
  input  logic                                clk_i,
  input  logic                                rst_i,        // synchronous
  // Request
  input  logic                                in_valid_i,
  output logic                                in_ready_o,
  input  logic [blysk_pkg::ADDRESS_WIDTH-1:0] address_i,
  input  logic [blysk_pkg::INPUT_WIDTH-1:0]   x_i,
  // Result
  output logic                                out_valid_o,
  input  logic                                out_ready_i,
  output logic [blysk_pkg::OUTPUT_WIDTH-1:0]  intensity_o,
  output logic [blysk_pkg::STATUS_WIDTH-1:0]  status_o
);

  // ---- Handshake ----------------------------------------------------------------------------------
  logic [blysk_pkg::RANKS-1:0] load;

  blysk_handshake #(
    .RANKS(blysk_pkg::RANKS)
  ) handshake (
    .clk_i, .rst_i,
    .in_valid_i, .in_ready_o, .out_valid_o, .out_ready_i,
    .load_o(load)
  );

  // ---- Rank 0: fetch ------------------------------------------------------------------------------
  logic [blysk_pkg::INPUT_WIDTH-1:0]  x_q;
  logic                    no_word;
  logic [blysk_pkg::C3_WIDTH-1:0]     c3;
  logic [blysk_pkg::C2_WIDTH-1:0]     c2;
  logic [blysk_pkg::C1_WIDTH-1:0]     c1;
  logic [blysk_pkg::C0_WIDTH-1:0]     c0;
  logic [blysk_pkg::CUT_WIDTH-1:0]    cut;
  logic [blysk_pkg::SHIFT_WIDTH-1:0]  shift;
  // Of the second segment, where there is one.
  logic [blysk_pkg::C3_OUTER_WIDTH-1:0]    c3_outer;
  logic [blysk_pkg::C2_OUTER_WIDTH-1:0]    c2_outer;
  logic [blysk_pkg::C1_OUTER_WIDTH-1:0]    c1_outer;
  logic [blysk_pkg::C0_OUTER_WIDTH-1:0]    c0_outer;
  logic [blysk_pkg::HAND_OVER_WIDTH-1:0]   hand_over;
  logic [blysk_pkg::SHIFT_OUTER_WIDTH-1:0] shift_outer;
  logic [blysk_pkg::TAIL_A_WIDTH-1:0] tail_a;
  logic [blysk_pkg::TAIL_B_WIDTH-1:0] tail_b;

  // The status as far as it is known.
  logic [blysk_pkg::STATUS_WIDTH-1:0] fetch_status;
  always_comb begin
    fetch_status                            = '0;
    fetch_status[blysk_pkg::STATUS_NO_WORD] = no_word;
  end

  always_ff @(posedge clk_i) begin
    if (load[0]) x_q <= x_i;
  end

  blysk_rom #(
    .ROM_FILE(ROM_FILE)
  ) rom (
    .clk_i, .load_i(load[0]), .address_i, .no_word_o(no_word),
    .c3_o(c3), .c2_o(c2), .c1_o(c1), .c0_o(c0), .cut_o(cut), .shift_o(shift),
    .c3_outer_o(c3_outer), .c2_outer_o(c2_outer), .c1_outer_o(c1_outer), .c0_outer_o(c0_outer),
    .hand_over_o(hand_over), .shift_outer_o(shift_outer),
    .tail_a_o(tail_a), .tail_b_o(tail_b)
  );

  // ---- Rank 1: front end --------------------------------------------------------------------------
  logic [blysk_pkg::V_WIDTH-1:0]      v;
  logic [blysk_pkg::X_WIDTH-1:0]      tail_x;
  logic [blysk_pkg::REGION_WIDTH-1:0] region;
  logic [blysk_pkg::STATUS_WIDTH-1:0] status;
  logic                               outer;

  blysk_front_end front_end (
    .clk_i, .load_i(load[1]),
    .x_i(x_q), .status_i(fetch_status), .cut_i(cut), .shift_i(shift),
    .hand_over_i(hand_over), .shift_outer_i(shift_outer), .outer_o(outer),
    .v_o(v), .tail_x_o(tail_x), .region_o(region), .status_o(status)
  );

  // ---- The middle ranks: the polynomial -----------------------------------------------------------
  logic [blysk_pkg::T3_WIDTH-1:0] t3_waited;

  if (blysk_pkg::HAS_POLYNOMIAL != 0) begin : polynomial
    // The coefficients of the segment that answers.
    logic [blysk_pkg::C3_WIDTH-1:0] c3_chosen;
    logic [blysk_pkg::C2_WIDTH-1:0] c2_chosen;
    logic [blysk_pkg::C1_WIDTH-1:0] c1_chosen;
    logic [blysk_pkg::C0_WIDTH-1:0] c0_chosen;

    if (blysk_pkg::SEGMENTS > 1) begin : segments
      assign c3_chosen = outer ? c3_outer : c3;
      assign c2_chosen = outer ? c2_outer : c2;
      assign c1_chosen = outer ? c1_outer : c1;
      assign c0_chosen = outer ? c0_outer : c0;
    end else begin : one_segment
      assign c3_chosen = c3;
      assign c2_chosen = c2;
      assign c1_chosen = c1;
      assign c0_chosen = c0;
      logic unused;
      assign unused = &{1'b0, outer, c3_outer, c2_outer, c1_outer, c0_outer};
    end

    // A coefficient and the variable wait for the stage that needs them.
    logic [blysk_pkg::C3_WIDTH-1:0] c3_at_1;
    logic [blysk_pkg::C2_WIDTH-1:0] c2_at_1;
    logic [blysk_pkg::C1_WIDTH-1:0] c1_at_2;
    logic [blysk_pkg::C0_WIDTH-1:0] c0_at_3;
    logic [blysk_pkg::V_WIDTH-1:0]  v_at_2, v_at_3;
    logic [blysk_pkg::T1_WIDTH-1:0] t1;
    logic [blysk_pkg::T2_WIDTH-1:0] t2;
    logic [blysk_pkg::T3_WIDTH-1:0] t3;

    blysk_delay #(.WIDTH(blysk_pkg::C3_WIDTH), .RANKS(1), .STORED(blysk_pkg::C3_CARRIED)) c3_delay (
      .clk_i, .load_i(load[1]), .value_i(c3_chosen), .value_o(c3_at_1));
    blysk_delay #(.WIDTH(blysk_pkg::C2_WIDTH), .RANKS(1), .STORED(blysk_pkg::C2_CARRIED)) c2_delay (
      .clk_i, .load_i(load[1]), .value_i(c2_chosen), .value_o(c2_at_1));
    blysk_delay #(.WIDTH(blysk_pkg::C1_WIDTH), .RANKS(2), .STORED(blysk_pkg::C1_CARRIED)) c1_delay (
      .clk_i, .load_i(load[2:1]), .value_i(c1_chosen), .value_o(c1_at_2));
    blysk_delay #(.WIDTH(blysk_pkg::C0_WIDTH), .RANKS(3), .STORED(blysk_pkg::C0_CARRIED)) c0_delay (
      .clk_i, .load_i(load[3:1]), .value_i(c0_chosen), .value_o(c0_at_3));
    blysk_delay #(.WIDTH(blysk_pkg::V_WIDTH), .RANKS(1)) v_delay_2 (
      .clk_i, .load_i(load[2]), .value_i(v), .value_o(v_at_2));
    blysk_delay #(.WIDTH(blysk_pkg::V_WIDTH), .RANKS(1)) v_delay_3 (
      .clk_i, .load_i(load[3]), .value_i(v_at_2), .value_o(v_at_3));

    blysk_stage #(
      .MULTIPLICAND_WIDTH(blysk_pkg::C3_WIDTH), .MULTIPLICAND_SIGNED(blysk_pkg::C3_SIGNED),
      .VARIABLE_WIDTH(blysk_pkg::V_WIDTH),
      .ADDEND_WIDTH(blysk_pkg::C2_WIDTH), .ADDEND_SIGNED(blysk_pkg::C2_SIGNED),
      .T_WIDTH(blysk_pkg::T1_WIDTH), .SUBTRACT(blysk_pkg::CENTRED),
      .PRODUCT_UP(blysk_pkg::T1_PRODUCT_UP), .ADDEND_UP(blysk_pkg::T1_ADDEND_UP),
      .RESULT_UP(blysk_pkg::T1_RESULT_UP), .DROP(blysk_pkg::T1_DROP),
      .SUM_WIDTH(blysk_pkg::T1_SUM_WIDTH), .ROUNDING(blysk_pkg::T1_ROUNDING)
    ) stage1 (
      .clk_i, .load_i(load[2]),
      .multiplicand_i(c3_at_1), .variable_i(v), .addend_i(c2_at_1), .t_o(t1)
    );

    blysk_stage #(
      .MULTIPLICAND_WIDTH(blysk_pkg::T1_WIDTH), .MULTIPLICAND_SIGNED(blysk_pkg::T1_SIGNED),
      .VARIABLE_WIDTH(blysk_pkg::V_WIDTH),
      .ADDEND_WIDTH(blysk_pkg::C1_WIDTH), .ADDEND_SIGNED(blysk_pkg::C1_SIGNED),
      .T_WIDTH(blysk_pkg::T2_WIDTH), .SUBTRACT(blysk_pkg::CENTRED),
      .PRODUCT_UP(blysk_pkg::T2_PRODUCT_UP), .ADDEND_UP(blysk_pkg::T2_ADDEND_UP),
      .RESULT_UP(blysk_pkg::T2_RESULT_UP), .DROP(blysk_pkg::T2_DROP),
      .SUM_WIDTH(blysk_pkg::T2_SUM_WIDTH), .ROUNDING(blysk_pkg::T2_ROUNDING)
    ) stage2 (
      .clk_i, .load_i(load[3]),
      .multiplicand_i(t1), .variable_i(v_at_2), .addend_i(c1_at_2), .t_o(t2)
    );

    blysk_stage #(
      .MULTIPLICAND_WIDTH(blysk_pkg::T2_WIDTH), .MULTIPLICAND_SIGNED(blysk_pkg::T2_SIGNED),
      .VARIABLE_WIDTH(blysk_pkg::V_WIDTH),
      .ADDEND_WIDTH(blysk_pkg::C0_WIDTH), .ADDEND_SIGNED(blysk_pkg::C0_SIGNED),
      .T_WIDTH(blysk_pkg::T3_WIDTH), .SUBTRACT(blysk_pkg::CENTRED),
      .PRODUCT_UP(blysk_pkg::T3_PRODUCT_UP), .ADDEND_UP(blysk_pkg::T3_ADDEND_UP),
      .RESULT_UP(blysk_pkg::T3_RESULT_UP), .DROP(blysk_pkg::T3_DROP),
      .SUM_WIDTH(blysk_pkg::T3_SUM_WIDTH), .ROUNDING(blysk_pkg::T3_ROUNDING)
    ) stage3 (
      .clk_i, .load_i(load[4]),
      .multiplicand_i(t2), .variable_i(v_at_3), .addend_i(c0_at_3), .t_o(t3)
    );

    if (blysk_pkg::RANKS > 6) begin : wait_for_tail
      blysk_delay #(.WIDTH(blysk_pkg::T3_WIDTH), .RANKS(blysk_pkg::RANKS - 6)) t3_delay (
        .clk_i, .load_i(load[blysk_pkg::RANKS-2:5]), .value_i(t3), .value_o(t3_waited));
    end else begin : no_wait
      assign t3_waited = t3;
    end
  end else begin : no_polynomial
    assign t3_waited = '0;
    logic unused;
    assign unused = &{1'b0, c3, c2, c1, c0, v, outer, c3_outer, c2_outer, c1_outer, c0_outer};
  end

  // ---- The middle ranks: the tail -----------------------------------------------------------------
  logic [blysk_pkg::DIVISOR_WIDTH-1:0] remainder_waited;
  logic [blysk_pkg::DIGITS_WIDTH-1:0]  digits_waited;

  if (blysk_pkg::HAS_TAIL != 0) begin : tail
    // The rank of the last quotient bits.
    localparam int LAST = 2 + blysk_pkg::DIGIT_STAGES;
    logic [blysk_pkg::TAIL_A_WIDTH-1:0]  a_at_1;
    logic [blysk_pkg::TAIL_B_WIDTH-1:0]  b_at_1;
    logic [blysk_pkg::DIVISOR_WIDTH-1:0] remainder;
    logic [blysk_pkg::DIGITS_WIDTH-1:0]  digits;

    blysk_delay #(.WIDTH(blysk_pkg::TAIL_A_WIDTH), .RANKS(1), .STORED(blysk_pkg::TAIL_A_STORED)) a_delay (
      .clk_i, .load_i(load[1]), .value_i(tail_a), .value_o(a_at_1));
    blysk_delay #(.WIDTH(blysk_pkg::TAIL_B_WIDTH), .RANKS(1), .STORED(blysk_pkg::TAIL_B_STORED)) b_delay (
      .clk_i, .load_i(load[1]), .value_i(tail_b), .value_o(b_at_1));

    blysk_tail divider (
      .clk_i, .load_i(load[LAST:2]),
      .x_i(tail_x), .a_i(a_at_1), .b_i(b_at_1),
      .remainder_o(remainder), .digits_o(digits)
    );

    if (blysk_pkg::RANKS - 2 > LAST) begin : wait_for_polynomial
      blysk_delay #(.WIDTH(blysk_pkg::DIVISOR_WIDTH), .RANKS(blysk_pkg::RANKS - 2 - LAST)) remainder_delay (
        .clk_i, .load_i(load[blysk_pkg::RANKS-2:LAST+1]), .value_i(remainder), .value_o(remainder_waited));
      blysk_delay #(.WIDTH(blysk_pkg::DIGITS_WIDTH), .RANKS(blysk_pkg::RANKS - 2 - LAST)) digits_delay (
        .clk_i, .load_i(load[blysk_pkg::RANKS-2:LAST+1]), .value_i(digits), .value_o(digits_waited));
    end else begin : no_wait
      assign remainder_waited = remainder;
      assign digits_waited    = digits;
    end
  end else begin : no_tail
    assign remainder_waited = '0;
    assign digits_waited    = '0;
    logic unused;
    assign unused = &{1'b0, tail_a, tail_b, tail_x};
  end

  // ---- Region and status go along -----------------------------------------------------------------
  logic [blysk_pkg::REGION_WIDTH-1:0] region_waited;
  logic [blysk_pkg::STATUS_WIDTH-1:0] status_waited;

  blysk_delay #(.WIDTH(blysk_pkg::REGION_WIDTH), .RANKS(blysk_pkg::RANKS - 3)) region_delay (
    .clk_i, .load_i(load[blysk_pkg::RANKS-2:2]), .value_i(region), .value_o(region_waited));
  blysk_delay #(.WIDTH(blysk_pkg::STATUS_WIDTH), .RANKS(blysk_pkg::RANKS - 3)) status_delay (
    .clk_i, .load_i(load[blysk_pkg::RANKS-2:2]), .value_i(status), .value_o(status_waited));

  // ---- Last rank: clamp ---------------------------------------------------------------------------
  blysk_clamp clamp (
    .clk_i, .load_i(load[blysk_pkg::RANKS-1]),
    .region_i(region_waited), .status_i(status_waited),
    .t3_i(t3_waited), .remainder_i(remainder_waited), .digits_i(digits_waited),
    .intensity_o, .status_o
  );

endmodule

`default_nettype wire
