"""8-bit PNG files, and pictures as functions of place."""

import struct
import zlib

CHANNELS = {0: 1, 2: 3, 6: 4}  # by PNG colour type


def encode(pixels, width, height, color_type, level=9):
    """pixels: [height][width * channels]. The filter is `up`: these pictures repeat by rows.

    level 0 stores: the same bytes whatever zlib it is."""
    raw = bytearray()
    above = bytes(width * CHANNELS[color_type])
    for row in pixels:
        raw.append(2)
        raw += bytes((value - over) & 255 for value, over in zip(row, above))
        above = row
    header = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(bytes(raw), level)) + chunk(b"IEND", b""))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def content(data):
    """What a PNG of ours says, whatever zlib compressed it: two builds of zlib may differ in
    their bytes."""
    parts, place = [], 8
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + length]
        parts.append((kind, zlib.decompress(body) if kind == b"IDAT" else body))
        place += 12 + length
    return parts


def byte(value):
    return max(0, min(255, int(value * 255.0 + 0.5)))


def picture(size, color, level=9):
    """An RGB picture of color(x, y), x and y in pixels."""
    rows = [bytes(byte(c) for x in range(size) for c in color(x, y)) for y in range(size)]
    return encode(rows, size, size, 2, level)


def normal_map(size, height, depth, level=9):
    """From height(x, y) in [0, 1], which repeats with `size`; depth: its scale, in pixels."""
    heights = [[height(x, y) for x in range(size)] for y in range(size)]
    def normal(x, y):
        dx = (heights[y][(x + 1) % size] - heights[y][x - 1]) * depth / 2
        # Rows run down, and the green of a glTF normal map points up.
        dy = (heights[y - 1][x] - heights[(y + 1) % size][x]) * depth / 2
        length = (dx * dx + dy * dy + 1.0) ** 0.5
        return 0.5 - 0.5 * dx / length, 0.5 - 0.5 * dy / length, 0.5 + 0.5 / length
    return picture(size, normal, level)
