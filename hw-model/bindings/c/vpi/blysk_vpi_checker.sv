// Judges a DUT beside the golden model in a simulator without DPI-C, by the VPI functions of blysk_vpi.c. The twin of
// blysk_checker in dpi/, with the same parameters, ports and words.
//
// WATCH is the full name of the DUT's instance, such as "testbench.dut": then every register is judged too, and the
// first one that departs is named. Left empty, ports alone are.
`timescale 1ns / 1ps
`default_nettype none

module blysk_vpi_checker #(
  parameter CONFIGURATION       = "compact",
  parameter WATCH               = "",
  parameter int ADDRESS_WIDTH   = blysk_pkg::ADDRESS_WIDTH,
  parameter int INPUT_WIDTH     = blysk_pkg::INPUT_WIDTH,
  parameter int OUTPUT_WIDTH    = blysk_pkg::OUTPUT_WIDTH,
  parameter int STATUS_WIDTH    = blysk_pkg::STATUS_WIDTH
) (
  input logic                     clk_i,
  input logic                     rst_i,
  input logic                     in_valid_i,
  input logic                     in_ready_o,
  input logic [ADDRESS_WIDTH-1:0] address_i,
  input logic [INPUT_WIDTH-1:0]   x_i,
  input logic                     out_valid_o,
  input logic                     out_ready_i,
  input logic [OUTPUT_WIDTH-1:0]  intensity_o,
  input logic [STATUS_WIDTH-1:0]  status_o
);

  integer scoreboard;
  logic   keep_going;

  initial begin
    keep_going = $test$plusargs("keep_going") != 0;
    scoreboard = $blysk_scoreboard(CONFIGURATION, address_i, x_i, intensity_o, status_o);
    if (scoreboard == 0) $fatal(1);
    else if (WATCH != "") if ($blysk_watch(scoreboard, WATCH) == 0) $fatal(1);
  end

  always @(posedge clk_i) begin
    if ($blysk_cycle(scoreboard, rst_i, in_valid_i, in_ready_o, address_i, x_i,
                     out_valid_o, out_ready_i, intensity_o, status_o) != 0)
      if (!keep_going) $fatal(1);
  end

endmodule

`default_nettype wire
