// The pipelined multiply-adds are the unpipelined expression, under any stalls. Placed into blysk,
// before its endmodule.
//
// What a result was computed from goes along with it, rank by rank: coefficients, v, t1, t2. At every
// rank t1, t2 and t3 must be the lines of what is beside them (by induction: they are when they are
// computed, and stay so). At the last rank before the clamp, t3 must be the three lines nested, a
// function of the coefficients and v alone.
`define LINE(MULTIPLICAND, ADDEND, T) \
  line #( \
    .MULTIPLICAND_WIDTH(blysk_pkg::MULTIPLICAND``_WIDTH), .MULTIPLICAND_SIGNED(blysk_pkg::MULTIPLICAND``_SIGNED), \
    .VARIABLE_WIDTH(blysk_pkg::V_WIDTH), .T_WIDTH(blysk_pkg::T``_WIDTH), \
    .ADDEND_WIDTH(blysk_pkg::ADDEND``_WIDTH), .ADDEND_SIGNED(blysk_pkg::ADDEND``_SIGNED), \
    .SUBTRACT(blysk_pkg::CENTRED), .PRODUCT_UP(blysk_pkg::T``_PRODUCT_UP), \
    .ADDEND_UP(blysk_pkg::T``_ADDEND_UP), .RESULT_UP(blysk_pkg::T``_RESULT_UP), .DROP(blysk_pkg::T``_DROP), \
    .ROUNDING(blysk_pkg::T``_ROUNDING), .SUM_WIDTH(blysk_pkg::T``_SUM_WIDTH))

  localparam int LAST   = blysk_pkg::RANKS - 2;
  localparam int REGION = blysk_pkg::REGION_WIDTH;
  localparam int STATUS = blysk_pkg::STATUS_WIDTH;

  logic [LAST:0] has_result;
  filled #(.RANKS(LAST + 1)) ranks_filled (.clk_i, .load_i(load[LAST:0]), .filled_o(has_result));

  logic [LAST*REGION-1:0] regions;
  logic [LAST*STATUS-1:0] statuses;
  trail #(.WIDTH(REGION), .RANKS(LAST - 1)) region_trail (
    .clk_i, .load_i(load[LAST:2]), .value_i(region), .trail_o(regions));
  trail #(.WIDTH(STATUS), .RANKS(LAST - 1)) status_trail (
    .clk_i, .load_i(load[LAST:2]), .value_i(status), .trail_o(statuses));
  always_comb begin
    if (has_result[LAST]) begin
      own_region: assert (region_waited == regions[(LAST-1)*REGION+:REGION]);
      own_status: assert (status_waited == statuses[(LAST-1)*STATUS+:STATUS]);
    end
  end

  if (blysk_pkg::HAS_POLYNOMIAL != 0) begin : lines
    localparam int C3 = blysk_pkg::C3_WIDTH;
    localparam int C2 = blysk_pkg::C2_WIDTH;
    localparam int C1 = blysk_pkg::C1_WIDTH;
    localparam int C0 = blysk_pkg::C0_WIDTH;
    localparam int V  = blysk_pkg::V_WIDTH;
    localparam int T1 = blysk_pkg::T1_WIDTH;
    localparam int T2 = blysk_pkg::T2_WIDTH;
    localparam int T3 = blysk_pkg::T3_WIDTH;

    // From the rank of each on, to the last.
    logic [(LAST+1)*C3-1:0] c3s;
    logic [(LAST+1)*C2-1:0] c2s;
    logic [(LAST+1)*C1-1:0] c1s;
    logic [(LAST+1)*C0-1:0] c0s;
    logic [LAST*V-1:0]      vs;
    logic [(LAST-1)*T1-1:0] t1s;
    logic [(LAST-2)*T2-1:0] t2s;
    trail #(.WIDTH(C3), .RANKS(LAST), .STORED(blysk_pkg::C3_CARRIED)) c3_trail (
      .clk_i, .load_i(load[LAST:1]), .value_i(polynomial.c3_chosen), .trail_o(c3s));
    trail #(.WIDTH(C2), .RANKS(LAST), .STORED(blysk_pkg::C2_CARRIED)) c2_trail (
      .clk_i, .load_i(load[LAST:1]), .value_i(polynomial.c2_chosen), .trail_o(c2s));
    trail #(.WIDTH(C1), .RANKS(LAST), .STORED(blysk_pkg::C1_CARRIED)) c1_trail (
      .clk_i, .load_i(load[LAST:1]), .value_i(polynomial.c1_chosen), .trail_o(c1s));
    trail #(.WIDTH(C0), .RANKS(LAST), .STORED(blysk_pkg::C0_CARRIED)) c0_trail (
      .clk_i, .load_i(load[LAST:1]), .value_i(polynomial.c0_chosen), .trail_o(c0s));
    trail #(.WIDTH(V), .RANKS(LAST - 1)) v_trail (
      .clk_i, .load_i(load[LAST:2]), .value_i(v), .trail_o(vs));
    trail #(.WIDTH(T1), .RANKS(LAST - 2)) t1_trail (
      .clk_i, .load_i(load[LAST:3]), .value_i(polynomial.t1), .trail_o(t1s));
    trail #(.WIDTH(T2), .RANKS(LAST - 3)) t2_trail (
      .clk_i, .load_i(load[LAST:4]), .value_i(polynomial.t2), .trail_o(t2s));

    for (genvar rank = 2; rank <= LAST; rank++) begin : at
      logic [C3-1:0] along_c3;
      logic [C2-1:0] along_c2;
      logic [C1-1:0] along_c1;
      logic [C0-1:0] along_c0;
      logic [V-1:0]  along_v;
      logic [T1-1:0] along_t1;
      assign along_c3 = c3s[rank*C3+:C3];
      assign along_c2 = c2s[rank*C2+:C2];
      assign along_c1 = c1s[rank*C1+:C1];
      assign along_c0 = c0s[rank*C0+:C0];
      assign along_v  = vs[(rank-1)*V+:V];
      assign along_t1 = t1s[(rank-2)*T1+:T1];

      logic [T1-1:0] line1;
      `LINE(C3, C2, T1) first (
        .multiplicand_i(along_c3), .variable_i(along_v), .addend_i(along_c2), .t_o(line1));
      always_comb if (has_result[rank]) assert (along_t1 == line1);

      if (rank >= 3) begin : from_3
        logic [T2-1:0] along_t2;
        assign along_t2 = t2s[(rank-3)*T2+:T2];
        logic [T2-1:0] line2;
        `LINE(T1, C1, T2) second (
          .multiplicand_i(along_t1), .variable_i(along_v), .addend_i(along_c1), .t_o(line2));
        always_comb if (has_result[rank]) assert (along_t2 == line2);

        if (rank >= 4) begin : from_4
          logic [T3-1:0] along_t3;
          if (rank == LAST) begin : waited
            assign along_t3 = t3_waited;
          end else if (rank == 4) begin : computed
            assign along_t3 = polynomial.t3;
          end else begin : waiting
            logic [(rank-3)*T3-1:0] t3s;
            trail #(.WIDTH(T3), .RANKS(rank - 4)) t3_trail (
              .clk_i, .load_i(load[rank:5]), .value_i(polynomial.t3), .trail_o(t3s));
            assign along_t3 = t3s[(rank-4)*T3+:T3];
          end
          logic [T3-1:0] line3;
          `LINE(T2, C0, T3) third (
            .multiplicand_i(along_t2), .variable_i(along_v), .addend_i(along_c0), .t_o(line3));
          always_comb if (has_result[rank]) assert (along_t3 == line3);

          if (rank == LAST) begin : whole
            // The three lines nested.
            logic [T2-1:0] nested2;
            logic [T3-1:0] nested3;
            `LINE(T1, C1, T2) second (
              .multiplicand_i(line1), .variable_i(along_v), .addend_i(along_c1), .t_o(nested2));
            `LINE(T2, C0, T3) third (
              .multiplicand_i(nested2), .variable_i(along_v), .addend_i(along_c0), .t_o(nested3));
            always_comb if (has_result[rank]) assert (t3_waited == nested3);
          end
        end
      end
    end
  end
