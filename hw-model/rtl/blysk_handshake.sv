// The valid flags, and when each rank of registers loads. Twin of the rules in sim/src/pipeline.rs.
//
//   1. A transfer takes place at a rising edge where valid and ready are both high and reset is low.
//   2. A rank advances when it is empty or the rank after it advances; the last one when it is empty
//      or out_ready_i is high. So bubbles collapse, and a stall holds every bit.
//   3. out_valid_o depends on registers only, never on out_ready_i or in_valid_i.
//   4. Reset is synchronous and clears the valid flags; in_ready_o is low while it is high. What was
//      in flight is lost.
//   5. A rank's data registers are loaded when it advances and a request is offered to it; a bubble does
//      not change them. Reset does not gate that in ranks from 1 up; only their flags become 0.
//
// in_ready_o depends on out_ready_i through one gate: rule 2, written out, says that a rank advances
// when the output is taken or any rank from it on is empty.
`timescale 1ns / 1ps
`default_nettype none

module blysk_handshake #(
  parameter int RANKS = 6
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic             in_valid_i,
  output logic             in_ready_o,
  output logic             out_valid_o,
  input  logic             out_ready_i,
  output logic [RANKS-1:0] load_o
);

  logic [RANKS-1:0] valid_d, valid_q;
  logic [RANKS-1:0] offered, advance;

  genvar rank;
  generate
    for (rank = 0; rank < RANKS; rank = rank + 1) begin : ranks
      assign advance[rank] = out_ready_i || !(&valid_q[RANKS-1:rank]);
    end
  endgenerate

  assign offered = {valid_q[RANKS-2:0], in_valid_i && !rst_i};
  assign load_o  = advance & offered;
  assign valid_d = (advance & offered) | (~advance & valid_q);

  always_ff @(posedge clk_i) begin
    if (rst_i) valid_q <= '0;
    else       valid_q <= valid_d;
  end

  assign in_ready_o  = advance[0] && !rst_i;
  assign out_valid_o = valid_q[RANKS-1];

endmodule

`default_nettype wire
