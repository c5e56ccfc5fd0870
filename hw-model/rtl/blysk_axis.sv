// The pipeline with the names of AXI4-Stream: requests on s_axis, results on m_axis.
//
//   s_axis_tdata   x in the lowest bytes, the address in those above; each begins with a byte, and the bits above it
//                  in its last byte are not looked at
//   m_axis_tdata   the intensity in the lowest bits; the bits above it are 0
//   m_axis_tuser   the status, bit for bit
//
// There is no tlast: every transfer is a request of its own, and the results come in the order of the requests. While
// aresetn is low no request is taken, and what is under way is lost. Whether it waits for the clock, the configuration
// says.
`timescale 1ns / 1ps
`default_nettype none

module blysk_axis #(
  parameter ROM_FILE = "rom.mem"
) (
  input  logic aclk,
  input  logic aresetn,
  // Request
  input  logic s_axis_tvalid,
  output logic s_axis_tready,
  input  logic [8*((blysk_pkg::INPUT_WIDTH+7)/8+(blysk_pkg::ADDRESS_WIDTH+7)/8)-1:0] s_axis_tdata,
  // Result
  output logic m_axis_tvalid,
  input  logic m_axis_tready,
  output logic [8*((blysk_pkg::OUTPUT_WIDTH+7)/8)-1:0] m_axis_tdata,
  output logic [blysk_pkg::STATUS_WIDTH-1:0] m_axis_tuser
);

  // ---- Of the configuration -----------------------------------------------------------------------
  localparam int ADDRESS_WIDTH = blysk_pkg::ADDRESS_WIDTH;
  localparam int INPUT_WIDTH   = blysk_pkg::INPUT_WIDTH;
  localparam int OUTPUT_WIDTH  = blysk_pkg::OUTPUT_WIDTH;
  localparam int RESULT_WIDTH  = 8 * ((OUTPUT_WIDTH + 7) / 8);
  // Where the address begins.
  localparam int ADDRESS_LSB   = 8 * ((INPUT_WIDTH + 7) / 8);

  logic [OUTPUT_WIDTH-1:0] intensity;

  blysk #(
    .ROM_FILE(ROM_FILE)
  ) pipeline (
    .clk_i(aclk), .rst_i(!aresetn),
    .in_valid_i(s_axis_tvalid), .in_ready_o(s_axis_tready),
    .address_i(s_axis_tdata[ADDRESS_LSB+:ADDRESS_WIDTH]), .x_i(s_axis_tdata[0+:INPUT_WIDTH]),
    .out_valid_o(m_axis_tvalid), .out_ready_i(m_axis_tready), .intensity_o(intensity), .status_o(m_axis_tuser)
  );

  assign m_axis_tdata = RESULT_WIDTH'(intensity);

  // Bits above address and x.
  logic unused;
  assign unused = &{1'b0, s_axis_tdata};

endmodule

`default_nettype wire
