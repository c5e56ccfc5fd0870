// The module under test of the mutant runs: the pipeline with its own ports, and, where it is a mutated
// netlist, the number of the mutation that is switched on.
`default_nettype none

module blysk_mutated (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  logic                                in_valid_i,
  output logic                                in_ready_o,
  input  logic [blysk_pkg::ADDRESS_WIDTH-1:0] address_i,
  input  logic [blysk_pkg::INPUT_WIDTH-1:0]   x_i,
  output logic                                out_valid_o,
  input  logic                                out_ready_i,
  output logic [blysk_pkg::OUTPUT_WIDTH-1:0]  intensity_o,
  output logic [blysk_pkg::STATUS_WIDTH-1:0]  status_o
);

`ifdef BLYSK_NETLIST
  logic [15:0] mutant;
  initial if (!$value$plusargs("mutant=%d", mutant)) mutant = '0;
`endif

  blysk pipeline (
`ifdef BLYSK_NETLIST
    .mutant(mutant),
`endif
    .clk_i(clk_i), .rst_i(rst_i),
    .in_valid_i(in_valid_i), .in_ready_o(in_ready_o), .address_i(address_i), .x_i(x_i),
    .out_valid_o(out_valid_o), .out_ready_i(out_ready_i),
    .intensity_o(intensity_o), .status_o(status_o)
  );

endmodule

`default_nettype wire
