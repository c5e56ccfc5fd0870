// The blocks of an ECP5 as far as a netlist of Blysk uses them; tests/netlist/simulate.py puts them in.

// A block RAM that is only read. The contents stand in steps of 20 bits, 18 of which count.
module blysk_test_memory #(
    parameter WIDTH = 36,
    parameter REGISTERED = 0,
    parameter [20479:0] CONTENTS = 0
) (
    input  wire        clk,
    input  wire        enable,
    input  wire        output_enable,
    input  wire [13:0] address,
    output wire [35:0] data
);

  reg [35:0] read;
  reg [35:0] behind;
  assign data = REGISTERED ? behind : read;

  always @(posedge clk) begin
    if (enable && WIDTH == 36)
      read <= {CONTENTS[20 * (2 * address[13:5] + 1) +: 18], CONTENTS[20 * (2 * address[13:5]) +: 18]};
    if (enable && WIDTH == 18) read <= {18'bx, CONTENTS[20 * address[13:4] +: 18]};
    if (output_enable) behind <= read;
  end

endmodule

module blysk_test_multiplier #(
    parameter REGISTERED = 0
) (
    input  wire        clk,
    input  wire        enable,
    input  wire        signed_a,
    input  wire        signed_b,
    input  wire [17:0] a,
    input  wire [17:0] b,
    output wire [35:0] product
);

  wire signed [18:0] wide_a = {signed_a & a[17], a};
  wire signed [18:0] wide_b = {signed_b & b[17], b};
  wire signed [37:0] now = wide_a * wide_b;
  reg  [35:0] behind;
  assign product = REGISTERED ? behind : now[35:0];

  always @(posedge clk) if (enable) behind <= now[35:0];

endmodule
