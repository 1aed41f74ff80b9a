"""The icon of the FMU: turntable, disc, slider and wheel, seen from above."""
import math
import struct
import zlib

SIZE = 96      # [pixels]
SAMPLES = 4    # of a pixel, in either direction
WHITE, GREY, BLUE = (255, 255, 255), (205, 210, 216), (31, 119, 180)
DARK, ORANGE = (70, 78, 88), (232, 119, 34)


def in_box(x, y, centre, angle, length, width):
    x, y = x - centre[0], y - centre[1]
    along = x * math.cos(angle) + y * math.sin(angle)
    across = y * math.cos(angle) - x * math.sin(angle)
    return abs(along) <= length / 2 and abs(across) <= width / 2


def colour(x, y):
    """At a point of the square [-1, 1] x [-1, 1], y upwards."""
    wheel = (0.25, -0.3)
    if in_box(x, y, wheel, math.radians(45), 0.56, 0.2):
        return ORANGE
    if in_box(x, y, wheel, 0, 0.4, 0.3):
        return DARK
    if in_box(x, y, (0, -0.3), 0, 1.2, 0.07) or math.hypot(x, y) < 0.06:
        return DARK
    radius = math.hypot(x, y)
    if 0.66 < radius < 0.74:
        return BLUE
    return GREY if radius < 0.95 else WHITE


def chunk(kind, data):
    return (struct.pack(">I", len(data)) + kind + data
            + struct.pack(">I", zlib.crc32(kind + data)))


def icon():
    """The bytes of a PNG file."""
    lines = bytearray()
    steps = [(i + 0.5) / SAMPLES for i in range(SAMPLES)]
    for row in range(SIZE):
        lines.append(0)  # no filter
        for column in range(SIZE):
            points = [colour(2 * (column + a) / SIZE - 1,
                             1 - 2 * (row + b) / SIZE)
                      for a in steps for b in steps]
            lines += bytes(sum(p[i] for p in points) // len(points)
                           for i in range(3))
    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(bytes(lines), 9))
            + chunk(b"IEND", b""))
