// The front end for every row of the ROM image and every x: the variable of the polynomial fits its
// register, and each part is fed what it should be.
//
// load_i is free where the front end has one rank: its registers may wait any time. A cut one loads both its ranks in
// every cycle here; that ranks wait for each other is proved of the handshake.
`default_nettype none

module front_end_proof #(
  parameter ROM_FILE = "rom.mem"
) (
  input logic                                  clk_i,
  input logic [blysk_pkg::FRONT_END_RANKS:0]   load_i,
  input logic                                  no_word_i,
  input logic [blysk_pkg::ROM_INDEX_WIDTH-1:0] row_i,
  input logic [blysk_pkg::INPUT_WIDTH-1:0]     x_i
);

  // ---- A row --------------------------------------------------------------------------------------
  logic [blysk_pkg::ROM_WIDTH-1:0]   words[0:blysk_pkg::ROM_DEPTH-1];
  logic [blysk_pkg::FIELDS_WIDTH-1:0] of_row, word, fields;
  logic [blysk_pkg::CUT_WIDTH-1:0]    cut;
  initial $readmemh(ROM_FILE, words);

  blysk_fields all (.word_i(words[row_i]), .fields_o(of_row));
  assign cut = of_row[blysk_pkg::CUT_PLACE+:blysk_pkg::CUT_WIDTH];
  always_comb begin
    word = of_row;
    if (blysk_pkg::HAS_POLYNOMIAL != 0) word[blysk_pkg::CUT_PLACE+:blysk_pkg::CUT_WIDTH] = cut;
  end

  // ---- The same row and x as the choice behind the comparisons reads them --------------------------
  localparam int CUT = blysk_pkg::FRONT_END_RANKS;
  logic                              no_word_late;
  logic [blysk_pkg::INPUT_WIDTH-1:0] x_late;
  blysk_delay #(.WIDTH(blysk_pkg::FIELDS_WIDTH), .RANKS(1), .STORED(CUT)) word_delay (
    .clk_i, .load_i(load_i[0]), .value_i(word), .value_o(fields));
  blysk_delay #(.WIDTH(blysk_pkg::INPUT_WIDTH), .RANKS(1), .STORED(CUT)) x_delay (
    .clk_i, .load_i(load_i[0]), .value_i(x_i), .value_o(x_late));
  blysk_delay #(.WIDTH(1), .RANKS(1), .STORED(CUT)) no_word_delay (
    .clk_i, .load_i(load_i[0]), .value_i(no_word_i), .value_o(no_word_late));

  logic [CUT:0] ranks_filled;
  filled #(.RANKS(CUT + 1)) front_end_filled (.clk_i, .load_i, .filled_o(ranks_filled));
  if (CUT != 0) begin : two_ranks
    always_comb assume (load_i == '1);
  end

  // ---- The front end ------------------------------------------------------------------------------
  logic [blysk_pkg::STATUS_WIDTH-1:0] fetch_status, status;
  logic [blysk_pkg::V_WIDTH-1:0]      v;
  logic [blysk_pkg::X_WIDTH-1:0]      tail_x;
  logic [blysk_pkg::REGION_WIDTH-1:0] region;
  logic [blysk_pkg::SEGMENTS-1:0]     beyond;
  assign fetch_status = blysk_pkg::STATUS_WIDTH'(no_word_i) << blysk_pkg::STATUS_NO_WORD;

  blysk_front_end front_end (
    .clk_i, .load_i, .x_i, .status_i(fetch_status), .word_i(word), .fields_i(fields), .beyond_o(beyond),
    .v_o(v), .tail_x_o(tail_x), .region_o(region), .status_o(status)
  );

  // ---- The same on paper --------------------------------------------------------------------------
  localparam int SHIFTED = 1 << (blysk_pkg::SHIFT_COMMON_WIDTH - 1);
  localparam int WIDE    = blysk_pkg::INPUT_WIDTH + blysk_pkg::U_UP + SHIFTED + 6;
  localparam logic signed [WIDE-1:0] ONE = 1;
  localparam logic signed [WIDE-1:0] X_ONE = ONE <<< blysk_pkg::INPUT_FRACTION;
  localparam logic signed [WIDE-1:0] X_GREATEST = WIDE'(blysk_pkg::X_GREATEST);

  // Where each segment begins, in the unit of x, and its shift.
  localparam int SEGMENTS = blysk_pkg::SEGMENTS;
  localparam int PLACES   = blysk_pkg::SHIFT_COMMON_WIDTH;
  logic [SEGMENTS*WIDE-1:0]   begins;
  logic [SEGMENTS*PLACES-1:0] shifts;
  for (genvar k = 0; k < SEGMENTS; k++) begin : segment
    if (blysk_pkg::CENTRED != 0 && blysk_pkg::HAS_POLYNOMIAL != 0) begin : shifted
      assign shifts[k*PLACES+:PLACES] =
          PLACES'(fields[blysk_pkg::SHIFT_PLACES[32*k+:32]+:blysk_pkg::SHIFT_WIDTHS[32*k+:32]]);
    end else begin : not_shifted
      assign shifts[k*PLACES+:PLACES] = '0;
    end
    if (k == 0) begin : first
      assign begins[0+:WIDE] = X_ONE;
    end else begin : further
      localparam int PLACE = blysk_pkg::HAND_OVER_PLACES[32*k+:32];
      localparam int WIDTH = blysk_pkg::HAND_OVER_WIDTHS[32*k+:32];
      assign begins[k*WIDE+:WIDE] = WIDE'(fields[PLACE+:WIDTH]) << blysk_pkg::HAND_OVER_UP;
    end
  end

  logic signed [WIDE-1:0]         port, x, first, start, s, u, exact, variable;
  logic                           polynomial;
  logic [blysk_pkg::SEGMENTS-1:0] below;
  logic [PLACES-1:0]              places;
  logic [blysk_pkg::CUT_WIDTH-1:0] least;
  assign least = fields[blysk_pkg::CUT_PLACE+:blysk_pkg::CUT_WIDTH];
  always_comb begin
    port       = blysk_pkg::INPUT_SIGNED != 0 ? WIDE'($signed(x_late)) : WIDE'(x_late);
    x          = port < 0 ? '0 : port > X_GREATEST ? X_GREATEST : port;
    // The cut in the unit of x.
    first      = WIDE'(least) <<< blysk_pkg::CUT_UP;
    polynomial = blysk_pkg::HAS_POLYNOMIAL != 0 && !no_word_late && port >= 0 && x >= first;
    // The furthest segment whose start lies above x.
    start      = X_ONE;
    places     = shifts[0+:PLACES];
    below      = '0;
    for (int k = 1; k < SEGMENTS; k++) begin
      if (polynomial && x < $signed(begins[k*WIDE+:WIDE])) begin
        below[k] = 1'b1;
        start    = $signed(begins[k*WIDE+:WIDE]);
        places   = shifts[k*PLACES+:PLACES];
      end
    end
    s          = polynomial ? start - x : '0;
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
  assign loaded = ranks_filled[CUT];
  always_ff @(posedge clk_i) begin
    if (load_i[CUT]) begin
      was_variable   <= variable;
      was_x          <= x;
      was_polynomial <= polynomial;
      was_tail       <= blysk_pkg::HAS_TAIL != 0 && !polynomial && !no_word_late && port >= 0;
    end
  end

  always_comb begin
    if (load_i[0]) assume (row_i < blysk_pkg::ROM_DEPTH);
    if (CUT == 0 || ranks_filled[0]) right_segment: assert (beyond == below);
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
