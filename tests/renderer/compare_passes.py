#!/usr/bin/env python3
"""How far captures lie from what an independent renderer, Cycles, sees of the same scenes.

    compare_passes.py TILELIGHT RESULT.json NAME=SCENE[@CAMERA][+SECONDS]...

Writes RESULT.json, a row for each scene; prints the same as a table, and tells results to the file TALLY.
Ends with 1 where a scene is outside LIMITS. Needs Blender, OpenImageIO's and numpy's Python modules.

Textures are looked up without filter on both sides, for the two filter differently. What then remains
beyond the median is at silhouettes, where Cycles turns normals that would mirror rays into the surface,
and at the borders of texels.
"""

import concurrent.futures
import json
import os
import pathlib
import struct
import sys
import tempfile

import numpy

from pictures import Picture, in_blender, run, tell

SIZE = (960, 540)
LIMITS = {
    "depth_median": 1e-5,  # of the depth itself
    "normal_median_degrees": 0.1,
    "coverage_differs": 0,  # pixels, but for those at edges
    "attributes_off_pixels": 0.01,  # rays miss centres by 0.005; float rounds by 0.0005
    "attributes_depth": 1e-5,  # of the depth itself, median
}
PASSES = pathlib.Path(__file__).with_name("cycles_passes.py")
NEAREST = 9728  # OpenGL's number, and glTF's
CYCLES_SKY = 1e9  # what lies farther is nothing: Cycles writes 1e10


def job_of(capture, scene, time, output):
    attribute = capture.spec.getattribute
    frustum = attribute("tilelight:frustum")
    far = attribute("tilelight:far")
    # Row by row; OpenImageIO hands out sixteen numbers.
    matrix = numpy.array(attribute("tilelight:viewFromWorld"), dtype=float).reshape(4, 4)
    return {
        "scene": str(pathlib.Path(scene).resolve()),
        "output": str(output),
        "time": float(time) if time else None,
        "size": SIZE,
        "view_from_world": matrix.tolist(),
        "left_right_bottom_top": [frustum[0], frustum[2], frustum[1], frustum[3]],
        "orthographic": attribute("tilelight:projection") == "orthographic",
        "near": attribute("tilelight:near"),
        "far": far if numpy.isfinite(far) else 1e6,
    }


def touching(mask):
    """Pixels that have a neighbour, or are one, in the mask."""
    padded = numpy.pad(mask, 1)
    h, w = mask.shape
    return numpy.any([padded[y:y + h, x:x + w] for y in range(3) for x in range(3)], axis=0)


def gltf_axes(vectors):
    """(x, y, z) of glTF is Blender's (x, -z, y)."""
    return numpy.stack([vectors[..., 0], vectors[..., 2], -vectors[..., 1]], axis=-1)


def compare_attributes(capture, places, pixels):
    """The camera as OpenEXR defines it, for row vectors, put to what Cycles hit: `places` [n][3] in the world,
    seen in `pixels`, a pair of [n] rows and columns. How far beside its pixel a place comes to lie, but for one in a
    thousand (a ray that grazes an edge hits the face beside it), and how far its depth is from the capture's."""
    rows, columns = pixels
    world = numpy.concatenate([places, numpy.ones((len(places), 1))], axis=1)
    matrices = [numpy.array(capture.spec.getattribute(name), dtype=float).reshape(4, 4)
                for name in ("worldToNDC", "worldToCamera")]
    ndc, view = world @ matrices[0], world @ matrices[1]
    x, y = ndc[:, 0] / ndc[:, 3] * SIZE[0] - 0.5, ndc[:, 1] / ndc[:, 3] * SIZE[1] - 0.5
    depth = numpy.abs(view[:, 2] / capture.planes["Z"][rows, columns] - 1.0)
    beside = numpy.maximum(abs(x - columns), abs(y - rows))
    return {"attributes_off_pixels": float(numpy.quantile(beside, 0.999)),
            "attributes_depth": float(numpy.median(depth))}


