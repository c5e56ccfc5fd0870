// One rank of the divider against integer division, for every divisor, and every remainder below it.
`default_nettype none

module digits_proof #(
  parameter int COUNT = 1,
  parameter int LAST  = 0
) (
  input logic                                clk_i,
  input logic                                load_i,
  input logic [blysk_pkg::DIVISOR_WIDTH-1:0] divisor_i,
  input logic [blysk_pkg::DIVISOR_WIDTH-1:0] remainder_i,
  input logic [blysk_pkg::DIGITS_WIDTH-1:0]  digits_i
);

  localparam int DIVISOR_BITS = blysk_pkg::DIVISOR_WIDTH;
  localparam int DIGIT_BITS   = blysk_pkg::DIGITS_WIDTH;
  localparam int WIDE         = DIVISOR_BITS + COUNT + 1;

  logic [DIVISOR_BITS-1:0] divisor, remainder, was_divisor, was_remainder;
  logic [DIGIT_BITS-1:0]   digits, was_digits;
  logic                    loaded;
  initial loaded = 1'b0;

  blysk_tail_digits #(.COUNT(COUNT), .LAST(LAST)) step (
    .clk_i, .load_i, .divisor_i, .remainder_i, .digits_i,
    .divisor_o(divisor), .remainder_o(remainder), .digits_o(digits)
  );

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      loaded        <= 1'b1;
      was_divisor   <= divisor_i;
      was_remainder <= remainder_i;
      was_digits    <= digits_i;
    end
  end

  // The dividend of this step, and the quotient that came of it.
  logic [WIDE-1:0]  dividend;
  logic [COUNT-1:0] quotient;
  assign dividend = WIDE'({was_remainder, was_digits[DIGIT_BITS-1-:COUNT]});
  assign quotient = digits[COUNT-1:0];

  always_comb begin
    if (load_i) assume (remainder_i < divisor_i);
    if (loaded) begin
      less_than_divisor: assert (remainder < was_divisor);
      integer_division:  assert (WIDE'(quotient) * WIDE'(was_divisor) + WIDE'(remainder) == dividend);
      others_move_up:    assert (digits >> COUNT == DIGIT_BITS'(was_digits << COUNT) >> COUNT);
      divisor_kept:      assert (divisor == (LAST != 0 ? '0 : was_divisor));
    end
  end

endmodule

`default_nettype wire
