// Widths and constants of the configuration "[[ configuration ]]".
// Made by: [[ command ]]
`timescale 1ns / 1ps
`default_nettype none

package blysk_pkg;
<%- for section in sections %>

  // ---- [[ section.title ]]
<%- for constant in section.constants %>
  localparam [[ constant.declaration ]] = [[ constant.value ]];[[ constant.comment ]]
<%- endfor %>
<%- endfor %>

endpackage

`default_nettype wire
