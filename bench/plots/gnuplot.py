"""Runs gnuplot: one look for every plot."""
import subprocess

# Okabe and Ito's palette, which most colour-blind people tell apart.
COLORS = {
    "blue": "#0072B2",
    "orange": "#D55E00",
    "green": "#009E73",
    "sky": "#56B4E9",
    "yellow": "#E69F00",
    "pink": "#CC79A7",
    "grey": "#666666",
}

LOOK = """
set border 3 lc rgb '#444444'
set tics nomirror scale 0.5 textcolor rgb '#222222'
set grid back lc rgb '#dddddd' lt 1 lw 0.6
set key top left reverse Left samplen 1.5
"""


def block(name, rows):
    """Rows of numbers and words as a data block of this name."""
    def text(value):
        return '"%s"' % value if isinstance(value, str) else "%.9g" % value
    return "\n".join(["$%s << END" % name] + [" ".join(map(text, row)) for row in rows] + ["END\n"])


def draw(path, size, script):
    """Writes the SVG file `path`, size = (width, height) in px."""
    terminal = "set terminal svg size %d,%d font 'sans-serif,13' background rgb 'white'\n" % size
    done = subprocess.run(["gnuplot"], input=terminal + "set output '%s'\n" % path + LOOK + script,
                          text=True, capture_output=True)
    if done.returncode != 0 or "warning" in done.stderr.lower():
        raise SystemExit("gnuplot, %s:\n%s" % (path, done.stderr))
