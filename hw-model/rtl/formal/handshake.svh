// No result is lost, duplicated or reordered. Placed into blysk_handshake, before its endmodule.
//
// Every request takes a tag along, the number of requests before it, in registers that load as the
// pipeline's do. The tag that leaves must be the number of results before it. Tags count modulo more
// than there are ranks, so that no two results in flight have the same.
  localparam int TAG_WIDTH = $clog2(RANKS + 1) + 1;
  // The rule that the ranks follow.
  localparam int COLLAPSE = KIND == blysk_pkg::HANDSHAKE_VALID_READY ? 1 : 0;
  logic taken;
  assign taken = out_ready_i || KIND == blysk_pkg::HANDSHAKE_NONE;

  // Registers hold what the rules say: after the first edge, and where a reset does not take them away at once.
  logic                 started, settled;
  assign settled = started && !(RESET_ASYNCHRONOUS != 0 && rst_i);
  logic [TAG_WIDTH-1:0] entered, left;
  initial started = 1'b0;

  always_ff @(posedge clk_i) begin
    started <= 1'b1;
    if (rst_i) begin
      entered <= '0;
      left    <= '0;
    end else begin
      entered <= entered + TAG_WIDTH'(in_valid_i && in_ready_o);
      left    <= left + TAG_WIDTH'(out_valid_o && taken);
    end
  end

  // Power-up is followed by a reset; after it anything may happen, more resets too.
  always_comb if (!started) assume (rst_i);

  // Ready that is told a cycle ahead comes as it was told, and so does what each rank does.
  if (COLLAPSE != 0 && READY_AHEAD != 0) begin : told_ahead
    logic told;
    always_ff @(posedge clk_i) told <= rst_i || out_ready_d_i;
    always_comb if (settled) assume (out_ready_i == told);
    for (genvar rank = 0; rank < RANKS; rank++) begin : known
      always_comb if (settled) assert (advance[rank] == (out_ready_i || !(&valid_q[RANKS-1:rank])));
    end
  end

  // The tag at each rank, and how many results are at it or after it.
  logic [(RANKS+1)*TAG_WIDTH-1:0] tags, held;
  assign tags[TAG_WIDTH-1:0]            = entered;
  assign held[RANKS*TAG_WIDTH+:TAG_WIDTH] = '0;

  for (genvar rank = 0; rank < RANKS; rank++) begin : tagged
    logic [TAG_WIDTH-1:0] tag, behind;
    blysk_delay #(.WIDTH(TAG_WIDTH), .RANKS(1)) tag_delay (
      .clk_i, .load_i(load_o[rank]), .value_i(tags[rank*TAG_WIDTH+:TAG_WIDTH]), .value_o(tag));
    assign tags[(rank+1)*TAG_WIDTH+:TAG_WIDTH] = tag;
    assign behind = held[(rank+1)*TAG_WIDTH+:TAG_WIDTH];
    assign held[rank*TAG_WIDTH+:TAG_WIDTH] = behind + TAG_WIDTH'(valid_q[rank]);

    always_comb if (settled && valid_q[rank]) assert (tag == left + behind);
    if (COLLAPSE != 0 && rank + 1 < RANKS) begin : gap
      always_comb if (settled && valid_q[rank] && !valid_q[rank+1]) assert (load_o[rank+1]);
    end
  end

  always_comb begin
    if (settled) all_there: assert (entered - left == held[TAG_WIDTH-1:0]);
    if (settled && out_valid_o) next_result: assert (tags[RANKS*TAG_WIDTH+:TAG_WIDTH] == left);
    if (settled) ready_if_room: assert (in_ready_o == (taken || (COLLAPSE != 0 && !(&valid_q))));
  end
