// The ports of the pipeline as a UVM environment sees them.
`timescale 1ns / 1ps
`default_nettype none

interface blysk_if (
  input logic clk
);
  logic                                rst;
  logic                                in_valid, in_ready, out_valid, out_ready;
  logic [blysk_pkg::ADDRESS_WIDTH-1:0] address;
  logic [blysk_pkg::INPUT_WIDTH-1:0]   x;
  logic [blysk_pkg::OUTPUT_WIDTH-1:0]  intensity;
  logic [blysk_pkg::STATUS_WIDTH-1:0]  status;
endinterface

`default_nettype wire
