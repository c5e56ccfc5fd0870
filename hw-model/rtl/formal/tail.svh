// The divider from end to end, under any stalls. Placed into blysk_tail, before its endmodule.
//
// Operands go along with each division, and so does the product of the quotient so far with the
// divisor, which grows by one bit's worth at a time. At every rank that product and the remainder
// must make up the part of the dividend that was taken in, with a remainder less than the divisor.
  localparam int X     = blysk_pkg::X_WIDTH;
  localparam int WHOLE = DIVISOR_WIDTH + DIGITS_WIDTH;
  // The last rank.
  localparam int LAST  = DIVIDED + DIGIT_STAGES;

  logic [LAST:0] has_result;
  filled #(.RANKS(LAST + 1)) ranks_filled (.clk_i, .load_i, .filled_o(has_result));

  logic [(LAST+2)*X-1:0] xs;
  trail #(.WIDTH(X), .RANKS(LAST + 1)) x_trail (
    .clk_i, .load_i, .value_i(x_i), .trail_o(xs));

  logic [(DIGIT_STAGES+1)*DIVISOR_WIDTH-1:0] divisors;
  trail #(.WIDTH(DIVISOR_WIDTH), .RANKS(DIGIT_STAGES)) divisor_trail (
    .clk_i, .load_i(load_i[LAST:DIVIDED+1]), .value_i(divisor[DIVISOR_WIDTH-1:0]), .trail_o(divisors));

  // Quotient so far times divisor, as it leaves each rank; and its quotient.
  logic [(DIGIT_STAGES+1)*WHOLE-1:0]      products;
  logic [(DIGIT_STAGES+1)*DIGITS_WIDTH-1:0] quotients;
  assign products[WHOLE-1:0]       = '0;
  assign quotients[DIGITS_WIDTH-1:0] = '0;

  for (genvar step = 0; step <= DIGIT_STAGES; step++) begin : at
    localparam int MOST = blysk_pkg::QUOTIENT_BITS_PER_STAGE;
    localparam int DONE = step * MOST < DIGITS_WIDTH ? step * MOST : DIGITS_WIDTH;
    localparam int LEFT = DIGITS_WIDTH - DONE;
    logic [X-1:0]            along_x;
    logic [DIVISOR_WIDTH-1:0] along_divisor, here_remainder;
    logic [DIGITS_WIDTH-1:0]   here_digits, quotient;
    logic [WHOLE-1:0]        dividend_here, product;
    assign along_x        = xs[(DIVIDED+step+1)*X+:X];
    assign along_divisor  = divisors[step*DIVISOR_WIDTH+:DIVISOR_WIDTH];
    assign here_remainder = remainder[step*DIVISOR_WIDTH+:DIVISOR_WIDTH];
    assign here_digits    = digits[step*DIGITS_WIDTH+:DIGITS_WIDTH];
    assign dividend_here  = WHOLE'(along_x) << blysk_pkg::DIVIDEND_UP;
    assign product        = products[step*WHOLE+:WHOLE];
    assign quotient       = quotients[step*DIGITS_WIDTH+:DIGITS_WIDTH];

    // The quotient fits its bits: the range analysis of the ROM says so, here it is assumed.
    if (step == 0) begin : fits
      always_comb if (has_result[DIVIDED]) assume (here_remainder < along_divisor);
    end else begin : grows
      localparam int BEFORE = (step - 1) * MOST;
      localparam int NEW    = DONE - BEFORE;
      // What the rank before had, as it was when this one loaded.
      logic [2*WHOLE-1:0]      product_before;
      logic [2*DIGITS_WIDTH-1:0] quotient_before;
      trail #(.WIDTH(WHOLE), .RANKS(1), .STORED(BEFORE)) product_trail (
        .clk_i, .load_i(load_i[DIVIDED+step]),
        .value_i(products[(step-1)*WHOLE+:WHOLE]), .trail_o(product_before));
      trail #(.WIDTH(DIGITS_WIDTH), .RANKS(1), .STORED(BEFORE)) quotient_trail (
        .clk_i, .load_i(load_i[DIVIDED+step]),
        .value_i(quotients[(step-1)*DIGITS_WIDTH+:DIGITS_WIDTH]), .trail_o(quotient_before));
      assign products[step*WHOLE+:WHOLE] =
          (product_before[WHOLE+:WHOLE] << NEW) + WHOLE'(here_digits[NEW-1:0]) * WHOLE'(along_divisor);
      assign quotients[step*DIGITS_WIDTH+:DIGITS_WIDTH] =
          (quotient_before[DIGITS_WIDTH+:DIGITS_WIDTH] << NEW) | DIGITS_WIDTH'(here_digits[NEW-1:0]);
    end

    always_comb begin
      if (has_result[DIVIDED+step]) begin
        assert (product + WHOLE'(here_remainder) == dividend_here >> LEFT);
        assert (here_remainder < along_divisor);
        assert (quotient >> DONE == '0);
        assert (here_digits == (DIGITS_WIDTH'(dividend_here << DONE) | quotient));
      end
    end
  end
