# Synthesises the pipeline on its own in Quartus. Made by: [[ command ]]
#
#   quartus_sh -t quartus.tcl [FAMILY DEVICE]
#
# This recipe has not been run in Quartus: its commands are those of its scripting manual, and a Tcl interpreter has
# gone through it.
load_package flow
set family [expr {[llength $quartus(args)] > 1 ? [lindex $quartus(args) 0] : "Cyclone V"}]
set device [expr {[llength $quartus(args)] > 1 ? [lindex $quartus(args) 1] : "5CEBA4F23C7"}]

project_new [[ top ]] -overwrite
set_global_assignment -name FAMILY $family
set_global_assignment -name DEVICE $device
set_global_assignment -name TOP_LEVEL_ENTITY [[ top ]]
foreach file {[[ files.join(" ") ]]} {
  set_global_assignment -name SYSTEMVERILOG_FILE $file
}
set_global_assignment -name SDC_FILE [[ constraints ]]
# The ports are those of a module inside a design.
set_instance_assignment -name VIRTUAL_PIN ON -to *
execute_flow -compile
project_close
