// The emitted pipeline in the UVM environment of blysk_uvm_pkg.
`timescale 1ns / 1ps
`default_nettype none

module blysk_uvm_tb;

  import uvm_pkg::*;
  import blysk_uvm_pkg::*;

  logic clk = 1'b0;
  always #5 clk = !clk;

  blysk_if ports (.clk(clk));

  blysk dut (
    .clk_i(clk), .rst_i(ports.rst),
    .in_valid_i(ports.in_valid), .in_ready_o(ports.in_ready), .address_i(ports.address), .x_i(ports.x),
    .out_valid_o(ports.out_valid), .out_ready_i(ports.out_ready),
    .intensity_o(ports.intensity), .status_o(ports.status)
  );

  initial begin
    uvm_config_db#(virtual blysk_if)::set(null, "*", "ports", ports);
    run_test("blysk_test");
  end

endmodule

`default_nettype wire
