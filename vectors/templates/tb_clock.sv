  // ---- Clock, DUT ---------------------------------------------------------------------------------
  logic               clk, rst, in_valid, out_ready;
  logic [ADDRESS-1:0] address;
  logic [INPUT-1:0]   x;
  logic               in_ready, out_valid;
  logic [OUTPUT-1:0]  intensity;
  logic [STATUS-1:0]  status;

  initial begin
    clk = 1'b0;
    // The end comes between two rising edges: waves have what the last one brought.
    forever begin
      #5 clk = !clk;
      if (ended && !clk) $finish(0);
    end
  end
