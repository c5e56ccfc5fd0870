// A register slice of two entries: ready comes from a register, so that no path leads through it.
//
// What is taken in goes to the head, which the output shows. Where the head is full and nobody takes it, one more goes
// to the spare entry, and ready falls until the head has taken it over. So a value comes out in the cycle after the
// one in which it came in, one a cycle when nothing stalls, and none is lost. Twin of Slice in sim/src/slice.rs.
//
// Where there is no slice (STORED = 0), its ports are wires.
`timescale 1ns / 1ps
`default_nettype none

module blysk_ready_slice #(
  parameter int WIDTH              = 8,
  parameter int STORED             = 1,
  parameter int RESET_ASYNCHRONOUS = 0
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic             in_valid_i,
  output logic             in_ready_o,
  output logic             in_ready_d_o,   // in_ready_o as the next edge makes it, but for a reset
  input  logic [WIDTH-1:0] value_i,
  output logic             out_valid_o,
  input  logic             out_ready_i,
  output logic [WIDTH-1:0] value_o
);

  if (STORED != 0) begin : stored
    logic [1:0]       valid_d, valid_q;  // the head's, and above it the spare entry's
    logic [WIDTH-1:0] head_q, spare_q;
    logic             taken, moves, waits;

    assign taken   = in_valid_i && !valid_q[1];
    assign moves   = out_ready_i || !valid_q[0];
    assign waits   = valid_q[1] || taken;
    assign valid_d = {!moves && waits, !moves || waits};

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

    always_ff @(posedge clk_i) begin
      if (moves && waits)  head_q  <= valid_q[1] ? spare_q : value_i;
      if (!moves && taken) spare_q <= value_i;
    end

    assign in_ready_o   = !valid_q[1];
    assign in_ready_d_o = !valid_d[1];
    assign out_valid_o  = valid_q[0];
    assign value_o      = head_q;
  end else begin : wires
    assign in_ready_o   = out_ready_i;
    assign in_ready_d_o = 1'b0;
    assign out_valid_o  = in_valid_i;
    assign value_o      = value_i;
    logic unused;
    assign unused = &{1'b0, clk_i, rst_i};
  end

endmodule

`default_nettype wire
