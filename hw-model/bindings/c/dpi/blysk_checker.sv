// Judges a DUT beside the golden model, cycle by cycle: handshake, latency, order, intensity and status, whatever
// drives the DUT. It drives nothing itself. It sees ports at the rising edge as they are before what the edge brings:
// so a testbench drives them by nonblocking assignments, or away from the edge.
//
//   blysk_checker #(.CONFIGURATION("compact")) checker_of_dut (.clk_i, .rst_i, .in_valid_i, .in_ready_o, ...);
//
// or from outside, without a change of the testbench:
//
//   bind blysk blysk_checker #(.CONFIGURATION("compact")) checker_of_dut (.*);
//
// A DUT whose reset is active low has the port rst_ni in place of rst_i: (.rst_i(!rst_ni), .*).
//
// CONFIGURATION is the name of a preset, the path of a file of JSON (anything that has ".json" in it), or the text of
// such a file (anything that begins with a brace).
//
// At the first cycle that differs it prints "FAIL cycle ..." with what the DUT shows, what was expected, the request,
// and what every register of that request should be, and ends the simulation by $fatal(1). At the end of the
// simulation it prints what was compared, and "PASS <count> results" or "FAIL ...": a run whose last line of these is
// not PASS has failed, whatever its exit status. With +keep_going it goes on after a difference, and says at the end
// how many cycles differ.
//
// This module sees ports alone. blysk_register_checker, which `blysk rtl --checker` writes beside the RTL of a
// configuration, sees every register too, and names the first one that departs.
`timescale 1ns / 1ps
`default_nettype none

module blysk_checker #(
  parameter CONFIGURATION     = "compact",
  parameter int ADDRESS_WIDTH = blysk_pkg::ADDRESS_WIDTH,
  parameter int INPUT_WIDTH   = blysk_pkg::INPUT_WIDTH,
  parameter int OUTPUT_WIDTH  = blysk_pkg::OUTPUT_WIDTH,
  parameter int STATUS_WIDTH  = blysk_pkg::STATUS_WIDTH
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

  blysk_judge #(
    .CONFIGURATION(CONFIGURATION), .ADDRESS_WIDTH(ADDRESS_WIDTH), .INPUT_WIDTH(INPUT_WIDTH),
    .OUTPUT_WIDTH(OUTPUT_WIDTH), .STATUS_WIDTH(STATUS_WIDTH)
  ) judge (
    .clk_i, .rst_i, .in_valid_i, .in_ready_o, .address_i, .x_i, .out_valid_o, .out_ready_i, .intensity_o, .status_o,
    .registers_i(64'd0)
  );

endmodule

// The same with registers, where REGISTERS is not 0: 64 bits for each, in the order of blysk_registers, the first
// lowest.
module blysk_judge #(
  parameter CONFIGURATION     = "compact",
  parameter int REGISTERS     = 0,
  parameter int ADDRESS_WIDTH = 1,
  parameter int INPUT_WIDTH   = 1,
  parameter int OUTPUT_WIDTH  = 1,
  parameter int STATUS_WIDTH  = 1
) (
  input logic                                            clk_i,
  input logic                                            rst_i,
  input logic                                            in_valid_i,
  input logic                                            in_ready_o,
  input logic [ADDRESS_WIDTH-1:0]                        address_i,
  input logic [INPUT_WIDTH-1:0]                          x_i,
  input logic                                            out_valid_o,
  input logic                                            out_ready_i,
  input logic [OUTPUT_WIDTH-1:0]                         intensity_o,
  input logic [STATUS_WIDTH-1:0]                         status_o,
  input logic [64*(REGISTERS == 0 ? 1 : REGISTERS)-1:0]  registers_i
);

  import blysk_dpi_pkg::*;

  // Registers go to the library sixteen at a time.
  localparam int PARTS = REGISTERS == 0 ? 1 : (REGISTERS + 15) / 16;
  logic [1024*PARTS-1:0] parts;
  assign parts = (1024*PARTS)'(registers_i);

  chandle model, scoreboard;
  bit     ready, keep_going, failed;

  // What stops a run: the DUT departs, or nothing can be judged.
  task automatic fail;
    $display("FAIL %0s", blysk_last_error());
    if (!keep_going || !ready) begin
      failed = 1'b1;
      $fatal(1);
    end
  endtask

  function automatic int make_model(input string text);
    bit is_file;
    is_file = 1'b0;
    for (int i = 0; i + 5 <= text.len(); i = i + 1) if (text.substr(i, i + 4) == ".json") is_file = 1'b1;
    if (text.substr(0, 0) == "{") make_model = blysk_model_from_json(ABI_VERSION, text, model);
    else if (is_file) make_model = blysk_model_from_file(ABI_VERSION, text, model);
    else make_model = blysk_model_preset(ABI_VERSION, text, model);
  endfunction

  initial begin
    keep_going = $test$plusargs("keep_going") != 0;
    ready      = 1'b0;
    failed     = 1'b0;
    if (make_model(CONFIGURATION) != CODE_OK) fail;
    else if (blysk_dpi_scoreboard_new(model, ADDRESS_WIDTH, INPUT_WIDTH, OUTPUT_WIDTH, STATUS_WIDTH, scoreboard)
             != CODE_OK) fail;
    ready = !failed;
  end

  always @(posedge clk_i) begin
    if (ready) begin
      if (REGISTERS != 0)
        for (int i = 0; i < PARTS; i = i + 1)
          if (blysk_dpi_registers(scoreboard, REGISTERS, 16 * i, parts[1024*i+:1024]) != CODE_OK) fail;
      if (blysk_dpi_cycle(scoreboard,
          level(rst_i), level(in_valid_i), level(in_ready_o),
          8'(^{address_i, x_i} !== 1'bx), 32'(address_i), 64'(x_i),
          level(out_valid_o), level(out_ready_i),
          8'(^{intensity_o, status_o} !== 1'bx), 64'(intensity_o), 64'(status_o)) != CODE_OK) fail;
    end
  end

  final begin
    if (ready && !failed) begin
      $display("%0s", blysk_dpi_summary(scoreboard));
      $display("%0s", blysk_dpi_verdict(scoreboard));
    end
    blysk_scoreboard_free(scoreboard);
    blysk_model_free(model);
  end

endmodule

`default_nettype wire
