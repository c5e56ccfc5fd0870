// The highlight pipeline: cos(angle)^n for x = cos(angle) and the address of an exponent n.
// Twin of src/datapath/ranks.rs; the widths and constants of one configuration are in blysk_pkg.
//
//   (address, x) -> ROM word -+-> front end -> stage 1 -> ... -> stage DEGREE -+-> clamp -> intensity
//                             +-> front end -> divisor, quotient digits -------+
//
// In the least pipeline:
//
//   rank      cubic            tail
//   0         ROM word         ROM word                    fetch
//   1         v                x                           front end
//   2         stage 1: t1      divisor, first remainder    middle
//   3         stage 2: t2      quotient bits
//   4         stage 3: t3      quotient bits
//   5 ...     t3 waits         quotient bits
//   last      intensity        intensity                   clamp
//
// RANKS is the latency in clock cycles; one result a cycle when nothing stalls. A configuration keeps
// the polynomial, the tail, or both; what it does not keep is not built. It may have more ranks, as the package says:
// behind the ROM (ROM_RANKS), inside the front end (FRONT_END_RANKS), and in each multiply-add before the multiplier,
// behind it and behind the sum (OPERAND_RANKS, PRODUCT_RANKS, SUM_RANKS). A register slice before the first rank or
// behind the last (INPUT_SLICE, OUTPUT_SLICE) adds a cycle to the latency.
`timescale 1ns / 1ps
`default_nettype none

