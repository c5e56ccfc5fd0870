// The valid flags, and when each rank of registers loads. Twin of the rules in sim/src/pipeline/.
//
//   1. A transfer takes place at a rising edge where valid and ready are both high and reset is low.
//   2. A rank advances when it is empty or the rank after it advances; the last one when it is empty
//      or out_ready_i is high. So bubbles collapse, and a stall holds every bit.
//   3. out_valid_o depends on registers only, never on out_ready_i or in_valid_i.
//   4. Reset clears the valid flags, and what was in flight is lost. The pipeline's in_ready_o is low while it is high.
//   5. A rank's data registers are loaded when it advances and a request is offered to it; a bubble does
//      not change them. Reset does not gate that in ranks from 1 up; only their flags become 0.
//
// in_ready_o depends on out_ready_i through one gate: rule 2, written out, says that a rank advances
// when the output is taken or any rank from it on is empty.
//
// A pipeline inside another one may do with less than rule 2: HANDSHAKE_ENABLE has every rank advance where out_ready_i
// is high, and none where it is low, so that a bubble stays between its neighbours; HANDSHAKE_NONE has every rank
// advance in every cycle, and does not look at out_ready_i.
//
// Where a register slice behind the last rank tells its ready a cycle ahead (READY_AHEAD), what advances is worked out
// a cycle ahead too, and comes from registers.
`timescale 1ns / 1ps
`default_nettype none

module blysk_handshake #(
  parameter int RANKS              = 6,
  parameter int KIND               = blysk_pkg::HANDSHAKE_VALID_READY,
  parameter int READY_AHEAD        = 0,
  parameter int RESET_ASYNCHRONOUS = 0
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic             in_valid_i,
  output logic             in_ready_o,
  output logic             out_valid_o,
  input  logic             out_ready_i,
  input  logic             out_ready_d_i,
  output logic [RANKS-1:0] load_o
);

  logic [RANKS-1:0] valid_d, valid_q;
  logic [RANKS-1:0] offered, advance;

  if (KIND == blysk_pkg::HANDSHAKE_ENABLE) begin : enabled
    assign advance = {RANKS{out_ready_i}};
    logic unused;
    assign unused = &{1'b0, out_ready_d_i};
  end else if (KIND == blysk_pkg::HANDSHAKE_NONE) begin : always_on
    assign advance = '1;
    logic unused;
    assign unused = &{1'b0, out_ready_i, out_ready_d_i};
  end else if (READY_AHEAD != 0) begin : ahead
    logic [RANKS-1:0] advance_d, advance_q;
    genvar rank;
    for (rank = 0; rank < RANKS; rank = rank + 1) begin : ranks
      assign advance_d[rank] = out_ready_d_i || !(&valid_d[RANKS-1:rank]);
    end
    // After a reset all ranks are empty.
    if (RESET_ASYNCHRONOUS != 0) begin : asynchronous_advance
      always_ff @(posedge clk_i or posedge rst_i) begin
        if (rst_i) advance_q <= '1;
        else       advance_q <= advance_d;
      end
    end else begin : synchronous_advance
      always_ff @(posedge clk_i) begin
        if (rst_i) advance_q <= '1;
        else       advance_q <= advance_d;
      end
    end
    assign advance = advance_q;
    logic unused;
    assign unused = &{1'b0, out_ready_i};
  end else begin : at_once
    genvar rank;
    for (rank = 0; rank < RANKS; rank = rank + 1) begin : ranks
      assign advance[rank] = out_ready_i || !(&valid_q[RANKS-1:rank]);
    end
    logic unused;
    assign unused = &{1'b0, out_ready_d_i};
  end

  assign offered = {valid_q[RANKS-2:0], in_valid_i && !rst_i};
  assign load_o  = advance & offered;
  assign valid_d = (advance & offered) | (~advance & valid_q);

  if (RESET_ASYNCHRONOUS != 0) begin : asynchronous
    always_ff @(posedge clk_i or posedge rst_i) begin
      if (rst_i) valid_q <= '0;
      else       valid_q <= valid_d;
    end
  end else begin : synchronous
    always_ff @(posedge clk_i) begin
      if (rst_i) valid_q <= '0;
      else       valid_q <= valid_d;
    end
  end

  assign in_ready_o  = advance[0];
  assign out_valid_o = valid_q[RANKS-1];

endmodule

`default_nettype wire
