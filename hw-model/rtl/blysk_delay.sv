// Carries a value along: one register for each rank it passes, loaded with that rank.
//
// A value that is a constant of the hardware (STORED = 0) needs no register and passes through.
`timescale 1ns / 1ps
`default_nettype none

module blysk_delay #(
  parameter int WIDTH  = 8,
  parameter int RANKS  = 1,
  parameter int STORED = 1
) (
  input  logic             clk_i,
  input  logic [RANKS-1:0] load_i,
  input  logic [WIDTH-1:0] value_i,
  output logic [WIDTH-1:0] value_o
);

  if (STORED != 0) begin : carried
    // The value before each rank, and after the last, side by side.
    logic [(RANKS+1)*WIDTH-1:0] chain;
    assign chain[WIDTH-1:0] = value_i;
    genvar rank;
    for (rank = 0; rank < RANKS; rank = rank + 1) begin : register
      logic [WIDTH-1:0] value_q;
      always_ff @(posedge clk_i) begin
        if (load_i[rank]) value_q <= chain[rank*WIDTH+:WIDTH];
      end
      assign chain[(rank+1)*WIDTH+:WIDTH] = value_q;
    end
    assign value_o = chain[RANKS*WIDTH+:WIDTH];
  end else begin : constant
    assign value_o = value_i;
    logic unused;
    assign unused = &{1'b0, clk_i, load_i};
  end

endmodule

`default_nettype wire
