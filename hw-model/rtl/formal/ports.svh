// What the ports promise. Placed into blysk, before its endmodule.
  logic started, stalled;
  logic [blysk_pkg::OUTPUT_WIDTH-1:0] stalled_intensity;
  logic [blysk_pkg::STATUS_WIDTH-1:0] stalled_status;
  initial {started, stalled} = '0;

  always_ff @(posedge clk_i) begin
    started           <= 1'b1;
    stalled           <= out_valid_o && !out_ready_i && !rst_i;
    stalled_intensity <= intensity_o;
    stalled_status    <= status_o;
  end

  always_comb begin
    if (!started) assume (rst_i);
    nothing_in_reset: assert (!rst_i || !in_ready_o);
    if (stalled) begin
      stays_valid: assert (out_valid_o);
      stays_same:  assert (intensity_o == stalled_intensity && status_o == stalled_status);
    end
  end
