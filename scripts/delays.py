#!/usr/bin/env python3
"""Fits the delays of hw-model/src/clock/ to placements: what the parts of a pipeline take on each device.

Each configuration is synthesised, placed and routed as `make synth` does, one seed. nextpnr says when each register
gets its value; `blysk clock` says what parts lie before it; the delays are those with which the second comes nearest to
the first. Short paths count less, as the longest one is the clock.

    scripts/delays.py                 every configuration of `make synth`, and the tables written
    scripts/delays.py --show          the tables as they are: estimates beside placed clocks, into docs/SYNTHESIS.md
    scripts/delays.py --check         whether those there are up to date, and within 15 % of the placed ones
"""

import argparse
import csv
import io
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import synth

ROOT = Path(__file__).resolve().parent.parent
TABLES = {"ECP5 25F": ROOT / "hw-model/src/clock/ecp5.json", "iCE40 UP5K": ROOT / "hw-model/src/clock/up5k.json"}
BITS = {"ECP5 25F": 18, "iCE40 UP5K": 16}
NAMES = ["register", "rom", "lut", "add", "carry", "multiply", "enable"]
# Of a device whose blocks have registers at their outputs, too (scripts/block_registers.py).
TO_REGISTER = {"ECP5 25F": ["multiply_to_register"]}
# From the memory to the register that it has itself there is nothing that a placement could change.
FIXED = {"ECP5 25F": {"rom_to_register": 0.0}}
MARKERS = "<!-- estimates: made by `scripts/delays.py --show` -->", "<!-- end of estimates -->"
# An estimate that is farther off is none.
MOST = 0.15
# How many paths the clock of a configuration counts for.
CLOCK = 10.0
# The last part of a path in `blysk clock`, and the registers in which it ends, as Yosys calls them.
ENDS = [
    (r"^the ROM's memory$", r"rom\.word_behind|fields_i|word_i|least_x"),
    (r"comparisons of x$", r"region|beyond|distance|at_choice"),
    (r"gate of v$", r"variable\.v_q"),
    (r"multiplier of stage (\d)$", r"stage\[{0}\]\.multiply_add\.(product|pieces)"),
    (r"sum of the pieces of stage (\d)$", r"stage\[{0}\]\.multiply_add\.product_register"),
    (r"sum of stage (\d)$", r"stage\[{0}\]\.multiply_add\.(sum_register|round_sum)"),
    (r"rounding of stage (\d)$", r"stage\[{0}\]\.multiply_add\.t_q|stage\[{1}\]\.multiplicand"),
    (r"multiplier of the divisor$", r"divisor_stage\.(product|pieces)"),
    (r"sum of the pieces of the divisor$", r"divisor_stage\.product_register"),
    (r"sum of the divisor$", r"divisor_stage\.(sum_register|round_sum)"),
    (r"quotient bits$", r"quotient_bits|digit_stage"),
    (r"^clamp$", r"output_slice|clamp\.(intensity|status)"),
    (r"ahead$", r"handshake\.advance|in_ready_o"),
    (r"enables", r"^CE "),
]


def paths(blysk, option, table):
    """What `blysk clock` says of a configuration with these delays: parts and nanoseconds of each path."""
    file = synth.WORK / "delays.json"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(table))
    command = [*shlex.split(blysk), "clock", *option, "--device", str(file), "--format", "json"]
    said = subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout
    return [(row["through"], row["ns"]) for row in json.loads(said)]


def counts(blysk, option, names, rest):
    """How often each delay lies on each path."""
    ones = {name: 1.0 for name in names} | rest
    base = paths(blysk, option, ones)
    more = [[ns for _, ns in paths(blysk, option, ones | {name: 2.0})] for name in names]
    return [(words, [other[i] - ns for other in more]) for i, (words, ns) in enumerate(base)]


def setup_of_multipliers(place):
    """What the operands of a multiplier with a register want before the clock, in nanoseconds."""
    pattern = r"SETUPHOLD \(posedge [AB]\d+\) \(posedge CLK0\) \(\d+:\d+:(\d+)\)"
    return max((int(found) for found in re.findall(pattern, (place / "placed.sdf").read_text())), default=0) / 1e3


def arrivals(place):
    """When each register of a placement gets its value, by what Yosys calls it; its enable apart."""
    report, setup = json.loads((place / "report.json").read_text()), setup_of_multipliers(place)
    latest = {}
    for net in report["detailed_net_timings"]:
        for end in net["endpoints"]:
            name = re.sub(r"_(TRELLIS_FF|SB_DFF|d_MULT18X18D).*", "", end["cell"])
            if end["port"] in ("CE", "CEN", "CEA", "CEB", "RCLKE", "RE"):
                name = f"CE {name}"
            delay = max(end["delay"]) if isinstance(end["delay"], list) else end["delay"]
            if "MULT18X18D" in end["cell"] and end["port"][0] in "AB":
                delay += setup
            latest[name] = max(latest.get(name, 0.0), delay)
    return latest


def measured(words, latest):
    """The latest arrival at the registers in which a path ends; none where Yosys gave them other names."""
    last = words.split(", ")[-1] if ", " in words and not words.startswith("ready") else words
    for pattern, registers in ENDS:
        if found := re.search(pattern, words if pattern.startswith("^") else last):
            numbers = [int(group) for group in found.groups()]
            wanted = registers.format(*numbers, *[number + 1 for number in numbers])
            return max((delay for name, delay in latest.items() if re.search(wanted, name)), default=None)
    return None


