"""Reads a ROM image with a reader that is not ours, and prints every word in hex on a line.

    rom_images.py hex|mif|coe WIDTH DEPTH < image
"""

import re
import sys

import bincopy
import mif


def intel_hex(text, width, depth):
    """Addresses count words, as Quartus has them."""
    size = (width + 7) // 8
    image = bincopy.BinFile(word_size_bits=8 * size)
    image.add_ihex(text)
    data = bytes(image.as_binary())
    if (image.minimum_address, len(data)) != (0, size * depth):
        sys.exit(f"{len(data)} bytes from address {image.minimum_address}")
    return [int.from_bytes(data[at : at + size], "big") for at in range(0, len(data), size)]


def quartus(text, width, depth):
    bits = mif.loads(text)
    if bits.shape != (depth, width):
        sys.exit(f"{bits.shape} words and bits")
    return [sum(int(bit) << place for place, bit in enumerate(word)) for word in bits]


def vivado(text, width, depth):
    """No package reads these; the grammar is that of the Block Memory Generator's product guide: `;` at the beginning
    of a line begins a comment, statements end with `;`, values have commas or spaces between them."""
    text = re.sub(r"(?m)^\s*;.*$", "", text)
    statements = re.fullmatch(
        r"\s*memory_initialization_radix\s*=\s*(\d+)\s*;\s*memory_initialization_vector\s*=([^;]*);\s*", text
    )
    return [int(value, int(statements[1])) for value in re.split(r"[\s,]+", statements[2].strip())]


READERS = {"hex": intel_hex, "mif": quartus, "coe": vivado}
form, width, depth = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
for word in READERS[form](sys.stdin.read(), width, depth):
    print(f"{word:x}")
