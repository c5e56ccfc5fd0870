// A UVM environment whose reference model is the golden model, by DPI-C.
//
//   sequence -> driver -> DUT -> monitor -> scoreboard (blysk_dpi_cycle: handshake, latency, results)
//
// An environment of your own takes blysk_reference and blysk_scoreboard, and a monitor that writes a blysk_cycle for
// every rising edge of the clock.
`timescale 1ns / 1ps

package blysk_uvm_pkg;

  import uvm_pkg::*;
  import blysk_dpi_pkg::*;
`include "uvm_macros.svh"

  // ---- Transactions -----------------------------------------------------------------------------------
  // A request, and how many cycles the driver waits before it.
  class blysk_request extends uvm_sequence_item;
    int unsigned     address;
    longint unsigned x;
    int unsigned     bubbles;

    `uvm_object_utils(blysk_request)

    function new(string name = "blysk_request");
      super.new(name);
    endfunction

    function string convert2string();
      return $sformatf("address %0d, x %0h, after %0d bubbles", address, x, bubbles);
    endfunction
  endclass

  // All ports at one rising edge. Levels are 0, 1, 2 for z and 3 for x.
  class blysk_cycle extends uvm_sequence_item;
    byte unsigned    reset, in_valid, in_ready, out_valid, out_ready;
    byte unsigned    request_known, result_known;
    int unsigned     address;
    longint unsigned x, intensity, status;

    `uvm_object_utils(blysk_cycle)

    function new(string name = "blysk_cycle");
      super.new(name);
    endfunction
  endclass

  // ---- Reference model --------------------------------------------------------------------------------
  // The golden model of a preset: the one that +configuration=NAME or uvm_config_db says, or compact.
  class blysk_reference extends uvm_component;
    chandle model;

    `uvm_component_utils(blysk_reference)

    function new(string name, uvm_component parent);
      super.new(name, parent);
    endfunction

    function void build_phase(uvm_phase phase);
      string configuration;
      super.build_phase(phase);
      if (!$value$plusargs("configuration=%s", configuration))
        if (!uvm_config_db#(string)::get(this, "", "configuration", configuration)) configuration = "compact";
      if (blysk_model_preset(ABI_VERSION, configuration, model) != CODE_OK) `uvm_fatal("BLYSK", blysk_last_error())
    endfunction

    // The words on intensity_o and status_o that answer a request, without a clock.
    function void answer(int unsigned address, longint unsigned x,
                         output longint unsigned intensity, output byte unsigned status);
      if (blysk_dpi_answer(model, address, x, intensity, status) != CODE_OK) `uvm_fatal("BLYSK", blysk_last_error())
    endfunction

    function void final_phase(uvm_phase phase);
      blysk_model_free(model);
    endfunction
  endclass

  // ---- Scoreboard -------------------------------------------------------------------------------------
  class blysk_scoreboard extends uvm_subscriber #(blysk_cycle);
    blysk_reference reference;
    chandle         scoreboard;

    `uvm_component_utils(blysk_scoreboard)

    function new(string name, uvm_component parent);
      super.new(name, parent);
    endfunction

    function void start_of_simulation_phase(uvm_phase phase);
      if (blysk_dpi_scoreboard_new(reference.model, blysk_pkg::ADDRESS_WIDTH, blysk_pkg::INPUT_WIDTH,
                                   blysk_pkg::OUTPUT_WIDTH, blysk_pkg::STATUS_WIDTH, scoreboard) != CODE_OK)
        `uvm_fatal("BLYSK", blysk_last_error())
    endfunction

    function void write(blysk_cycle t);
      if (blysk_dpi_cycle(scoreboard, t.reset, t.in_valid, t.in_ready, t.request_known, t.address, t.x,
                          t.out_valid, t.out_ready, t.result_known, t.intensity, t.status) != CODE_OK)
        `uvm_error("BLYSK", blysk_last_error())
    endfunction

    function void report_phase(uvm_phase phase);
      string verdict;
      verdict = blysk_dpi_verdict(scoreboard);
      $display("%0s", blysk_dpi_summary(scoreboard));
      $display("%0s", verdict);
      if (verdict.substr(0, 3) != "PASS") `uvm_error("BLYSK", "the DUT does not pass")
      blysk_scoreboard_free(scoreboard);
    endfunction
  endclass

  // ---- Agent ------------------------------------------------------------------------------------------
  // Requests with x near 1, where highlights are, and now and then anything.
  class blysk_sequence extends uvm_sequence #(blysk_request);
    int unsigned count = 2000;

    `uvm_object_utils(blysk_sequence)

    function new(string name = "blysk_sequence");
      super.new(name);
    endfunction

    task body();
      blysk_request    request;
      longint unsigned one;
      int unsigned     draw;
      one = 64'd1 << (blysk_pkg::INPUT_WIDTH - 1);
      for (int unsigned i = 0; i < count; i++) begin
        request = blysk_request::type_id::create("request");
        start_item(request);
        draw            = $urandom;
        request.address = $urandom & ((32'd1 << blysk_pkg::ADDRESS_WIDTH) - 1);
        request.x       = draw[1:0] == 0 ? 64'($urandom) & (2 * one - 1) : one - (64'($urandom) & (one - 1)) / 64;
        request.bubbles = draw[3:2] == 0 ? 32'(draw[6:4]) : 0;
        finish_item(request);
      end
    endtask
  endclass

  class blysk_driver extends uvm_driver #(blysk_request);
    virtual blysk_if ports;

    `uvm_component_utils(blysk_driver)

    function new(string name, uvm_component parent);
      super.new(name, parent);
    endfunction

    function void build_phase(uvm_phase phase);
      super.build_phase(phase);
      if (!uvm_config_db#(virtual blysk_if)::get(this, "", "ports", ports)) `uvm_fatal("BLYSK", "no ports were set")
    endfunction

    task run_phase(uvm_phase phase);
      ports.rst       <= 1'b1;
      ports.in_valid  <= 1'b0;
      ports.out_ready <= 1'b0;
      ports.address   <= '0;
      ports.x         <= '0;
      repeat (2) @(posedge ports.clk);
      ports.rst <= 1'b0;
      fork
        stall();
        drive();
      join
    endtask

    // Results are taken in three cycles of four.
    task stall();
      forever begin
        ports.out_ready <= $urandom % 4 != 0;
        @(posedge ports.clk);
      end
    endtask

    task drive();
      forever begin
        seq_item_port.get_next_item(req);
        repeat (req.bubbles) @(posedge ports.clk);
        ports.in_valid <= 1'b1;
        ports.address  <= req.address[blysk_pkg::ADDRESS_WIDTH-1:0];
        ports.x        <= req.x[blysk_pkg::INPUT_WIDTH-1:0];
        do @(posedge ports.clk); while (ports.in_ready !== 1'b1);
        ports.in_valid <= 1'b0;
        seq_item_port.item_done();
      end
    endtask
  endclass

  class blysk_monitor extends uvm_monitor;
    virtual blysk_if                 ports;
    uvm_analysis_port #(blysk_cycle) cycles;

    `uvm_component_utils(blysk_monitor)

    function new(string name, uvm_component parent);
      super.new(name, parent);
      cycles = new("cycles", this);
    endfunction

    function void build_phase(uvm_phase phase);
      super.build_phase(phase);
      if (!uvm_config_db#(virtual blysk_if)::get(this, "", "ports", ports)) `uvm_fatal("BLYSK", "no ports were set")
    endfunction

    task run_phase(uvm_phase phase);
      blysk_cycle cycle;
      forever begin
        @(posedge ports.clk);
        cycle               = blysk_cycle::type_id::create("cycle");
        cycle.reset         = level(ports.rst);
        cycle.in_valid      = level(ports.in_valid);
        cycle.in_ready      = level(ports.in_ready);
        cycle.request_known = 8'(^{ports.address, ports.x} !== 1'bx);
        cycle.address       = 32'(ports.address);
        cycle.x             = 64'(ports.x);
        cycle.out_valid     = level(ports.out_valid);
        cycle.out_ready     = level(ports.out_ready);
        cycle.result_known  = 8'(^{ports.intensity, ports.status} !== 1'bx);
        cycle.intensity     = 64'(ports.intensity);
        cycle.status        = 64'(ports.status);
        cycles.write(cycle);
      end
    endtask
  endclass

  // ---- Environment and test ---------------------------------------------------------------------------
  class blysk_env extends uvm_env;
    uvm_sequencer #(blysk_request) sequencer;
    blysk_driver                   driver;
    blysk_monitor                  monitor;
    blysk_reference                reference;
    blysk_scoreboard               scoreboard;

    `uvm_component_utils(blysk_env)

    function new(string name, uvm_component parent);
      super.new(name, parent);
    endfunction

    function void build_phase(uvm_phase phase);
      super.build_phase(phase);
      sequencer  = new("sequencer", this);
      driver     = blysk_driver::type_id::create("driver", this);
      monitor    = blysk_monitor::type_id::create("monitor", this);
      reference  = blysk_reference::type_id::create("reference", this);
      scoreboard = blysk_scoreboard::type_id::create("scoreboard", this);
    endfunction

    function void connect_phase(uvm_phase phase);
      driver.seq_item_port.connect(sequencer.seq_item_export);
      monitor.cycles.connect(scoreboard.analysis_export);
      scoreboard.reference = reference;
    endfunction
  endclass

  class blysk_test extends uvm_test;
    blysk_env env;

    `uvm_component_utils(blysk_test)

    function new(string name, uvm_component parent);
      super.new(name, parent);
    endfunction

    function void build_phase(uvm_phase phase);
      super.build_phase(phase);
      env = blysk_env::type_id::create("env", this);
    endfunction

    task run_phase(uvm_phase phase);
      blysk_sequence requests;
      phase.raise_objection(this);
      requests = blysk_sequence::type_id::create("requests");
      requests.start(env.sequencer);
      // What is still in flight comes out.
      repeat (8 * blysk_pkg::RANKS) @(posedge env.driver.ports.clk);
      phase.drop_objection(this);
    endtask
  endclass

endpackage
