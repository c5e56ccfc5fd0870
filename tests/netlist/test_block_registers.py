#!/usr/bin/env python3
"""Which flip-flops scripts/block_registers.py moves into a block, and which it must leave."""

import copy
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))

from block_registers import absorb  # noqa: E402

CLOCK, ENABLE, OTHER_ENABLE = 2, 3, 4
MODES = {"CEMUX": "CE", "CLKMUX": "CLK", "LSRMUX": "LSR"}


def flip_flop(data, output, enable=ENABLE, reset="0"):
    pins = {"CLK": [CLOCK], "CE": [enable], "LSR": [reset], "DI": [data], "Q": [output]}
    directions = dict.fromkeys(pins, "input") | {"Q": "output"}
    return {"type": "TRELLIS_FF", "parameters": dict(MODES), "port_directions": directions, "connections": pins}


def block(kind, pins):
    directions = {pin: "output" for pin in pins}
    return {"type": kind, "parameters": {}, "port_directions": directions,
            "connections": {pin: [bit] for pin, bit in pins.items()}}


def module(kind, pins):
    """A block of two outputs, 10 and 11, each with a flip-flop behind it."""
    cells = {"block": block(kind, pins), "low": flip_flop(10, 20), "high": flip_flop(11, 21)}
    return {"ports": {"out": {"direction": "output", "bits": [20, 21]}}, "cells": cells}


def product():
    return module("MULT18X18D", {"P0": 10, "P1": 11})


class Absorb(unittest.TestCase):
    def test_a_product_goes_into_the_multiplier(self):
        netlist = product()
        self.assertEqual(absorb(netlist), 2)
        cell = netlist["cells"].pop("block")
        self.assertEqual(netlist["cells"], {})
        pins = {"P0": [20], "P1": [21], "CLK0": [CLOCK], "CE0": [ENABLE], "RST0": ["0"]}
        self.assertEqual(cell["connections"], pins)
        self.assertEqual(cell["parameters"]["REG_OUTPUT_CLK"], "CLK0")

    def test_a_word_goes_into_the_memory(self):
        netlist = module("DP16KD", {"DOA0": 10, "DOB0": 11})
        self.assertEqual(absorb(netlist), 2)
        cell = netlist["cells"]["block"]
        self.assertEqual(cell["connections"], {"DOA0": [20], "DOB0": [21], "OCEA": [ENABLE], "OCEB": [ENABLE]})
        self.assertEqual(cell["parameters"], {"REGMODE_A": "OUTREG", "REGMODE_B": "OUTREG"})

    def left(self, change):
        """`change` makes a netlist of which nothing may move, not a bit of it."""
        netlist = product()
        change(netlist)
        before = copy.deepcopy(netlist)
        self.assertEqual(absorb(netlist), 0)
        self.assertEqual(netlist, before)

    def test_a_bit_that_something_else_reads_stays(self):
        self.left(lambda netlist: netlist["cells"].update(other=flip_flop(10, 22)))

    def test_a_bit_that_is_an_output_of_the_module_stays(self):
        self.left(lambda netlist: netlist["ports"]["out"]["bits"].append(11))

    def test_two_enables_stay(self):
        self.left(lambda netlist: netlist["cells"].update(high=flip_flop(11, 21, enable=OTHER_ENABLE)))

    def test_a_reset_stays(self):
        resets = {"low": flip_flop(10, 20, reset=5), "high": flip_flop(11, 21, reset=5)}
        self.left(lambda netlist: netlist["cells"].update(resets))

    def test_an_inverted_clock_stays(self):
        behind = "low", "high"
        self.left(lambda netlist: [netlist["cells"][name]["parameters"].update(CLKMUX="INV") for name in behind])

    def test_a_block_whose_outputs_lead_nowhere_stays(self):
        self.left(lambda netlist: [netlist["cells"].pop(name) for name in ("low", "high")])

    def test_logic_behind_a_block_stays(self):
        self.left(lambda netlist: netlist["cells"]["low"].update(type="LUT4"))


if __name__ == "__main__":
    unittest.main()