def fit(equations, clocks):
    """Delays of 0 or more with the least squares of relative errors. The longest path of a configuration is to be its
    clock: which one that is follows from the delays, and so it is looked for again and again."""
    values = least_squares(equations, [1.0] * len(equations[0][0]), 20000)
    for _ in range(60):
        longest = []
        for rows, ns in clocks:
            row = max(rows, key=lambda row: sum(c * v for c, v in zip(row, values)))
            longest.append((row, ns, CLOCK / ns**2))
        # Half way, so that two paths of about the same length do not take turns.
        better = least_squares(equations + longest, list(values), 2000)
        values = [(a + b) / 2 for a, b in zip(values, better)]
    return values


def least_squares(equations, values, rounds):
    """One delay after the other, from the sums over all equations."""
    every = range(len(values))
    among = [[sum(weight * row[i] * row[k] for row, _, weight in equations) for i in every] for k in every]
    wanted = [sum(weight * row[k] * ns for row, ns, weight in equations) for k in every]
    for _ in range(rounds):
        for k in every:
            rest = wanted[k] - sum(among[k][i] * values[i] for i in every if i != k)
            if among[k][k]:
                values[k] = max(0.0, rest / among[k][k])
    return values


def placed(blysk, name, option, device):
    """Where the configuration is placed, with the first seed; none where it does not fit."""
    rtl, sources = synth.emit(blysk, name, option)
    row = synth.row(name, device, rtl, sources)
    return synth.WORK / name / device.replace(" ", "_") if row["fits"] == "yes" else None


def estimates(blysk):
    """Each placed row of docs/synthesis.csv with the estimated clock, and how far it is off."""
    options = synth.configurations(blysk)
    found = []
    for row in csv.DictReader(io.StringIO(synth.COMMITTED.read_text())):
        if row["f_max_mhz"]:
            table = json.loads(TABLES[row["device"]].read_text())
            estimate = 1e3 / max(ns for _, ns in paths(blysk, options[row["configuration"]], table))
            off = estimate / float(row["f_max_mhz"]) - 1
            found.append((row["configuration"], row["device"], row["f_max_mhz"], estimate, off))
    return found


def document(rows):
    """docs/SYNTHESIS.md with the table of these estimates."""
    lines = ["| configuration | device | median of three, MHz | estimated, MHz | off |", "|---|---|---:|---:|---:|"]
    lines += [f"| `{name}` | {device} | {placed} | {estimate:.1f} | {off:+.1%} |"
              for name, device, placed, estimate, off in rows]
    text = synth.DOCUMENT.read_text()
    before, rest = text.split(MARKERS[0])
    table = "\n".join(lines)
    return f"{before}{MARKERS[0]}\n{table}\n{MARKERS[1]}{rest.split(MARKERS[1])[1]}"


def show(blysk, check):
    """Writes the table, or tells whether it is as it would be written; 1 where an estimate is too far off."""
    rows = estimates(blysk)
    text = document(rows)
    if check and text != synth.DOCUMENT.read_text():
        sys.exit("docs/SYNTHESIS.md has other estimates; run scripts/delays.py --show")
    synth.DOCUMENT.write_text(text)
    far = [row for row in rows if abs(row[-1]) > MOST]
    for name, device, placed, estimate, off in far:
        print(f"{name} on {device}: {estimate:.1f} MHz estimated, {placed} placed, {off:+.1%}")
    print(f"{len(rows)} estimates, the farthest {max(abs(row[-1]) for row in rows):.1%} off")
    return 1 if far else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blysk", default="blysk", help="the command that writes the RTL")
    parser.add_argument("--show", action="store_true", help="only write the estimates into docs/SYNTHESIS.md")
    parser.add_argument("--check", action="store_true", help="only tell whether those there are up to date")
    parser.add_argument("--device", choices=TABLES, help="the table of this one alone")
    parser.add_argument("--reuse", action="store_true", help="take the placements of the last run where they are")
    args = parser.parse_args()
    os.environ["PATH"] = f"{synth.VENV}:{os.environ['PATH']}"
    if args.show or args.check:
        sys.exit(show(args.blysk, args.check))
    synth.SEEDS = synth.SEEDS[:1]
    synth.COMMON = synth.COMMON.replace("--quiet", "--detailed-timing-report --sdf placed.sdf --quiet")
    for device, file in TABLES.items():
        if args.device not in (None, device):
            continue
        table = fitted(args.blysk, device, args.reuse)
        file.write_text(json.dumps(table, indent=2) + "\n")
        print(f"{file.name}: {table}")


def fitted(blysk, device, reuse):
    """The table of a device."""
    names, rest = NAMES + TO_REGISTER.get(device, []), FIXED.get(device, {}) | {"multiplier_bits": BITS[device]}
    equations, clocks = [], []
    for name, option in synth.configurations(blysk).items():
        known = synth.WORK / name / device.replace(" ", "_")
        place = known if reuse else placed(blysk, name, option, device)
        if not place or not (place / "placed.sdf").exists():
            continue
        latest = arrivals(place)
        longest = max(latest.values())
        rows = counts(blysk, option, names, rest)
        clocks.append(([row for _, row in rows], longest))
        for words, row in rows:
            ns = measured(words, latest)
            print(f"{name:20}{device:12}{ns or 0:7.2f}  {words}", flush=True)
            if ns:
                equations.append((row, ns, (ns / longest) ** 4 / ns**2))
    if not equations:
        sys.exit(f"delays: no placement for {device}")
    return {key: round(value, 3) for key, value in zip(names, fit(equations, clocks))} | rest


if __name__ == "__main__":
    main()
