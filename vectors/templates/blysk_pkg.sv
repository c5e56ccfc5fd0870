// Widths and constants of the configuration "[[ configuration ]]".
// Made by: [[ command ]]
`timescale 1ns / 1ps
`default_nettype none

// The modules' loops read the vectors; the single constants beside them are for people and testbenches.
// verilator lint_off UNUSEDPARAM
package blysk_pkg;
<%- for section in sections %>

  // ---- [[ section.title ]]
<%- for constant in section.constants %>
  localparam [[ constant.declaration ]] = [[ constant.value ]];[[ constant.comment ]]
<%- endfor %>
<%- endfor %>

endpackage
// verilator lint_on UNUSEDPARAM

`default_nettype wire
