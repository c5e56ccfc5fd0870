// A testbench that has no expected answers: it drives the DUT with random requests, stalls, bubbles and resets, and
// leaves the judgement to blysk_checker, or, built with -DVPI, to blysk_vpi_checker.
//
//   +cycles=N   clock cycles (10000)
//   +seed=N     other random numbers (1)
//
// Built with -DUNCHECKED it has no checker: what a simulation costs without one.
`timescale 1ns / 1ps
`default_nettype none

`ifndef CONFIGURATION
`define CONFIGURATION "compact"
`endif
`ifndef WATCH
`define WATCH ""
`endif
`ifndef DUT
`define DUT blysk
`endif

module blysk_golden_tb;

  localparam int ADDRESS = blysk_pkg::ADDRESS_WIDTH;
  localparam int INPUT   = blysk_pkg::INPUT_WIDTH;
  localparam int OUTPUT  = blysk_pkg::OUTPUT_WIDTH;
  localparam int STATUS  = blysk_pkg::STATUS_WIDTH;
  // x = 1, where the format has one integer bit.
  localparam logic [63:0] ONE = 64'd1 << (INPUT - 1);

  logic               clk, rst, in_valid, in_ready, out_valid, out_ready;
  logic [ADDRESS-1:0] address;
  logic [INPUT-1:0]   x;
  logic [OUTPUT-1:0]  intensity;
  logic [STATUS-1:0]  status;

  logic [31:0] random, draws;
  logic [2:0]  mode;
  integer      cycles, cycle, seed;

  `DUT dut (
    .clk_i(clk), .rst_i(rst),
    .in_valid_i(in_valid), .in_ready_o(in_ready), .address_i(address), .x_i(x),
    .out_valid_o(out_valid), .out_ready_i(out_ready), .intensity_o(intensity), .status_o(status)
  );

`ifdef UNCHECKED
`else
`ifdef VPI
  blysk_vpi_checker #(
    .CONFIGURATION(`CONFIGURATION), .WATCH(`WATCH)
  ) golden (
`else
  blysk_checker #(
    .CONFIGURATION(`CONFIGURATION)
  ) golden (
`endif
    .clk_i(clk), .rst_i(rst),
    .in_valid_i(in_valid), .in_ready_o(in_ready), .address_i(address), .x_i(x),
    .out_valid_o(out_valid), .out_ready_i(out_ready), .intensity_o(intensity), .status_o(status)
  );
`endif

  initial begin
    clk = 1'b0; rst = 1'b1; in_valid = 1'b0; out_ready = 1'b0; address = '0; x = '0; mode = '0; cycle = 0;
    if (!$value$plusargs("cycles=%d", cycles)) cycles = 10000;
    if (!$value$plusargs("seed=%d", seed)) seed = 1;
    random = seed * 32'h9e3779b9 + 32'h7f4a7c15;
    if (random == 0) random = 1;
  end

  always #5 clk = !clk;

  // Xorshift: the same numbers in every simulator.
  function automatic logic [31:0] next(input logic [31:0] state);
    next = state ^ (state << 13);
    next = next ^ (next >> 17);
    next = next ^ (next << 5);
  endfunction

  // Blocks of 64 cycles: without trouble, with stalls, with bubbles, with both; x mostly near 1, where highlights are.
  always @(posedge clk) begin
    draws  = next(random);
    random = next(draws);
    if (cycle % 64 == 0) mode = draws[10:8];
    rst       <= cycle < 2 || (mode[2] && random[31:24] == 0);
    out_ready <= !(mode[0] && draws[0]);
    // A request that was not taken stays.
    if (!in_valid || in_ready || rst) begin
      in_valid <= !(mode[1] && draws[1]);
      address  <= ADDRESS'(random);
      if (draws[31:30] == 0) x <= INPUT'({random, draws});
      else x <= INPUT'(ONE - ({random, draws} >> (66 - INPUT + draws[5:2])));
    end
    cycle = cycle + 1;
    if (cycle == cycles) $finish;
  end

endmodule

`default_nettype wire
