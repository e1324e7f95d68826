"""What the programs beside this file share: running others, reading OpenEXR files, telling results."""

import os
import subprocess
import sys

import numpy
import OpenImageIO as oiio


def run(*command):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if result.returncode != 0:
        sys.stderr.write(result.stdout[-2000:] + result.stderr[-2000:])
        raise SystemExit("%s ended with status %d" % (command[0], result.returncode))


class Picture:
    """An OpenEXR file: planes by the names of its channels, and its attributes."""

    def __init__(self, path):
        file = oiio.ImageInput.open(str(path))
        self.spec = file.spec()
        pixels = file.read_image(oiio.FLOAT)
        self.planes = {n: pixels[:, :, i] for i, n in enumerate(self.spec.channelnames)}
        file.close()

    def vectors(self, names):
        return numpy.stack([self.planes[n].astype(float) for n in names], axis=-1)


def in_blender(script, *arguments):
    run("blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", script,
        "--", *arguments)


def tell(name, faults):
    """Prints the faults and appends the result to the file TALLY, if that is named."""
    for fault in faults:
        print("%s: %s" % (name, fault), file=sys.stderr)
    if "TALLY" in os.environ:
        with open(os.environ["TALLY"], "a") as tally:
            print("failed %s: %s" % (name, faults[0]) if faults else "passed %s" % name, file=tally)
