// A testbench in Verilog-2005, as the whole pipeline is: every vector, with stalls and bubbles. The macros VECTORS,
// ADDRESS, INPUT, OUTPUT and STATUS come from the command line.
`timescale 1ns / 1ps
module verilog_2005;
  reg [`ADDRESS+`INPUT-1:0] stimulus[0:`VECTORS-1];
  reg [`STATUS+`OUTPUT-1:0] expected[0:`VECTORS-1];
  reg clk, rst, in_valid, out_ready;
  reg [31:0] random;
  wire in_ready, out_valid;
  wire [`OUTPUT-1:0] intensity;
  wire [`STATUS-1:0] status;
  integer sent, received, stalls, cycle;

  blysk dut (
    .clk_i(clk), .rst_i(rst), .in_valid_i(in_valid), .in_ready_o(in_ready),
    .address_i(stimulus[sent % `VECTORS][`INPUT+:`ADDRESS]), .x_i(stimulus[sent % `VECTORS][0+:`INPUT]),
    .out_valid_o(out_valid), .out_ready_i(out_ready), .intensity_o(intensity), .status_o(status)
  );

  always #5 clk = !clk;

  initial begin
    $readmemh("stimulus.mem", stimulus);
    $readmemh("expected.mem", expected);
    clk = 0; rst = 1; in_valid = 0; out_ready = 0; random = 1; sent = 0; received = 0; stalls = 0; cycle = 0;
  end

  always @(posedge clk) begin
    cycle = cycle + 1;
    random = random ^ (random << 13);
    random = random ^ (random >> 17);
    random = random ^ (random << 5);
    if (out_valid && !out_ready) stalls = stalls + 1;
    if (!rst && out_valid && out_ready) begin
      if ({status, intensity} !== expected[received]) begin
        $display("FAIL vector %0d is %h, expected %h", received, {status, intensity}, expected[received]);
        $finish;
      end
      received = received + 1;
    end
    if (received == `VECTORS || cycle > 100 * `VECTORS + 1000) begin
      if (received == `VECTORS && stalls > 0) $display("PASS %0d vectors", received);
      else $display("FAIL %0d vectors were answered, with %0d stalls", received, stalls);
      $finish;
    end
    rst <= cycle < 4;
    out_ready <= random[0];
    // A request that was not taken stays.
    if (in_valid && in_ready) sent <= sent + 1;
    if (!in_valid || in_ready) in_valid <= random[1] && cycle >= 4 && sent + (in_valid && in_ready) < `VECTORS;
  end
endmodule
