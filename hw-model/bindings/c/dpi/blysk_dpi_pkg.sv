// The golden model of Blysk for SystemVerilog: functions of libblysk that DPI-C calls. include/blysk.h has the same
// functions with all that is to be said of them.
//
// A function that returns a code returns CODE_OK (0) when its work is done; after another code blysk_last_error() has
// the sentence. A chandle that is null is an error and no crash.
`timescale 1ns / 1ps
`default_nettype none

package blysk_dpi_pkg;

  // The ABI that these declarations are of; the library refuses another one.
  localparam int unsigned ABI_VERSION = 1;

  localparam int CODE_OK      = 0;
  localparam int CODE_DIFFERS = 10;

  import "DPI-C" function string blysk_version();
  import "DPI-C" function string blysk_last_error();

  // ---- Models: the configuration of a preset, or of a file of JSON ------------------------------------
  import "DPI-C" function int blysk_model_preset(input int unsigned abi, input string name, output chandle model);
  import "DPI-C" function int blysk_model_from_file(input int unsigned abi, input string path, output chandle model);
  import "DPI-C" function int blysk_model_from_json(input int unsigned abi, input string json, output chandle model);
  import "DPI-C" function void blysk_model_free(input chandle model);

  // In real numbers: the intensity for exponent n and x = cos(angle).
  import "DPI-C" function int blysk_highlight(input chandle model, input real n, input real x, output real intensity);
  // The ROM address of an exponent.
  import "DPI-C" function int blysk_address(input chandle model, input real n, output int unsigned address);
  // The words on intensity_o and status_o for those on address_i and x_i, without a clock.
  import "DPI-C" function int blysk_dpi_answer(
    input chandle model, input int unsigned address, input longint unsigned x,
    output longint unsigned intensity, output byte unsigned status
  );

  // ---- Pipelines: one call a clock cycle ------------------------------------------------------------------
  import "DPI-C" function int blysk_pipeline_new(input chandle model, output chandle pipeline);
  import "DPI-C" function void blysk_pipeline_free(input chandle pipeline);
  import "DPI-C" function int blysk_dpi_tick(
    input chandle pipeline,
    input byte unsigned reset, input byte unsigned in_valid, input int unsigned address, input longint unsigned x,
    input byte unsigned out_ready,
    output byte unsigned in_ready, output byte unsigned out_valid,
    output longint unsigned intensity, output byte unsigned status
  );

  // ---- Scoreboards: a DUT's ports, judged once a clock cycle -----------------------------------------------
  // With the widths of the DUT's ports, so that a DUT of another configuration is noticed.
  import "DPI-C" function int blysk_dpi_scoreboard_new(
    input chandle model, input int unsigned address_width, input int unsigned x_width,
    input int unsigned intensity_width, input int unsigned status_width, output chandle scoreboard
  );
  import "DPI-C" function void blysk_scoreboard_free(input chandle scoreboard);
  // Levels are 0, 1, 2 for z and 3 for x; request_known and result_known say whether these words are free of x and z.
  import "DPI-C" function int blysk_dpi_cycle(
    input chandle scoreboard,
    input byte unsigned reset, input byte unsigned in_valid, input byte unsigned in_ready,
    input byte unsigned request_known, input int unsigned address, input longint unsigned x,
    input byte unsigned out_valid, input byte unsigned out_ready,
    input byte unsigned result_known, input longint unsigned intensity, input longint unsigned status
  );
  // What the DUT's registers hold at the edge that the next blysk_dpi_cycle judges, of count in all the sixteen from
  // first on: 64 bits for each, in the order of blysk_registers, the first lowest.
  import "DPI-C" function int blysk_dpi_registers(
    input chandle scoreboard, input int unsigned count, input int unsigned first, input logic [1023:0] words
  );
  // What was seen so far, and the line that begins with PASS or FAIL.
  import "DPI-C" function string blysk_dpi_summary(input chandle scoreboard);
  import "DPI-C" function string blysk_dpi_verdict(input chandle scoreboard);

  // A level as blysk_dpi_cycle takes it.
  function automatic byte unsigned level(input logic value);
    level = value === 1'b1 ? 8'd1 : value === 1'b0 ? 8'd0 : 8'd3;
  endfunction

endpackage

`default_nettype wire
