// The pipeline behind three pins, to place and route it: it has more ports than small packages have
// pins. A shift register feeds every input, and every output is folded into another one, so that each
// path of the pipeline lies between registers and counts for the clock frequency. Not part of the
// pipeline, and not counted as such.
`default_nettype none

module blysk_pins (
  input  logic clk_i,
  input  logic data_i,
  output logic data_o
);

  localparam int IN_WIDTH  = 3 + blysk_pkg::ADDRESS_WIDTH + blysk_pkg::INPUT_WIDTH;
  localparam int OUT_WIDTH = 2 + blysk_pkg::OUTPUT_WIDTH + blysk_pkg::STATUS_WIDTH;

  logic [IN_WIDTH-1:0]  in_q;
  logic [OUT_WIDTH-1:0] out, out_q;

  blysk core (
    .clk_i,
    .rst_i(in_q[0]), .in_valid_i(in_q[1]), .out_ready_i(in_q[2]),
    .address_i(in_q[3+:blysk_pkg::ADDRESS_WIDTH]),
    .x_i(in_q[3+blysk_pkg::ADDRESS_WIDTH+:blysk_pkg::INPUT_WIDTH]),
    .in_ready_o(out[0]), .out_valid_o(out[1]),
    .intensity_o(out[2+:blysk_pkg::OUTPUT_WIDTH]),
    .status_o(out[2+blysk_pkg::OUTPUT_WIDTH+:blysk_pkg::STATUS_WIDTH])
  );

  always_ff @(posedge clk_i) begin
    in_q  <= {in_q[IN_WIDTH-2:0], data_i};
    out_q <= {out_q[OUT_WIDTH-2:0], 1'b0} ^ out;
  end
  assign data_o = out_q[OUT_WIDTH-1];

endmodule

`default_nettype wire
