// The pipelined multiply-adds are the unpipelined expression, under any stalls. Placed into blysk,
// before its endmodule.
//
// What a result was computed from goes along with it, rank by rank: coefficients, v, t(1), t(2), ... At every
// rank each t(j) must be the line of what is beside it (by induction: it is when it is
// computed, and stays so). At the last rank before the clamp, the last t must be the lines nested, a
// function of the coefficients and v alone.
  localparam int LAST   = blysk_pkg::RANKS - 2;
  localparam int REGION = blysk_pkg::REGION_WIDTH;
  localparam int STATUS = blysk_pkg::STATUS_WIDTH;

  logic [LAST:0] has_result;
  filled #(.RANKS(LAST + 1)) ranks_filled (.clk_i, .load_i(load[LAST:0]), .filled_o(has_result));

  logic [(LAST-FRONT_END+1)*REGION-1:0] regions;
  logic [(LAST-FRONT_END+1)*STATUS-1:0] statuses;
  trail #(.WIDTH(REGION), .RANKS(LAST - FRONT_END)) region_trail (
    .clk_i, .load_i(load[LAST:FRONT_END+1]), .value_i(region), .trail_o(regions));
  trail #(.WIDTH(STATUS), .RANKS(LAST - FRONT_END)) status_trail (
    .clk_i, .load_i(load[LAST:FRONT_END+1]), .value_i(status), .trail_o(statuses));
  always_comb begin
    if (has_result[LAST]) begin
      own_region: assert (region_waited == regions[(LAST-FRONT_END)*REGION+:REGION]);
      own_status: assert (status_waited == statuses[(LAST-FRONT_END)*STATUS+:STATUS]);
    end
  end

  if (blysk_pkg::HAS_POLYNOMIAL != 0) begin : lines
    localparam int DEGREE = blysk_pkg::DEGREE;
    localparam int V      = blysk_pkg::V_WIDTH;

    // From the rank of each on, to the last: coefficients from the choice before the front end's rank.
    for (genvar i = 0; i <= DEGREE; i++) begin : c
      localparam int WIDTH = blysk_pkg::C_WIDTH[32*i+:32];
      logic [(LAST-FRONT_END+2)*WIDTH-1:0] all;
      trail #(.WIDTH(WIDTH), .RANKS(LAST - FRONT_END + 1), .STORED(blysk_pkg::C_CARRIED[32*i+:32])) along (
        .clk_i, .load_i(load[LAST:FRONT_END]), .value_i(polynomial.coefficient[i].chosen), .trail_o(all));
    end
    logic [(LAST-FRONT_END+1)*V-1:0] vs;
    trail #(.WIDTH(V), .RANKS(LAST - FRONT_END)) v_trail (
      .clk_i, .load_i(load[LAST:FRONT_END+1]), .value_i(v), .trail_o(vs));
    // t(j) is in rank FRONT_END + j * LINE. The last is looked at where the design has it.
    for (genvar j = 1; j <= DEGREE; j++) begin : t
      localparam int WIDTH = blysk_pkg::T_WIDTH[32*j+:32];
      localparam int DONE  = FRONT_END + j * LINE;
      logic [(LAST-DONE+1)*WIDTH-1:0] all;
      if (DONE < LAST) begin : on
        trail #(.WIDTH(WIDTH), .RANKS(LAST - DONE)) along (
          .clk_i, .load_i(load[LAST:DONE+1]), .value_i(polynomial.stage[j].t), .trail_o(all));
      end else begin : last
        assign all = polynomial.stage[j].t;
      end
    end

    for (genvar rank = FRONT_END + 1; rank <= LAST; rank++) begin : at
      logic [V-1:0] along_v;
      assign along_v = vs[(rank-FRONT_END)*V+:V];

      for (genvar j = 1; j <= DEGREE; j++) begin : line_of
        localparam int M = blysk_pkg::T_WIDTH[32*(j-1)+:32];
        localparam int A = blysk_pkg::C_WIDTH[32*(DEGREE-j)+:32];
        localparam int T = blysk_pkg::T_WIDTH[32*j+:32];
        localparam int DONE = FRONT_END + j * LINE;
        // What is beside it in this rank, and of the line itself, nested.
        logic [M-1:0] multiplicand, inner;
        logic [A-1:0] addend;
        logic [T-1:0] along_t, result, nested;
        assign addend = c[DEGREE-j].all[(rank-FRONT_END+1)*A+:A];

        if (j == 1) begin : first
          assign multiplicand = c[DEGREE].all[(rank-FRONT_END+1)*M+:M];
          assign inner        = multiplicand;
        end else if (rank >= DONE - LINE) begin : later
          assign multiplicand = t[j-1].all[(rank-DONE+LINE)*M+:M];
          assign inner        = line_of[j-1].nested;
        end else begin : none
          assign multiplicand = '0;
          assign inner        = '0;
        end

        line #(
          .MULTIPLICAND_WIDTH(M), .MULTIPLICAND_SIGNED(blysk_pkg::T_SIGNED[32*(j-1)+:32]),
          .VARIABLE_WIDTH(V), .T_WIDTH(T),
          .ADDEND_WIDTH(A), .ADDEND_SIGNED(blysk_pkg::C_SIGNED[32*(DEGREE-j)+:32]),
          .SUBTRACT(blysk_pkg::CENTRED), .PRODUCT_UP(blysk_pkg::T_PRODUCT_UP[32*j+:32]),
          .ADDEND_UP(blysk_pkg::T_ADDEND_UP[32*j+:32]), .RESULT_UP(blysk_pkg::T_RESULT_UP[32*j+:32]),
          .DROP(blysk_pkg::T_DROP[32*j+:32]), .ROUNDING(blysk_pkg::T_ROUNDING[32*j+:32]),
          .SUM_WIDTH(blysk_pkg::T_SUM_WIDTH[32*j+:32])
        ) beside (
          .multiplicand_i(multiplicand), .variable_i(along_v), .addend_i(addend), .t_o(result)
        );
        line #(
          .MULTIPLICAND_WIDTH(M), .MULTIPLICAND_SIGNED(blysk_pkg::T_SIGNED[32*(j-1)+:32]),
          .VARIABLE_WIDTH(V), .T_WIDTH(T),
          .ADDEND_WIDTH(A), .ADDEND_SIGNED(blysk_pkg::C_SIGNED[32*(DEGREE-j)+:32]),
          .SUBTRACT(blysk_pkg::CENTRED), .PRODUCT_UP(blysk_pkg::T_PRODUCT_UP[32*j+:32]),
          .ADDEND_UP(blysk_pkg::T_ADDEND_UP[32*j+:32]), .RESULT_UP(blysk_pkg::T_RESULT_UP[32*j+:32]),
          .DROP(blysk_pkg::T_DROP[32*j+:32]), .ROUNDING(blysk_pkg::T_ROUNDING[32*j+:32]),
          .SUM_WIDTH(blysk_pkg::T_SUM_WIDTH[32*j+:32])
        ) whole (
          .multiplicand_i(inner), .variable_i(along_v), .addend_i(addend), .t_o(nested)
        );

        if (rank >= DONE) begin : computed
          if (j == DEGREE && rank == LAST) begin : waited
            assign along_t = t_waited;
          end else begin : on
            assign along_t = t[j].all[(rank-DONE)*T+:T];
          end
          always_comb if (has_result[rank]) assert (along_t == result);
          if (j == DEGREE && rank == LAST) begin : all_of_them
            always_comb if (has_result[rank]) assert (t_waited == nested);
          end
        end else begin : not_yet
          assign along_t = '0;
        end
      end
    end
  end
