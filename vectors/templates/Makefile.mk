# Runs the testbench of configuration [[ sources.design.config().name ]] in Icarus Verilog or Verilator.
# Made by: [[ sources.command ]]
#
#   make icarus | verilator     run every vector; the verdict is a line that begins with PASS or FAIL
#   make control                a corrupted vector must FAIL, at that vector
#   make lint                   both tools, all warnings, of the RTL and of the testbench
#   make waves                  run in Icarus and dump waves.vcd; gtkwave waves.gtkw shows it
#   make verilog2005            all modules in one file of Verilog-2005, [[ sources.modules.dut() ]]_2005.v, by Yosys
#   make gates LIBERTY=FILE     area in the cells of a library, by Yosys, and in NAND2 gates; the ROM is left out,
#                               and with ROM=gates it is made of gates too
#   make clean
#
# Options of the testbench go into ARGUMENTS: make icarus ARGUMENTS="+seed=7 +log=dut.csv".

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.PHONY: icarus verilator control lint waves verilog2005 gates clean always

TOP       = [[ sources.modules.dut() ]]
RTL       = [[ rtl.join(" ") ]]
<%- if !sources.modules.is_own() %>
# The sources of [[ sources.modules.dut() ]].
DUT      ?=
RTL      += $(DUT)
<%- endif %>
VERILATOR ?= verilator
IVERILOG  ?= iverilog
VVP       ?= vvp
YOSYS     ?= yosys
LIBERTY   ?=
# What the library calls a NAND gate of two inputs.
NAND2     ?= NAND2X1
ROM       ?= left out
ARGUMENTS ?=
BUILD     ?= build

# What a simulator prints, and its verdict as exit status, whatever the simulator says of its own.
JUDGE = tee $(BUILD)/log && ! grep -q '^FAIL' $(BUILD)/log && grep -q '^PASS [[ sources.vectors ]] vectors' $(BUILD)/log

icarus: $(BUILD)/blysk.vvp
	@$(VVP) -n $(BUILD)/blysk.vvp $(ARGUMENTS) | $(JUDGE)

# Verilator knows no x: what a file leaves open would be a 0, so the files are searched first. Registers
# begin with anything.
verilator: $(BUILD)/verilated/blysk_tb
	@if grep -niE '^[^/]*[xz]' *.mem /dev/null; then echo "FAIL a vector file has an x or z in it"; exit 1; fi
	@$(BUILD)/verilated/blysk_tb +verilator+rand+reset+2 +verilator+seed+1 $(ARGUMENTS) | grep -v '^- ' | $(JUDGE)

control: $(BUILD)/blysk.vvp
	@$(VVP) -n $(BUILD)/blysk.vvp +expected=negative_control.mem | tee $(BUILD)/log
	@grep -q '^FAIL vector [[ sources.control ]]: .*[[ sources.control_shows() ]] is ' $(BUILD)/log && ! grep -q '^PASS' $(BUILD)/log

# What a build is made of, by contents: DUT may name another file, or another tool be asked for, and a
# file's time need not show it.
$(BUILD)/%.sources: always
<%- if !sources.modules.is_own() %>
	@test -n "$(strip $(DUT))" || { echo "say where [[ sources.modules.dut() ]] is: make DUT=FILE ..." >&2; exit 1; }
<%- endif %>
	@mkdir -p $(BUILD)
	@{ echo "$(IVERILOG) $(VERILATOR)"; cksum $(RTL) blysk_tb.sv; } > $@.new
	@cmp -s $@.new $@ || cp $@.new $@
	@rm $@.new

$(BUILD)/blysk.vvp: $(BUILD)/icarus.sources
	$(IVERILOG) -g2012 -Wall -Wno-timescale -s blysk_tb -o $@ $(RTL) blysk_tb.sv

# Some builds of Verilator leave open how their compiler takes a precompiled header.
$(BUILD)/verilated/blysk_tb: $(BUILD)/verilator.sources
	$(VERILATOR) --binary --timing --trace -CFLAGS "-fcoroutines -O1" -O3 --x-initial unique --x-assign unique -Wno-fatal -Wno-WIDTH -Wno-TIMESCALEMOD -j 2 \
	  -MAKEFLAGS CFG_CXXFLAGS_PCH_I=-include \
	  --top-module blysk_tb --Mdir $(BUILD)/verilated -o blysk_tb $(RTL) blysk_tb.sv > $(BUILD)/verilator.log \
	  || { cat $(BUILD)/verilator.log; exit 1; }

lint:
	$(IVERILOG) -g2012 -Wall -s $(TOP) -o /dev/null $(RTL)
	$(VERILATOR) --lint-only -Wall --top-module $(TOP) $(RTL)
	$(IVERILOG) -g2012 -Wall -s blysk_tb -o /dev/null $(RTL) blysk_tb.sv
	$(VERILATOR) --lint-only -Wall --timing --top-module blysk_tb $(RTL) blysk_tb.sv

waves: $(BUILD)/blysk.vvp
	@$(VVP) -n $(BUILD)/blysk.vvp +waves=waves.vcd $(ARGUMENTS) | $(JUDGE)

verilog2005: $(BUILD)/yosys.sources
	$(YOSYS) -q -p "read_verilog -sv $(RTL); hierarchy -check -top $(TOP); proc; flatten; opt_clean; \
	  write_verilog -noattr $(TOP)_2005.v"

gates: $(BUILD)/yosys.sources
	@test -f "$(LIBERTY)" || { echo "say where the cells are: make gates LIBERTY=FILE" >&2; exit 1; }
	$(YOSYS) -l $(BUILD)/gates.log -q -p "read_verilog -sv $(RTL); $(if $(filter gates,$(ROM)),,blackbox blysk_rom;) \
	  synth -flatten -top $(TOP); dfflibmap -liberty $(LIBERTY); abc -liberty $(LIBERTY); opt_clean; \
	  tee -o $(BUILD)/gates.txt stat -liberty $(LIBERTY)"
	@awk -v cell='$(NAND2)' ' \
	  FILENAME == ARGV[1] { if ($$0 ~ "cell *[(] *\"?" cell "\"? *[)]") inside = 1; \
	    if (inside && !nand && /area *:/) { gsub(/[^0-9.]/, ""); nand = $$0 } next } \
	  /Chip area/ { area = $$NF } \
	  END { if (nand <= 0 || area <= 0) { print "no area, or no cell " cell " in the library"; exit 1 } \
	    printf "area %.0f, %.0f NAND2 equivalents (ROM: $(ROM))\n", area, area / nand }' $(LIBERTY) $(BUILD)/gates.txt

clean:
	rm -rf $(BUILD) waves.vcd $(TOP)_2005.v
