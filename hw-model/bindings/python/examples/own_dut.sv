// A design of one's own: a pipeline with other names of its ports, and a register behind its result.
`timescale 1ns / 1ps
`default_nettype none

module specular (
  input  logic                                clk,
  input  logic                                rst,
  input  logic                                s_valid,
  output logic                                s_ready,
  input  logic [blysk_pkg::ADDRESS_WIDTH-1:0] s_material,
  input  logic [blysk_pkg::INPUT_WIDTH-1:0]   s_cosine,
  output logic                                m_valid,
  input  logic                                m_ready,
  output logic [blysk_pkg::OUTPUT_WIDTH-1:0]  m_intensity,
  output logic [blysk_pkg::STATUS_WIDTH-1:0]  m_status
);

  logic                               valid, ready;
  logic [blysk_pkg::OUTPUT_WIDTH-1:0] intensity;
  logic [blysk_pkg::STATUS_WIDTH-1:0] status;

  blysk shading (
    .clk_i(clk),
    .rst_i(rst),
    .in_valid_i(s_valid),
    .in_ready_o(s_ready),
    .address_i(s_material),
    .x_i(s_cosine),
    .out_valid_o(valid),
    .out_ready_i(ready),
    .intensity_o(intensity),
    .status_o(status)
  );

  assign ready = !m_valid || m_ready;

  always_ff @(posedge clk) begin
    if (rst) begin
      m_valid <= 1'b0;
    end else if (ready) begin
      m_valid <= valid;
    end
    if (ready && valid) begin
      m_intensity <= intensity;
      m_status    <= status;
    end
  end

endmodule

`default_nettype wire
