#!/usr/bin/env python3
"""Makes the scenes of this folder; README.md says what each shows.

    data/make_scenes.py             writes every file that differs
    data/make_scenes.py --check     exits with 1 where a file differs from what this would write

Standard library only. The same bytes on every machine, but for the compressed part of a PNG, which
--check compares decompressed.
"""

import pathlib
import sys

sys.dont_write_bytecode = True
from scenes import fair, hall, hard_cases, nine_lights, panes, png, profiles, sky, window  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parent


def is_current(path, data):
    if not path.exists():
        return False
    found = path.read_bytes()
    if path.suffix == ".png" and found != data:
        return png.content(found) == png.content(data)
    return found == data


def main(arguments):
    if arguments not in ([], ["--check"]):
        print(__doc__, file=sys.stderr)
        return 2
    different = []
    for scene in (nine_lights, hall, hard_cases, fair, panes, sky, window, profiles):
        for name, data in scene.files().items():
            if is_current(FOLDER / name, data):
                continue
            different.append(name)
            if not arguments:
                (FOLDER / name).write_bytes(data)
                print("%s: %d bytes" % (name, len(data)))
    if arguments and different:
        print("not what data/make_scenes.py makes, run it: %s" % ", ".join(different),
              file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