module blysk #(
  parameter ROM_FILE = "rom.mem"
) (
  input  logic                                clk_i,
  input  logic                                rst_i,
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

  // ---- Of the configuration -----------------------------------------------------------------------
  localparam int HAS_POLYNOMIAL   = blysk_pkg::HAS_POLYNOMIAL;
  localparam int HAS_TAIL         = blysk_pkg::HAS_TAIL;
  localparam int CENTRED          = blysk_pkg::CENTRED;
  localparam int DEGREE           = blysk_pkg::DEGREE;
  localparam int SEGMENTS         = blysk_pkg::SEGMENTS;
  localparam int RANKS            = blysk_pkg::RANKS;
  localparam int ROM_RANKS        = blysk_pkg::ROM_RANKS;
  localparam int FRONT_END_RANKS  = blysk_pkg::FRONT_END_RANKS;
  localparam int OPERAND_RANKS    = blysk_pkg::OPERAND_RANKS;
  localparam int PRODUCT_RANKS    = blysk_pkg::PRODUCT_RANKS;
  localparam int SUM_RANKS        = blysk_pkg::SUM_RANKS;
  localparam int INPUT_SLICE      = blysk_pkg::INPUT_SLICE;
  localparam int OUTPUT_SLICE     = blysk_pkg::OUTPUT_SLICE;
  localparam int HANDSHAKE        = blysk_pkg::HANDSHAKE;
  localparam int READY_IN_RESET   = blysk_pkg::READY_IN_RESET;
  localparam int RESET_ACTIVE_LOW = blysk_pkg::RESET_ACTIVE_LOW;
  localparam int ASYNCHRONOUS     = blysk_pkg::RESET_ASYNCHRONOUS;
  localparam int ADDRESS_WIDTH    = blysk_pkg::ADDRESS_WIDTH;
  localparam int OUTPUT_WIDTH     = blysk_pkg::OUTPUT_WIDTH;
  localparam int INPUT_WIDTH      = blysk_pkg::INPUT_WIDTH;
  localparam int X_WIDTH          = blysk_pkg::X_WIDTH;
  localparam int TAIL_A_WIDTH     = blysk_pkg::TAIL_A_WIDTH;
  localparam int TAIL_A_STORED    = blysk_pkg::TAIL_A_STORED;
  localparam int TAIL_A_PLACE     = blysk_pkg::TAIL_A_PLACE;
  localparam int TAIL_B_WIDTH     = blysk_pkg::TAIL_B_WIDTH;
  localparam int TAIL_B_STORED    = blysk_pkg::TAIL_B_STORED;
  localparam int TAIL_B_PLACE     = blysk_pkg::TAIL_B_PLACE;
  localparam int FIELDS           = blysk_pkg::FIELDS;
  localparam int FIELDS_WIDTH     = blysk_pkg::FIELDS_WIDTH;
  localparam int V_WIDTH          = blysk_pkg::V_WIDTH;
  localparam int POLYNOMIAL_WIDTH = blysk_pkg::POLYNOMIAL_WIDTH;
  localparam int DIVISOR_WIDTH    = blysk_pkg::DIVISOR_WIDTH;
  localparam int DIGITS_WIDTH     = blysk_pkg::DIGITS_WIDTH;
  localparam int DIGIT_STAGES     = blysk_pkg::DIGIT_STAGES;
  localparam int REGION_WIDTH     = blysk_pkg::REGION_WIDTH;
  localparam int STATUS_WIDTH     = blysk_pkg::STATUS_WIDTH;
  localparam int STATUS_NO_WORD   = blysk_pkg::STATUS_NO_WORD;
  localparam logic [32*FIELDS-1:0]              FIELD_WIDTH  = blysk_pkg::FIELD_WIDTH;
  localparam logic [32*FIELDS-1:0]              FIELD_PLACE  = blysk_pkg::FIELD_PLACE;
  localparam logic [32*FIELDS-1:0]              FIELD_CHOSEN = blysk_pkg::FIELD_CHOSEN;
  localparam logic [32*(DEGREE+1)-1:0]          C_WIDTH      = blysk_pkg::C_WIDTH;
  localparam logic [32*(DEGREE+1)-1:0]          C_SIGNED     = blysk_pkg::C_SIGNED;
  localparam logic [32*SEGMENTS*(DEGREE+1)-1:0] C_PLACE      = blysk_pkg::C_PLACE;
  localparam logic [32*(DEGREE+1)-1:0]          C_CARRIED    = blysk_pkg::C_CARRIED;
  localparam logic [32*(DEGREE+1)-1:0]          T_WIDTH      = blysk_pkg::T_WIDTH;
  localparam logic [32*(DEGREE+1)-1:0]          T_SIGNED     = blysk_pkg::T_SIGNED;
  localparam logic [32*(DEGREE+1)-1:0]          T_PRODUCT_UP = blysk_pkg::T_PRODUCT_UP;
  localparam logic [32*(DEGREE+1)-1:0]          T_ADDEND_UP  = blysk_pkg::T_ADDEND_UP;
  localparam logic [32*(DEGREE+1)-1:0]          T_RESULT_UP  = blysk_pkg::T_RESULT_UP;
  localparam logic [32*(DEGREE+1)-1:0]          T_DROP       = blysk_pkg::T_DROP;
  localparam logic [32*(DEGREE+1)-1:0]          T_SUM_WIDTH  = blysk_pkg::T_SUM_WIDTH;
  localparam logic [32*(DEGREE+1)-1:0]          T_ROUNDING   = blysk_pkg::T_ROUNDING;

  // ---- Ranks --------------------------------------------------------------------------------------
  // That of the comparisons of x, that of the front end, and how many ranks a multiply-add takes.
  localparam int COMPARE   = 1 + ROM_RANKS;
  localparam int FRONT_END = COMPARE + FRONT_END_RANKS;
  localparam int LINE      = OPERAND_RANKS + PRODUCT_RANKS + SUM_RANKS + 1;

  // ---- Reset, active high -------------------------------------------------------------------------
  logic rst;
  assign rst = RESET_ACTIVE_LOW != 0 ? !rst_i : rst_i;

  // ---- Handshake, and the slices before and behind the ranks --------------------------------------
  logic [RANKS-1:0]         load;
  logic                     request_valid, request_ready, slice_ready, slice_ready_d;
  logic                     result_valid, result_ready, result_ready_d;
  logic [ADDRESS_WIDTH-1:0] request_address;
  logic [INPUT_WIDTH-1:0]   request_x;
  logic [OUTPUT_WIDTH-1:0]  result_intensity;
  logic [STATUS_WIDTH-1:0]  result_status;

  assign in_ready_o = slice_ready && (READY_IN_RESET != 0 || !rst);

  blysk_ready_slice #(
    .WIDTH(ADDRESS_WIDTH + INPUT_WIDTH), .STORED(INPUT_SLICE), .RESET_ASYNCHRONOUS(ASYNCHRONOUS)
  ) input_slice (
    .clk_i, .rst_i(rst),
    .in_valid_i(in_valid_i && !rst), .in_ready_o(slice_ready), .in_ready_d_o(slice_ready_d),
    .value_i({address_i, x_i}),
    .out_valid_o(request_valid), .out_ready_i(request_ready), .value_o({request_address, request_x})
  );

  blysk_handshake #(
    .RANKS(RANKS), .KIND(HANDSHAKE), .READY_AHEAD(OUTPUT_SLICE), .RESET_ASYNCHRONOUS(ASYNCHRONOUS)
  ) handshake (
    .clk_i, .rst_i(rst),
    .in_valid_i(request_valid), .in_ready_o(request_ready),
    .out_valid_o(result_valid), .out_ready_i(result_ready), .out_ready_d_i(result_ready_d),
    .load_o(load)
  );

  blysk_ready_slice #(
    .WIDTH(STATUS_WIDTH + OUTPUT_WIDTH), .STORED(OUTPUT_SLICE), .RESET_ASYNCHRONOUS(ASYNCHRONOUS)
  ) output_slice (
    .clk_i, .rst_i(rst),
    .in_valid_i(result_valid), .in_ready_o(result_ready), .in_ready_d_o(result_ready_d),
    .value_i({result_status, result_intensity}),
    .out_valid_o, .out_ready_i, .value_o({status_o, intensity_o})
  );

  // Nobody before the pipeline asks for its ready a cycle ahead.
  logic unused_ready;
  assign unused_ready = &{1'b0, slice_ready_d};

  // ---- Rank 0: fetch ------------------------------------------------------------------------------
  logic [INPUT_WIDTH-1:0]  x_q, x;
  logic                    no_word;
  logic [FIELDS_WIDTH-1:0] word;     // the fields of the ROM word, and those that are constants

  // The status as far as it is known.
  logic [STATUS_WIDTH-1:0] fetch_status, word_status;
  always_comb begin
    fetch_status                 = '0;
    fetch_status[STATUS_NO_WORD] = no_word;
  end

  always_ff @(posedge clk_i) begin
    if (load[0]) x_q <= request_x;
  end

  blysk_rom #(
    .ROM_FILE(ROM_FILE)
  ) rom (
    .clk_i, .load_i(load[ROM_RANKS:0]), .address_i(request_address), .no_word_o(no_word), .fields_o(word)
  );

  // A register behind the ROM's own takes x and status along.
  blysk_delay #(.WIDTH(INPUT_WIDTH), .RANKS(1), .STORED(ROM_RANKS)) x_behind_rom (
    .clk_i, .load_i(load[ROM_RANKS]), .value_i(x_q), .value_o(x));
  blysk_delay #(.WIDTH(STATUS_WIDTH), .RANKS(1), .STORED(ROM_RANKS)) status_behind_rom (
    .clk_i, .load_i(load[ROM_RANKS]), .value_i(fetch_status), .value_o(word_status));

  // ---- The front end ------------------------------------------------------------------------------
  // The fields as its last rank reads them: behind the comparisons where these have a rank of their own.
  logic [FIELDS_WIDTH-1:0] fields;
  genvar f;
  generate
    for (f = 0; f < FIELDS; f = f + 1) begin : word_field
      localparam int WIDTH  = FIELD_WIDTH[32*f+:32];
      localparam int PLACE  = FIELD_PLACE[32*f+:32];
      localparam int STORED = FRONT_END_RANKS != 0 ? FIELD_CHOSEN[32*f+:32] : 0;
      blysk_delay #(.WIDTH(WIDTH), .RANKS(1), .STORED(STORED)) held (
        .clk_i, .load_i(load[COMPARE]), .value_i(word[PLACE+:WIDTH]), .value_o(fields[PLACE+:WIDTH]));
    end
  endgenerate

  logic [V_WIDTH-1:0]      v;
  logic [X_WIDTH-1:0]      tail_x;
  logic [REGION_WIDTH-1:0] region;
  logic [STATUS_WIDTH-1:0] status;
  logic [SEGMENTS-1:0]     beyond;

  blysk_front_end front_end (
    .clk_i, .load_i(load[FRONT_END:COMPARE]),
    .x_i(x), .status_i(word_status), .word_i(word), .fields_i(fields), .beyond_o(beyond),
    .v_o(v), .tail_x_o(tail_x), .region_o(region), .status_o(status)
  );

  // ---- The middle ranks: the polynomial -----------------------------------------------------------
  logic [POLYNOMIAL_WIDTH-1:0] t_waited;

  if (HAS_POLYNOMIAL != 0) begin : polynomial

    // Coefficient i of the segment that answers waits for what reads it: the highest for the multiplier of stage 1,
    // each other for the adder of a stage.
    genvar i, k;
    for (i = 0; i <= DEGREE; i = i + 1) begin : coefficient
      localparam int WIDTH = C_WIDTH[32*i+:32];
      localparam int HELD  = i == DEGREE ? 1 : (DEGREE - i - 1) * LINE + OPERAND_RANKS + PRODUCT_RANKS + 1;
      logic [WIDTH-1:0] chosen, at_stage;
      for (k = 0; k < SEGMENTS; k = k + 1) begin : segment
        localparam int PLACE = C_PLACE[32*(k*(DEGREE+1)+i)+:32];
        // Of segment k, or of the one before that answers.
        logic [WIDTH-1:0] choice;
        if (k == 0) begin : first
          assign choice = fields[PLACE+:WIDTH];
        end else begin : further
          assign choice = beyond[k] ? fields[PLACE+:WIDTH] : segment[k-1].choice;
        end
      end
      assign chosen = segment[SEGMENTS-1].choice;
      blysk_delay #(.WIDTH(WIDTH), .RANKS(HELD), .STORED(C_CARRIED[32*i+:32])) delay (
        .clk_i, .load_i(load[FRONT_END+HELD-1:FRONT_END]), .value_i(chosen), .value_o(at_stage));
    end

    // Segment 0 needs no bit: it answers where no other one does.
    logic unused;
    assign unused = &{1'b0, beyond};

    // Stage j: t(j) = c(DEGREE - j) +- t(j - 1)*v, where t(0) is the highest coefficient.
    genvar j;
    for (j = 1; j <= DEGREE; j = j + 1) begin : stage
      localparam int M_WIDTH = T_WIDTH[32*(j-1)+:32];
      localparam int A_WIDTH = C_WIDTH[32*(DEGREE-j)+:32];
      localparam int R_WIDTH = T_WIDTH[32*j+:32];
      // Its last rank.
      localparam int LAST    = FRONT_END + j * LINE;
      logic [V_WIDTH-1:0] v_here, v_multiplied;
      logic [M_WIDTH-1:0] multiplicand;
      logic [R_WIDTH-1:0] t;

      if (j == 1) begin : first
        assign v_here       = v;
        assign multiplicand = coefficient[DEGREE].at_stage;
      end else begin : later
        assign multiplicand = stage[j-1].t;
        blysk_delay #(.WIDTH(V_WIDTH), .RANKS(LINE - OPERAND_RANKS)) v_delay (
          .clk_i, .load_i(load[LAST-LINE:LAST-2*LINE+1+OPERAND_RANKS]),
          .value_i(stage[j-1].v_multiplied), .value_o(v_here));
      end

      blysk_stage #(
        .MULTIPLICAND_WIDTH(M_WIDTH), .MULTIPLICAND_SIGNED(T_SIGNED[32*(j-1)+:32]),
        .MULTIPLICAND_STORED(j == 1 ? C_CARRIED[32*DEGREE+:32] : 1),
        .VARIABLE_WIDTH(V_WIDTH),
        .ADDEND_WIDTH(A_WIDTH), .ADDEND_SIGNED(C_SIGNED[32*(DEGREE-j)+:32]),
        .T_WIDTH(R_WIDTH), .SUBTRACT(CENTRED),
        .PRODUCT_UP(T_PRODUCT_UP[32*j+:32]), .ADDEND_UP(T_ADDEND_UP[32*j+:32]),
        .RESULT_UP(T_RESULT_UP[32*j+:32]), .DROP(T_DROP[32*j+:32]),
        .SUM_WIDTH(T_SUM_WIDTH[32*j+:32]), .ROUNDING(T_ROUNDING[32*j+:32]),
        .OPERAND_RANKS(OPERAND_RANKS), .PRODUCT_RANKS(PRODUCT_RANKS), .SUM_RANKS(SUM_RANKS)
      ) multiply_add (
        .clk_i, .load_i(load[LAST:LAST-LINE+1]),
        .multiplicand_i(multiplicand), .variable_i(v_here), .addend_i(coefficient[DEGREE-j].at_stage),
        .variable_o(v_multiplied), .t_o(t)
      );
    end

    logic v_unused;
    assign v_unused = &{1'b0, stage[DEGREE].v_multiplied};

    // The clamp takes the last result from rank RANKS - 2.
    localparam int DONE = FRONT_END + DEGREE * LINE;
    localparam int WAIT = RANKS - 2 - DONE;
    if (WAIT > 0) begin : wait_for_tail
      blysk_delay #(.WIDTH(POLYNOMIAL_WIDTH), .RANKS(WAIT)) t_delay (
        .clk_i, .load_i(load[RANKS-2:DONE+1]), .value_i(stage[DEGREE].t), .value_o(t_waited));
    end else begin : no_wait
      assign t_waited = stage[DEGREE].t;
    end
  end else begin : no_polynomial
    assign t_waited = '0;
    logic unused;
    assign unused = &{1'b0, v, beyond};
  end

  // ---- The middle ranks: the tail -----------------------------------------------------------------
  logic [DIVISOR_WIDTH-1:0] remainder_waited;
  logic [DIGITS_WIDTH-1:0]  digits_waited;

  if (HAS_TAIL != 0) begin : tail
    // The rank of the last quotient bits.
    localparam int LAST   = FRONT_END + LINE + DIGIT_STAGES;
    localparam int A_HELD = OPERAND_RANKS + PRODUCT_RANKS + 1;
    logic [TAIL_A_WIDTH-1:0] a, a_added;
    logic [TAIL_B_WIDTH-1:0] b, b_multiplied;
    assign a = fields[TAIL_A_PLACE+:TAIL_A_WIDTH];
    assign b = fields[TAIL_B_PLACE+:TAIL_B_WIDTH];
    logic [DIVISOR_WIDTH-1:0] remainder;
    logic [DIGITS_WIDTH-1:0]  digits;

    blysk_delay #(.WIDTH(TAIL_A_WIDTH), .RANKS(A_HELD), .STORED(TAIL_A_STORED)) a_delay (
      .clk_i, .load_i(load[FRONT_END+A_HELD-1:FRONT_END]), .value_i(a), .value_o(a_added));
    blysk_delay #(.WIDTH(TAIL_B_WIDTH), .RANKS(1), .STORED(TAIL_B_STORED)) b_delay (
      .clk_i, .load_i(load[FRONT_END]), .value_i(b), .value_o(b_multiplied));

    blysk_tail divider (
      .clk_i, .load_i(load[LAST:FRONT_END+1]),
      .x_i(tail_x), .a_i(a_added), .b_i(b_multiplied),
      .remainder_o(remainder), .digits_o(digits)
    );

    if (RANKS - 2 > LAST) begin : wait_for_polynomial
      blysk_delay #(.WIDTH(DIVISOR_WIDTH), .RANKS(RANKS - 2 - LAST)) remainder_delay (
        .clk_i, .load_i(load[RANKS-2:LAST+1]), .value_i(remainder), .value_o(remainder_waited));
      blysk_delay #(.WIDTH(DIGITS_WIDTH), .RANKS(RANKS - 2 - LAST)) digits_delay (
        .clk_i, .load_i(load[RANKS-2:LAST+1]), .value_i(digits), .value_o(digits_waited));
    end else begin : no_wait
      assign remainder_waited = remainder;
      assign digits_waited    = digits;
    end
  end else begin : no_tail
    assign remainder_waited = '0;
    assign digits_waited    = '0;
    logic unused;
    assign unused = &{1'b0, tail_x};
  end

  // ---- Region and status go along -----------------------------------------------------------------
  logic [REGION_WIDTH-1:0] region_waited;
  logic [STATUS_WIDTH-1:0] status_waited;

  blysk_delay #(.WIDTH(REGION_WIDTH), .RANKS(RANKS - 2 - FRONT_END)) region_delay (
    .clk_i, .load_i(load[RANKS-2:FRONT_END+1]), .value_i(region), .value_o(region_waited));
  blysk_delay #(.WIDTH(STATUS_WIDTH), .RANKS(RANKS - 2 - FRONT_END)) status_delay (
    .clk_i, .load_i(load[RANKS-2:FRONT_END+1]), .value_i(status), .value_o(status_waited));

  // ---- Last rank: clamp ---------------------------------------------------------------------------
  blysk_clamp clamp (
    .clk_i, .load_i(load[RANKS-1]),
    .region_i(region_waited), .status_i(status_waited),
    .t_i(t_waited), .remainder_i(remainder_waited), .digits_i(digits_waited),
    .intensity_o(result_intensity), .status_o(result_status)
  );

endmodule

`default_nettype wire
