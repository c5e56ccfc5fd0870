// In place of blysk_rom: the request brings its own ROM word, so that what is proved holds for every
// content. The address port is as wide as a word, plus a bit that says that there is none.
`default_nettype none

module blysk_rom #(
  parameter ROM_FILE = ""
) (
  input  logic                                clk_i,
  input  logic [blysk_pkg::ROM_RANKS:0]       load_i,
  input  logic [blysk_pkg::ADDRESS_WIDTH-1:0] address_i,
  output logic                                no_word_o,
  output logic [blysk_pkg::FIELDS_WIDTH-1:0]  fields_o
);

  logic [blysk_pkg::ROM_WIDTH-1:0] word_q, word;
  logic                            no_word;

  always_ff @(posedge clk_i) begin
    if (load_i[0]) {no_word, word_q} <= address_i;
  end
  blysk_delay #(.WIDTH(blysk_pkg::ROM_WIDTH), .RANKS(1), .STORED(blysk_pkg::ROM_RANKS)) word_behind (
    .clk_i, .load_i(load_i[blysk_pkg::ROM_RANKS]), .value_i(word_q), .value_o(word));
  assign no_word_o = no_word;

  blysk_fields fields (.word_i(word), .fields_o);

endmodule

`default_nettype wire
