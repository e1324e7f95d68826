"""OpenEXR files as their specification has them ("OpenEXR File Layout", openexr.com): one part, scan lines of half
floats, not compressed, so that bytes are the same on every machine."""

import struct


def _attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value


def _header(width, height):
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(c + b"\0" + struct.pack("<IIII", 1, 0, 1, 1) for c in (b"B", b"G", b"R"))
    return b"".join((
        struct.pack("<II", 20000630, 2),
        _attribute("channels", "chlist", channels + b"\0"),
        _attribute("compression", "compression", b"\0"),
        _attribute("dataWindow", "box2i", window),
        _attribute("displayWindow", "box2i", window),
        _attribute("lineOrder", "lineOrder", b"\0"),
        _attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        _attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0)),
        _attribute("screenWindowWidth", "float", struct.pack("<f", 1.0)),
        b"\0"))


def encoded(width, height, color_at):
    """color_at(x, y): (R, G, B), each 0 to 65504, from the top left."""
    header = _header(width, height)
    size = 8 + 6 * width  # of a line: number, bytes, three channels
    first = len(header) + 8 * height
    lines = []
    for y in range(height):
        colors = [color_at(x, y) for x in range(width)]
        planes = b"".join(struct.pack("<%de" % width, *(c[channel] for c in colors)) for channel in (2, 1, 0))
        lines.append(struct.pack("<ii", y, 6 * width) + planes)
    offsets = struct.pack("<%dQ" % height, *(first + size * y for y in range(height)))
    return header + offsets + b"".join(lines)
