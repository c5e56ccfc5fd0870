// The fields of a ROM word, and those that are constants, by the layout in the package.
`default_nettype none

module blysk_fields (
  input  logic [blysk_pkg::ROM_WIDTH-1:0]    word_i,
  output logic [blysk_pkg::FIELDS_WIDTH-1:0] fields_o
);

  for (genvar i = 0; i < blysk_pkg::FIELDS; i++) begin : field
    localparam int WIDTH = blysk_pkg::FIELD_WIDTH[32*i+:32];
    localparam int PLACE = blysk_pkg::FIELD_PLACE[32*i+:32];
    localparam int LSB   = blysk_pkg::FIELD_LSB[32*i+:32];
    assign fields_o[PLACE+:WIDTH] = blysk_pkg::FIELD_STORED[32*i]
        ? WIDTH'(word_i >> LSB) : blysk_pkg::FIELD_CONSTANT[PLACE+:WIDTH];
  end

endmodule

`default_nettype wire
