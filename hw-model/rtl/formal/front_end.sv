// The front end for every row of the ROM image and every x: the variable of the polynomial fits its
// register, and each part is fed what it should be.
`default_nettype none

module front_end_proof #(
  parameter ROM_FILE = "rom.mem"
) (
  input logic                                  clk_i,
  input logic                                  load_i,
  input logic                                  no_word_i,
  input logic [blysk_pkg::ROM_INDEX_WIDTH-1:0] row_i,
  input logic [blysk_pkg::INPUT_WIDTH-1:0]     x_i
);

  // ---- A row --------------------------------------------------------------------------------------
  logic [blysk_pkg::ROM_WIDTH-1:0]   words[0:blysk_pkg::ROM_DEPTH-1];
  logic [blysk_pkg::CUT_WIDTH-1:0]   cut;
  logic [blysk_pkg::SHIFT_WIDTH-1:0] shift;
  logic [blysk_pkg::HAND_OVER_WIDTH-1:0]   hand_over;
  logic [blysk_pkg::SHIFT_OUTER_WIDTH-1:0] shift_outer;
  initial $readmemh(ROM_FILE, words);

  blysk_fields fields (
    .word_i(words[row_i]), .cut_o(cut), .shift_o(shift),
    .c3_o(), .c2_o(), .c1_o(), .c0_o(), .tail_a_o(), .tail_b_o(),
    .c3_outer_o(), .c2_outer_o(), .c1_outer_o(), .c0_outer_o(),
    .hand_over_o(hand_over), .shift_outer_o(shift_outer)
  );

  // ---- The front end ------------------------------------------------------------------------------
  logic [blysk_pkg::STATUS_WIDTH-1:0] fetch_status, status;
  logic [blysk_pkg::V_WIDTH-1:0]      v;
  logic [blysk_pkg::X_WIDTH-1:0]      tail_x;
  logic [blysk_pkg::REGION_WIDTH-1:0] region;
  logic                               outer;
  assign fetch_status = blysk_pkg::STATUS_WIDTH'(no_word_i) << blysk_pkg::STATUS_NO_WORD;

  blysk_front_end front_end (
    .clk_i, .load_i, .x_i, .status_i(fetch_status), .cut_i(cut), .shift_i(shift),
    .hand_over_i(hand_over), .shift_outer_i(shift_outer), .outer_o(outer),
    .v_o(v), .tail_x_o(tail_x), .region_o(region), .status_o(status)
  );

  // ---- The same on paper --------------------------------------------------------------------------
  localparam int SHIFTED = 1 << (blysk_pkg::SHIFT_COMMON_WIDTH - 1);
  localparam int WIDE    = blysk_pkg::INPUT_WIDTH + blysk_pkg::U_UP + SHIFTED + 6;
  localparam logic signed [WIDE-1:0] ONE = 1;
  localparam logic signed [WIDE-1:0] X_ONE = ONE <<< blysk_pkg::INPUT_FRACTION;
  localparam logic signed [WIDE-1:0] X_GREATEST = WIDE'(blysk_pkg::X_GREATEST);

  logic signed [WIDE-1:0] port, x, first, middle, s, u, exact, variable;
  logic                   polynomial, second;
  logic [blysk_pkg::SHIFT_COMMON_WIDTH-1:0] places;
  always_comb begin
    port       = blysk_pkg::INPUT_SIGNED != 0 ? WIDE'($signed(x_i)) : WIDE'(x_i);
    x          = port < 0 ? '0 : port > X_GREATEST ? X_GREATEST : port;
    // Both ends in the unit of x.
    first      = WIDE'(cut) <<< blysk_pkg::CUT_UP;
    middle     = WIDE'(hand_over) <<< blysk_pkg::HAND_OVER_UP;
    polynomial = blysk_pkg::HAS_POLYNOMIAL != 0 && !no_word_i && port >= 0 && x >= first;
    second     = blysk_pkg::SEGMENTS > 1 && polynomial && x < middle;
    s          = !polynomial ? '0 : second ? middle - x : X_ONE - x;
    places     = second ? blysk_pkg::SHIFT_COMMON_WIDTH'(shift_outer) : blysk_pkg::SHIFT_COMMON_WIDTH'(shift);
  end

  multiply_add #(
    .MULTIPLICAND_WIDTH(blysk_pkg::INPUT_WIDTH), .VARIABLE_WIDTH(SHIFTED), .SUBTRACT(0),
    .PRODUCT_UP(blysk_pkg::U_UP), .DROP(blysk_pkg::U_DROP), .ROUNDING(blysk_pkg::U_ROUNDING), .WIDE(WIDE)
  ) line (
    .multiplicand_i(blysk_pkg::INPUT_WIDTH'(s)), .variable_i(SHIFTED'(1) << places), .addend_i(1'b0),
    .exact_o(exact), .rounded_o(u)
  );

  always_comb begin
    if (blysk_pkg::HAS_POLYNOMIAL == 0) variable = '0;
    else if (blysk_pkg::CENTRED != 0)   variable = u;
    else                                variable = polynomial ? x : X_GREATEST;
  end

  logic                   loaded, was_polynomial, was_tail;
  logic signed [WIDE-1:0] was_variable, was_x;
  initial loaded = 1'b0;
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      loaded         <= 1'b1;
      was_variable   <= variable;
      was_x          <= x;
      was_polynomial <= polynomial;
      was_tail       <= blysk_pkg::HAS_TAIL != 0 && !polynomial && !no_word_i && port >= 0;
    end
  end

  always_comb begin
    if (load_i) assume (row_i < blysk_pkg::ROM_DEPTH);
    right_segment: assert (outer == second);
    if (loaded) begin
      variable_fits: assert (WIDE'(v) == was_variable);
      right_region:  assert (region == (was_polynomial ? blysk_pkg::REGION_POLYNOMIAL
          : was_tail ? blysk_pkg::REGION_TAIL : blysk_pkg::REGION_ZERO));
      divider_x:     assert (WIDE'(tail_x) == (was_tail ? was_x : '0));
    end
  end

  logic unused;
  assign unused = &{1'b0, exact, status};

endmodule

`default_nettype wire
