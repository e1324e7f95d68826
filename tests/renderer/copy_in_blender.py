"""Run inside Blender: reads an OpenEXR file as its compositor does and writes what it saw.

    blender --background --factory-startup --python copy_in_blender.py -- IN.exr OUT WIDTH HEIGHT

Writes OUT0001.exr, a multi-layer file with a layer for each pass of IN.
"""

import sys

import bpy


def main(source, target, width, height):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
    scene.render.resolution_percentage = 100
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    read = tree.nodes.new("CompositorNodeImage")
    read.image = bpy.data.images.load(source)
    write = tree.nodes.new("CompositorNodeOutputFile")
    write.base_path = target
    write.format.file_format = "OPEN_EXR_MULTILAYER"
    write.format.color_depth = "32"
    write.file_slots.clear()
    for output in read.outputs:
        write.file_slots.new(output.name)
        tree.links.new(output, write.inputs[output.name])
    tree.links.new(read.outputs["Combined"],
                   tree.nodes.new("CompositorNodeComposite").inputs["Image"])
    bpy.ops.render.render()


main(*sys.argv[sys.argv.index("--") + 1:])
