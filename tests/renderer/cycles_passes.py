"""Run inside Blender: renders with Cycles what a capture shows, as passes of one OpenEXR file.

    blender --background --factory-startup --python cycles_passes.py -- JOB.json

JOB.json has "scene" (glTF), "output", "size" [width, height], "view_from_world" [4][4] and
"left_right_bottom_top", "orthographic", "near", "far" as a capture states them; or, in place of these, "recipe":
Python text to run once the scene is there, which is then seen by a camera of its own. "time": seconds, or absent.

Of Cycles everything is taken that could be told otherwise by our own code: reading the file, tangents,
textures, projection, visibility. Rays go through the centres of pixels.
"""

import json
import math
import sys

import numpy

# Names that Blender 3.4's importer still uses and numpy 1.24 dropped.
for name, kind in (("bool", bool), ("int", int), ("float", float), ("object", object)):
    if name not in numpy.__dict__:
        setattr(numpy, name, kind)

import bpy  # noqa: E402
from mathutils import Matrix  # noqa: E402

# Blender's axes in glTF's: (x, y, z) of glTF is (x, -z, y).
BLENDER_FROM_GLTF = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
NARROWEST_FILTER = 0.01  # px; Cycles takes no less
FARTHEST = 1e6  # m; Cycles has no far plane at infinity


def hide_back_faces():
    """glTF shows a single-sided material from the front alone; Cycles shows both sides."""
    for material in bpy.data.materials:
        if not material.use_backface_culling or not material.use_nodes:
            continue
        nodes, links = material.node_tree.nodes, material.node_tree.links
        output = next(n for n in nodes if n.type == "OUTPUT_MATERIAL")
        if not output.inputs["Surface"].is_linked:
            continue
        front = output.inputs["Surface"].links[0].from_socket
        mix = nodes.new("ShaderNodeMixShader")
        links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], mix.inputs[0])
        links.new(front, mix.inputs[1])
        links.new(nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[2])
        links.new(mix.outputs[0], output.inputs["Surface"])


def add_camera(job):
    left, right, bottom, top = job["left_right_bottom_top"]
    data = bpy.data.cameras.new("capture")
    data.sensor_fit = "HORIZONTAL"
    if job["orthographic"]:
        data.type = "ORTHO"
        data.ortho_scale = right - left
    else:
        data.angle_x = 2.0 * math.atan(0.5 * (right - left))
    data.shift_x = 0.5 * (left + right) / (right - left)
    data.shift_y = 0.5 * (bottom + top) / (right - left)
    data.clip_start = job["near"]
    data.clip_end = min(job["far"], FARTHEST)
    camera = bpy.data.objects.new("capture", data)
    camera.matrix_world = BLENDER_FROM_GLTF @ Matrix(job["view_from_world"]).inverted()
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def set_up_render(job):
    scene, layer = bpy.context.scene, bpy.context.view_layer
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = job["size"]
    render.resolution_percentage = 100
    render.film_transparent = True
    cycles.samples = 1
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = NARROWEST_FILTER
    cycles.max_bounces = 0
    cycles.transparent_max_bounces = 64
    layer.use_pass_z = layer.use_pass_normal = True
    layer.use_pass_position = layer.use_pass_diffuse_color = True
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.color_depth = "32"
    render.filepath = job["output"]


def main():
    with open(sys.argv[sys.argv.index("--") + 1]) as file:
        job = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=job["scene"])
    if job.get("time") is not None:
        frame = job["time"] * bpy.context.scene.render.fps
        bpy.context.scene.frame_set(math.floor(frame), subframe=frame % 1.0)
    hide_back_faces()
    set_up_render(job)
    if "recipe" in job:
        cameras = [item for item in bpy.context.scene.objects if item.type == "CAMERA"]
        bpy.context.scene.camera = cameras[0]
        exec(job["recipe"], {})
    else:
        add_camera(job)
    bpy.ops.render.render(write_still=True)


main()
