// Judges the RTL of configuration "[[ configuration ]]" beside the golden model, ports and registers, cycle by cycle,
// and names the first register that departs. It is bound into every instance of the pipeline; its testbench stays as
// it is. blysk_checker.sv and blysk_dpi_pkg.sv, which come with the library libblysk, are needed beside it.
// Made by: [[ command ]]
`timescale 1ns / 1ps
`default_nettype none

module [[ name ]] (
  input logic                                clk_i,
  input logic                                [[ reset_port ]],
  input logic                                in_valid_i,
  input logic                                in_ready_o,
  input logic [blysk_pkg::ADDRESS_WIDTH-1:0] address_i,
  input logic [blysk_pkg::INPUT_WIDTH-1:0]   x_i,
  input logic                                out_valid_o,
  input logic                                out_ready_i,
  input logic [blysk_pkg::OUTPUT_WIDTH-1:0]  intensity_o,
  input logic [blysk_pkg::STATUS_WIDTH-1:0]  status_o
);

  // Every register, seen from here upwards: in the instance of the pipeline that this one is bound into.
  logic [64*[[ paths.len() ]]-1:0] registers;
<%- for path in paths %>
  assign registers[64*[[ loop.index0 ]]+:64] = 64'([[ dut ]].[[ path ]]);
<%- endfor %>

  blysk_judge #(
    .CONFIGURATION("[[ json ]]"),
    .REGISTERS([[ paths.len() ]]),
    .ADDRESS_WIDTH(blysk_pkg::ADDRESS_WIDTH), .INPUT_WIDTH(blysk_pkg::INPUT_WIDTH),
    .OUTPUT_WIDTH(blysk_pkg::OUTPUT_WIDTH), .STATUS_WIDTH(blysk_pkg::STATUS_WIDTH)
  ) judge (
    .clk_i, .rst_i[[ reset ]], .in_valid_i, .in_ready_o, .address_i, .x_i, .out_valid_o, .out_ready_i, .intensity_o, .status_o,
    .registers_i(registers)
  );

endmodule

bind [[ dut ]] [[ name ]] register_checker (.*);

`default_nettype wire
