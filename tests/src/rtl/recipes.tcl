# Goes through the recipes of vendors in a Tcl interpreter (that of Yosys), in which a command of a vendor's is one that
# prints itself. Files that a command is given must be there.
set argc 1
set argv [list xc7k70tfbg676-2]
array set quartus {args {}}

proc there {files} {
  foreach file $files {
    if {![file exists $file]} { puts "missing $file"; exit 1 }
  }
}
foreach name {
  synth_design opt_design place_design route_design report_utilization report_timing_summary load_package project_new
  set_instance_assignment execute_flow project_close create_clock set_input_delay set_output_delay
} { proc $name args "puts \"$name \$args\"" }
proc read_verilog {option files} { there $files; puts "read_verilog [llength $files]" }
proc read_xdc {option mode file} { there $file; puts "read_xdc $file"; source $file }
proc get_ports pattern { return $pattern }
proc set_global_assignment {option name value} {
  if {[string match *_FILE $name]} { there $value }
  puts "$name $value"
}
source vivado.tcl
source quartus.tcl
puts "RECIPES END"
