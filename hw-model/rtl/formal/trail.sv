// A value at every rank it passes, side by side: value_i itself first.
//
// Its registers have no initial value, as those of blysk_delay: so Yosys merges the two where they
// hold the same, and no invariant has to say that they do. A constant (STORED = 0) has no registers.
`default_nettype none

module trail #(
  parameter int WIDTH  = 1,
  parameter int RANKS  = 1,
  parameter int STORED = 1
) (
  input  logic                       clk_i,
  input  logic [RANKS-1:0]           load_i,
  input  logic [WIDTH-1:0]           value_i,
  output logic [(RANKS+1)*WIDTH-1:0] trail_o
);

  logic [RANKS*WIDTH-1:0] values;
  assign trail_o = {values, value_i};

  for (genvar rank = 0; rank < RANKS; rank++) begin : register
    if (STORED != 0) begin : carried
      always_ff @(posedge clk_i) begin
        if (load_i[rank]) values[rank*WIDTH+:WIDTH] <= trail_o[rank*WIDTH+:WIDTH];
      end
    end else begin : constant
      assign values[rank*WIDTH+:WIDTH] = value_i;
    end
  end

endmodule

// Which ranks something has come to, through all the ranks before, since the start: the first is bit 0.
module filled #(
  parameter int RANKS = 1
) (
  input  logic             clk_i,
  input  logic [RANKS-1:0] load_i,
  output logic [RANKS-1:0] filled_o
);

  logic [RANKS-1:0] values;
  initial values = '0;
  assign filled_o = values;
  always_ff @(posedge clk_i) values <= (load_i & {values, 1'b1}) | (~load_i & values);

endmodule

`default_nettype wire