def compare(capture, cycles):
    ours = capture.planes["Z"].astype(float)
    theirs = cycles.planes["ViewLayer.Depth.Z"].astype(float)
    covered, seen = numpy.isfinite(ours), theirs < CYCLES_SKY
    edges = touching(covered) & touching(~covered)
    both = covered & seen
    places = gltf_axes(cycles.vectors(["ViewLayer.Position." + axis for axis in "XYZ"])[seen])
    depth = numpy.abs(ours[both] / theirs[both] - 1.0)

    a = capture.vectors(["N.X", "N.Y", "N.Z"])[both]
    b = gltf_axes(cycles.vectors(["ViewLayer.Normal." + axis for axis in "XYZ"])[both])
    # Cycles has no normal where a texture's coordinates have no direction.
    length = numpy.linalg.norm(b, axis=1)
    a, b = a[length > 0.0], b[length > 0.0] / length[length > 0.0, None]
    angle = numpy.degrees(2.0 * numpy.arcsin(numpy.clip(
        0.5 * numpy.linalg.norm(a - b, axis=1), 0.0, 1.0)))
    return {
        "covered": float(covered.mean()),
        "coverage_differs": int(((covered != seen) & ~edges).sum()),
        "coverage_differs_at_edges": int(((covered != seen) & edges).sum()),
        "depth_median": float(numpy.median(depth)),
        "depth_p99": float(numpy.quantile(depth, 0.99)),
        "normal_median_degrees": float(numpy.median(angle)),
        "normal_p99_degrees": float(numpy.quantile(angle, 0.99)),
        **compare_attributes(capture, places, numpy.nonzero(seen)),
    }


def parts_of(path):
    """The JSON of a glTF file, and what stands behind it in a .glb."""
    data = path.read_bytes()
    if data[:4] != b"glTF":
        return json.loads(data), None
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + size]), data[20 + size:]


def with_nearest_texels(scene, folder):
    """The same scene, its textures looked up without filter: filters differ, and are no question here.
    Files that it names are linked beside it."""
    content, rest = parts_of(scene)
    samplers = content.setdefault("samplers", [])
    for sampler in samplers:
        sampler.update(magFilter=NEAREST, minFilter=NEAREST)
    samplers.append({"magFilter": NEAREST, "minFilter": NEAREST})
    for texture in content.get("textures", []):
        texture.setdefault("sampler", len(samplers) - 1)
    for beside in scene.parent.iterdir():
        if beside.name != scene.name:
            (folder / beside.name).symlink_to(beside.resolve())
    text = json.dumps(content).encode()
    if rest is not None:
        text += b" " * (-len(text) % 4)
        text = struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text),
                           0x4E4F534A) + text + rest
    made = folder / scene.name
    made.write_bytes(text)
    return made


def measure(tilelight, scene, camera, time, folder):
    place = folder / "scene"
    place.mkdir()
    scene = with_nearest_texels(pathlib.Path(scene), place)
    ours, theirs, job = folder / "ours.exr", folder / "theirs.exr", folder / "job.json"
    run(tilelight, "capture", scene, "-o", ours, "--size", "%dx%d" % SIZE,
        *(["--camera", camera] if camera else []), *(["--time", time] if time else []))
    capture = Picture(ours)
    job.write_text(json.dumps(job_of(capture, scene, time, theirs)))
    in_blender(PASSES, job)
    return compare(capture, Picture(theirs))


def line(name, row):
    return ("%-28s depth %.1e (p99 %.1e)  normal %.3f deg (p99 %.2f)  coverage off %d, at edges %d"
            "  camera %.4f px"
            % (name, row["depth_median"], row["depth_p99"], row["normal_median_degrees"],
               row["normal_p99_degrees"], row["coverage_differs"], row["coverage_differs_at_edges"],
               row["attributes_off_pixels"]))


def measure_named(tilelight, named):
    """(Its name, what was found) of NAME=FILE[@CAMERA][+TIME]."""
    name, scene = named.split("=", 1)
    scene, _, time = scene.partition("+")
    scene, _, camera = scene.partition("@")
    with tempfile.TemporaryDirectory() as folder:
        return name, measure(tilelight, scene, camera, time, pathlib.Path(folder))


def main(tilelight, result, *scenes):
    rows, all_within = {}, True
    # Most of what Blender does, to begin with and to read a scene, it does on one processor.
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, row in pool.map(lambda named: measure_named(tilelight, named), scenes):
            rows[name] = row
            print(line(name, row), flush=True)
            # Written so that not-a-number is outside, too.
            faults = ["%s is %g, at most %g was allowed" % (key, row[key], limit)
                      for key, limit in LIMITS.items() if not row[key] <= limit]
            tell("independent-renderer/" + name, faults)
            all_within &= not faults
    pathlib.Path(result).write_text(
        json.dumps({"size": SIZE, "limits": LIMITS, "scenes": rows}, indent=1) + "\n")
    return 0 if all_within else 1


if __name__ == "__main__":
    os.environ["TILELIGHT_CACHE"] = ""
    sys.exit(main(*sys.argv[1:]))
