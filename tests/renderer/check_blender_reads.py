#!/usr/bin/env python3
"""Does Blender see in our G-buffers what OpenImageIO sees?

    check_blender_reads.py TILELIGHT SCENE
"""

import pathlib
import sys
import tempfile

import numpy

from pictures import Picture, in_blender, run, tell

SIZE = (320, 180)
COPY = pathlib.Path(__file__).with_name("copy_in_blender.py")
# Channels of ours, and what they are called in what Blender writes of them.
CHANNELS = {"R": "Combined.R", "G": "Combined.G", "B": "Combined.B", "A": "Combined.A", "Z": "Depth.V",
            "N.X": "N.R", "N.Y": "N.G", "N.Z": "N.B",
            "albedo.R": "albedo.R", "albedo.G": "albedo.G", "albedo.B": "albedo.B",
            "emissive.R": "emissive.R", "emissive.G": "emissive.G", "emissive.B": "emissive.B"}


def main(tilelight, scene):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run(tilelight, "capture", scene, "-o", folder / "ours.exr", "--size", "%dx%d" % SIZE)
        in_blender(COPY, folder / "ours.exr", folder / "copy", *SIZE)
        ours, copy = Picture(folder / "ours.exr"), Picture(folder / "copy0001.exr")
    faults = []
    for channel, there in CHANNELS.items():
        if there not in copy.planes:
            faults.append("channel %s was not found" % channel)
        elif not numpy.array_equal(ours.planes[channel], copy.planes[there]):
            faults.append("channel %s differs" % channel)
    tell("independent-renderer/blender reads our file", faults)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
