// One of the two pipelines of `both_tb`: it answers its own vectors, one a cycle. {{p}} is its prefix.
  localparam int {{p}}_VECTORS = {{vectors}};
  logic [{{p}}_pkg::ADDRESS_WIDTH+{{p}}_pkg::INPUT_WIDTH-1:0] {{p}}_stimulus[0:{{p}}_VECTORS-1];
  logic [{{p}}_pkg::STATUS_WIDTH+{{p}}_pkg::OUTPUT_WIDTH-1:0] {{p}}_expected[0:{{p}}_VECTORS-1];
  logic [{{p}}_pkg::ADDRESS_WIDTH+{{p}}_pkg::INPUT_WIDTH-1:0] {{p}}_request;
  logic [{{p}}_pkg::STATUS_WIDTH+{{p}}_pkg::OUTPUT_WIDTH-1:0] {{p}}_answer;
  logic   {{p}}_in_ready, {{p}}_out_valid;
  integer {{p}}_asked = 0;
  integer {{p}}_answered = 0;
  initial begin
    $readmemh("{{p}}_stimulus.mem", {{p}}_stimulus);
    $readmemh("{{p}}_expected.mem", {{p}}_expected);
  end
  assign {{p}}_request = {{p}}_stimulus[{{p}}_asked < {{p}}_VECTORS ? {{p}}_asked : 0];

  {{p}} {{p}}_dut (
    .clk_i(clk), .rst_i(rst),
    .in_valid_i({{p}}_asked < {{p}}_VECTORS), .in_ready_o({{p}}_in_ready),
    .address_i({{p}}_request[{{p}}_pkg::INPUT_WIDTH+:{{p}}_pkg::ADDRESS_WIDTH]),
    .x_i({{p}}_request[0+:{{p}}_pkg::INPUT_WIDTH]),
    .out_valid_o({{p}}_out_valid), .out_ready_i(1'b1),
    .intensity_o({{p}}_answer[0+:{{p}}_pkg::OUTPUT_WIDTH]),
    .status_o({{p}}_answer[{{p}}_pkg::OUTPUT_WIDTH+:{{p}}_pkg::STATUS_WIDTH])
  );

  always @(posedge clk) if (!rst) begin
    if ({{p}}_asked < {{p}}_VECTORS && {{p}}_in_ready) {{p}}_asked <= {{p}}_asked + 1;
    if ({{p}}_out_valid) begin
      if ({{p}}_answer !== {{p}}_expected[{{p}}_answered]) begin
        $display("FAIL {{p}}: vector %0d is %h, expected %h", {{p}}_answered, {{p}}_answer,
                 {{p}}_expected[{{p}}_answered]);
        $finish;
      end
      {{p}}_answered <= {{p}}_answered + 1;
    end
  end
