"""Writes png_cases.h: small PNG files of every colour type, put together by hand from the PNG
specification (ISO/IEC 15948), and the values they hold."""

import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, depth, colour, rows, extra=b"", interlace=0):
    """rows: the bytes of each row, filter type 0."""
    header = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlace)
    pixels = b"".join(b"\0" + row for row in rows)
    return (SIGNATURE + chunk(b"IHDR", header) + extra + chunk(b"IDAT", zlib.compress(pixels))
            + chunk(b"IEND", b""))


def deep(*values):
    return struct.pack(">%dH" % len(values), *values)


# name, file, [sample of R, G, B per pixel], the largest sample
CASES = [
    ("grey, 1 bit", png(3, 1, 1, 0, [b"\xa0"]), [(255,) * 3, (0,) * 3, (255,) * 3], 255),
    ("grey, 4 bits", png(2, 1, 4, 0, [b"\x3f"]), [(51,) * 3, (255,) * 3], 255),
    ("grey, 8 bits", png(2, 1, 8, 0, [b"\x07\xfe"]), [(7,) * 3, (254,) * 3], 255),
    ("grey, 16 bits", png(2, 1, 16, 0, [deep(1, 65534)]), [(1,) * 3, (65534,) * 3], 65535),
    ("grey and alpha", png(1, 2, 8, 4, [b"\x10\x00", b"\x20\xff"]), [(16,) * 3, (32,) * 3], 255),
    ("colour, 8 bits", png(2, 1, 8, 2, [bytes([1, 2, 3, 253, 254, 255])]),
     [(1, 2, 3), (253, 254, 255)], 255),
    ("colour, 16 bits", png(1, 1, 16, 2, [deep(256, 1, 65535)]), [(256, 1, 65535)], 65535),
    ("colour and alpha", png(1, 1, 8, 6, [bytes([9, 8, 7, 0])]), [(9, 8, 7)], 255),
    ("colour and alpha, 16 bits", png(1, 1, 16, 6, [deep(9, 8, 7, 0)]), [(9, 8, 7)], 65535),
    ("palette, 2 bits",
     png(3, 1, 2, 3, [b"\x24"], chunk(b"PLTE", bytes([1, 2, 3, 4, 5, 6, 7, 8, 9]))),
     [(1, 2, 3), (7, 8, 9), (4, 5, 6)], 255),
    # Adam7: pass 1 has pixel (0, 0), pass 6 has (1, 0), pass 7 the second row.
    ("interlaced", png(2, 2, 8, 0, [b"\x01", b"\x02", b"\x03\x04"], interlace=1),
     [(1,) * 3, (2,) * 3, (3,) * 3, (4,) * 3], 255),
]


def main():
    print("/* Made by tools/make_png_cases.py: PNG files put together by hand. */")
    print("#ifndef TL_PNG_CASES_H\n#define TL_PNG_CASES_H\n")
    print("static const struct {\n    const char *name;\n    unsigned width, height;")
    print("    float largest; /* sample */\n    float samples[12]; /* [height][width][3] */")
    print("    size_t size;\n    unsigned char bytes[160];\n} png_cases[] = {")
    for name, data, samples, largest in CASES:
        width, height = struct.unpack(">II", data[16:24])
        flat = ", ".join("%d" % value for pixel in samples for value in pixel)
        numbers = ", ".join("0x%02x" % byte for byte in data)
        print('    {"%s", %d, %d, %d, {%s}, %d, {%s}},' % (name, width, height, largest, flat,
                                                         len(data), numbers))
    print("};\n\n#endif")


main()
