"""Reads SystemVerilog with slang, whose Python package has no command: arguments are those of slang."""

import shlex
import sys

from pyslang import driver

slang = driver.Driver()
slang.addStandardArgs()
read = slang.parseCommandLine(shlex.join(["slang", *sys.argv[1:]]))
sys.exit(0 if read and slang.processOptions() and slang.parseAllSources() and slang.runFullCompilation() else 1)
