# The clock of the pipeline, [[ mhz ]] MHz. Made by: [[ command ]]
#
# For Vivado, Quartus and other tools that read SDC. Inputs come from registers of the same clock and outputs go to
# such; half of the period is theirs.
create_clock -name clk -period [[ period ]] [get_ports clk_i]
set_input_delay -clock clk [[ half ]] [get_ports {rst_i in_valid_i address_i* x_i* out_ready_i}]
set_output_delay -clock clk [[ half ]] [get_ports {in_ready_o out_valid_o intensity_o* status_o*}]
