// What the ports promise. Placed into blysk, before its endmodule.
  logic started, stalled;
  logic [blysk_pkg::OUTPUT_WIDTH-1:0] stalled_intensity;
  logic [blysk_pkg::STATUS_WIDTH-1:0] stalled_status;
  initial {started, stalled} = '0;
  // Whether a result that is not taken waits.
  localparam int WAITS = HANDSHAKE != blysk_pkg::HANDSHAKE_NONE ? 1 : 0;

  always_ff @(posedge clk_i) begin
    started           <= 1'b1;
    stalled           <= WAITS != 0 && out_valid_o && !out_ready_i && !rst;
    stalled_intensity <= intensity_o;
    stalled_status    <= status_o;
  end

  always_comb begin
    if (!started) assume (rst);
    if (READY_IN_RESET == 0) nothing_in_reset: assert (!rst || !in_ready_o);
    // A reset that does not wait for the clock takes a result away at once.
    if (stalled && !(ASYNCHRONOUS != 0 && rst)) begin
      stays_valid: assert (out_valid_o);
      stays_same:  assert (intensity_o == stalled_intensity && status_o == stalled_status);
    end
  end
