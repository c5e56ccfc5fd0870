  function automatic real value(input logic [63:0] bits, input integer width, input integer is_signed,
                                input integer fraction);
    logic [62:0] magnitude;
    magnitude = bits[62:0];
    if (is_signed != 0 && bits[width-1]) magnitude = 63'((~bits + 64'd1) & ((64'd1 << width) - 64'd1));
    value = $itor(magnitude[61:31]) * 2147483648.0 + $itor(magnitude[30:0])
        + (magnitude[62] ? 4611686018427387904.0 : 0.0);
    if (is_signed != 0 && bits[width-1]) value = -value;
    value = value / (2.0 ** fraction);
  endfunction
