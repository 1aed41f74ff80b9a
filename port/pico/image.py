#!/usr/bin/python3 -B
"""Makes of a program for the RP2040 what its boot ROM takes: image.py ELF.

Puts the CRC of the boot code into the ELF, and writes beside it the file with
suffix .uf2 that is copied to the Pico's drive: the boot code, and behind it the
program, which the boot code copies to RAM.
"""
from __future__ import annotations

import struct
import sys
from pathlib import Path

FLASH, RAM, BOOT = 0x10000000, 0x20000000, 256
PAGE, BLOCK, SECTOR = 256, 512, 4096
START0, START1, END = 0x0A324655, 0x9E5D5157, 0x0AB16F30
FAMILY_GIVEN, RP2040 = 0x2000, 0xE48BFF56


def crc32(data: bytes) -> int:
    """The CRC of the boot ROM: the highest bit first, nothing inverted."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = crc << 1 ^ (0x104C11DB7 if crc >> 31 else 0)
    return crc


def segments(elf: bytes) -> list[tuple[int, int, int]]:
    """(address, place in the file, bytes) of what is loaded."""
    if elf[:6] != b"\x7fELF\1\1":
        sys.exit("image.py: no little-endian ELF of 32 bits")
    table, size, count = (*struct.unpack_from("<I", elf, 28),
                          *struct.unpack_from("<HH", elf, 42))
    headers = (struct.unpack_from("<8I", elf, table + size * i)
               for i in range(count))
    return [(paddr, offset, length)
            for kind, offset, _, paddr, length, *_ in headers
            if kind == 1 and length > 0]


def flash_of(elf: bytearray) -> bytes:
    """What lies in flash; seals the boot code in the ELF itself."""
    flash = bytearray()
    for address, offset, length in segments(elf):
        if address == FLASH and length == BOOT:
            code = elf[offset:offset + BOOT - 4]
            struct.pack_into("<I", elf, offset + BOOT - 4, crc32(code))
            at = 0
        elif address >= RAM:
            at = BOOT + address - RAM
        else:
            sys.exit(f"image.py: {address:#x} is neither boot code nor RAM")
        flash[len(flash):] = bytes(max(0, at + length - len(flash)))
        flash[at:at + length] = elf[offset:offset + length]
    if not any(flash[:BOOT]):
        sys.exit("image.py: there is no boot code")
    return bytes(flash)


def uf2(flash: bytes) -> bytes:
    """The blocks of a UF2 file: whole sectors, which is what flash erases."""
    flash += bytes(-len(flash) % SECTOR)
    count = len(flash) // PAGE
    return b"".join(
        struct.pack("<8I", START0, START1, FAMILY_GIVEN, FLASH + PAGE * i,
                    PAGE, i, count, RP2040)
        + flash[PAGE * i:PAGE * (i + 1)].ljust(BLOCK - 36, b"\0")
        + struct.pack("<I", END) for i in range(count))


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: image.py ELF")
    path = Path(sys.argv[1])
    elf = bytearray(path.read_bytes())
    flash = flash_of(elf)
    path.write_bytes(elf)
    path.with_suffix(".uf2").write_bytes(uf2(flash))


if __name__ == "__main__":
    main()
