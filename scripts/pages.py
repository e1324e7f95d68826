"""What the scripts that make pages share. Parts of a page are theirs, between markers

    <!-- begin: WORD --> ... <!-- end: WORD -->

and the words around them are written by hand.
"""
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PLACE = re.compile(r"(<!-- begin: (\w+) -->\n).*?(<!-- end: \2 -->)", re.S)
# What a word of a form stands for, and whether a path is one; other words stand for any text.
PATHS = {
    "PROGRAM": ("program", lambda path: os.path.isfile(path) and os.access(path, os.X_OK)),
    "BUILD": ("folder of a build", lambda path: os.path.isfile(os.path.join(path, "CMakeCache.txt"))),
    "FILE": ("file", os.path.isfile),
}


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


def fits(word, given):
    return given == word if word.startswith("-") else not given.startswith("-")


def check_path(word, given):
    what, is_one = PATHS.get(word, ("", lambda path: True))
    if not is_one(given):
        raise SystemExit("%s: %s is no %s." % (pathlib.Path(sys.argv[0]).name, given, what))


def arguments(doc, *forms):
    """The words behind the script's name, which are of one of the forms: an option is itself there, any other
    word something that is no option. --help prints doc, and so does what has no such form, with status 1."""
    given = sys.argv[1:]
    if given in (["--help"], ["-h"]):
        print(doc.strip())
        raise SystemExit(0)
    for form in map(str.split, forms):
        if len(form) == len(given) and all(map(fits, form, given)):
            for word, text in zip(form, given):
                check_path(word, text)
            return given
    raise SystemExit(doc.strip())
