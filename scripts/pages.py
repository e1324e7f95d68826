"""What the scripts that make pages share. Parts of a page are theirs, between markers

    <!-- begin: WORD --> ... <!-- end: WORD -->

and the words around them are written by hand.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PLACE = re.compile(r"(<!-- begin: (\w+) -->\n).*?(<!-- end: \2 -->)", re.S)


def keep(page, parts, check):
    """Writes the page with these parts, {WORD: lines}, or, to check, ends where it is another."""
    text = page.read_text()
    places = [found[2] for found in PLACE.finditer(text)]
    if sorted(places) != sorted(parts):
        raise SystemExit("%s has places for %s, and there are parts for %s"
                         % (page, ", ".join(sorted(places)), ", ".join(sorted(parts))))
    made = PLACE.sub(lambda found: found[1] + parts[found[2]] + found[3], text)
    if not check:
        page.write_text(made)
    elif made != text:
        raise SystemExit("%s is not what scripts/%s makes" % (page, pathlib.Path(sys.argv[0]).name))


def table(heading, rows, rule="---"):
    """rule: below the headings but the first, as Markdown has it."""
    lines = [heading, ["---"] + [rule] * (len(heading) - 1)] + rows
    return "".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in row) + " |\n" for row in lines)


def thousands(number):
    return "{:,}".format(number)
