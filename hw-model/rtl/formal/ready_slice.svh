// A register slice is a queue of two. Placed into blysk_ready_slice, before its endmodule.
//
// The values that come in are numbered, and they come out in this order, none lost or doubled, under any stalls; ready
// is high while there is room for one more, and it is what was told a cycle before.
  logic             started, settled, told;
  logic [WIDTH-1:0] entered, left;
  initial started = 1'b0;
  // A reset that does not wait for the clock takes the flags away at once.
  assign settled = started && !(RESET_ASYNCHRONOUS != 0 && rst_i);

  always_ff @(posedge clk_i) begin
    started <= 1'b1;
    told    <= rst_i || in_ready_d_o;
    if (rst_i) begin
      entered <= '0;
      left    <= '0;
    end else begin
      entered <= entered + WIDTH'(in_valid_i && in_ready_o);
      left    <= left + WIDTH'(out_valid_o && out_ready_i);
    end
  end

  always_comb begin
    if (!started) assume (rst_i);
    assume (value_i == entered);
    if (settled) begin
      all_there:  assert (entered - left == WIDTH'(stored.valid_q[0]) + WIDTH'(stored.valid_q[1]));
      head_first: assert (stored.valid_q[0] || !stored.valid_q[1]);
      if (stored.valid_q[0]) in_order: assert (value_o == left);
      if (stored.valid_q[1]) spare_follows: assert (stored.spare_q == left + WIDTH'(1));
      ready_if_room: assert (in_ready_o == (entered - left != WIDTH'(2)));
      as_told: assert (in_ready_o == told);
    end
  end
