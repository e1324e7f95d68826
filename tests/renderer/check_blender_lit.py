#!/usr/bin/env python3
"""Is a frame that Blender rendered lit as our capture of the same scene is?

    check_blender_lit.py TILELIGHT

Goes the way that docs/file-formats.md shows to users of Blender, by the text that stands there. Lights are without
highlights, and none is ambient: Cycles' passes do not tell metal from what is dark.
"""

import json
import os
import pathlib
import sys
import tempfile

import numpy

from pictures import Picture, in_blender, run, tell

ROOT = pathlib.Path(__file__).resolve().parents[2]
PASSES = pathlib.Path(__file__).with_name("cycles_passes.py")
SCENE, LIGHTS = ROOT / "data/nine-lights.gltf", ROOT / "data/nine-lights.lights.json"
SIZE = (480, 270)
# Rays miss the centre by 0.005 px and diffuse light varies little in that; what is off by more is beside an edge.
LARGEST_USUAL, UNUSUAL = 1e-3, 0.001  # of the mean and the pixel's own; share of pixels


def recipe():
    """The lines for Blender's console."""
    lines = (ROOT / "docs/file-formats.md").read_text().splitlines()
    first = lines.index("    import bpy, json, math")
    last = next(i for i in range(first, len(lines)) if not lines[i].strip())
    return "\n".join(line[4:] for line in lines[first:last])


def write_lights(path, axes):
    """The scene's lights without highlights, in places and directions by `axes`."""
    lights = json.loads(LIGHTS.read_text())
    lights["ambient"] = [0, 0, 0]
    for light in lights["lights"]:
        light["specular"] = 0
        for field in ("position", "direction"):
            if field in light:
                light[field] = axes(*light[field])
    path.write_text(json.dumps(lights))


def differences(ours, theirs):
    a, b = (numpy.stack([p.planes[c].astype(float) for c in "RGB"], axis=-1) for p in (ours, theirs))
    return numpy.abs(a - b).max(axis=-1) / (a.mean() + a.max(axis=-1))


def main(tilelight):
    with tempfile.TemporaryDirectory() as name:
        os.chdir(name)
        size = "%dx%d" % SIZE
        folder = pathlib.Path(name)
        (folder / "job.json").write_text(json.dumps(
            {"scene": str(SCENE), "output": str(folder / "frame.exr"), "size": SIZE, "recipe": recipe()}))
        in_blender(PASSES, folder / "job.json")
        write_lights(folder / "ours.json", lambda x, y, z: [x, y, z])
        write_lights(folder / "theirs.json", lambda x, y, z: [x, -z, y])
        run(tilelight, "render", SCENE, "--size", size, "--lights", "ours.json", "-o", "ours.exr")
        run(tilelight, "light", "frame.exr", "--camera-file", "camera.json", "--lights", "theirs.json",
            "-o", "theirs.exr")
        off = differences(Picture(folder / "ours.exr"), Picture(folder / "theirs.exr"))
    share = float((off > LARGEST_USUAL).mean())
    print("a frame of Blender, lit: off by %.1e in the median; by more than %g in %.3f %% of the pixels"
          % (numpy.median(off), LARGEST_USUAL, 100 * share))
    faults = [] if share <= UNUSUAL else ["%.3f %% of the pixels are off" % (100 * share)]
    tell("independent-renderer/a frame of Blender is lit as our capture is", faults)
    return 1 if faults else 0


if __name__ == "__main__":
    os.environ["TILELIGHT_CACHE"] = ""
    sys.exit(main(str(pathlib.Path(sys.argv[1]).resolve())))
