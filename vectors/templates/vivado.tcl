# Synthesises the pipeline on its own in Vivado. Made by: [[ command ]]
#
#   vivado -mode batch -source vivado.tcl -tclargs [PART]
#
# This recipe has not been run in Vivado: its commands are those of UG835, and a Tcl interpreter has gone through it.
set part [expr {$argc > 0 ? [lindex $argv 0] : "xc7a35tcpg236-1"}]

read_verilog -sv {[[ files.join(" ") ]]}
read_xdc -mode out_of_context [[ constraints ]]
synth_design -top [[ top ]] -part $part -mode out_of_context
opt_design
place_design
route_design
report_utilization -file vivado_utilization.rpt
report_timing_summary -file vivado_timing.rpt
