#!/usr/bin/env python3
"""Is study.html what it has to be, in Chromium?

    check_study_page.py STUDY...             a check each of study_page.py
    check_study_page.py --plant STUDY...     does each check find the faults that are planted for it?

STUDY is a folder that `tilelight study' wrote. Results go to the file $TALLY too.
"""
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import study_page
from browser import browser
from page_faults import FAULTS


def tally(name, wrong):
    line = "passed study-page/%s" % name if not wrong else "failed study-page/%s: %s" % (name, wrong[0])
    print(line, *wrong[1:], sep="\n    ")
    if os.environ.get("TALLY"):
        with open(os.environ["TALLY"], "a") as file:
            file.write(line + "\n")


def check(one, page):
    study = study_page.read(page)
    for question in study_page.CHECKS:
        tally("%s, %s" % (page.parent.name, question.__name__), question(one, page, study))


def plant(one, page):
    study, text = study_page.read(page), page.read_text()
    for name, changes in FAULTS:
        faulty = text
        for have, want in changes:
            if have not in faulty:
                raise SystemExit("%s: nothing to plant a fault in: %s" % (page, have))
            faulty = faulty.replace(have, want)
        planted = page.with_name("planted.html")
        planted.write_text(faulty)
        found = getattr(study_page, name)(one, planted, study)
        tally("%s finds \"%s\"" % (name, changes[-1][1] or "nothing there"),
              [] if found else ["the fault in place of \"%s\" is not found" % changes[-1][0]])
        for what in found[:1]:
            print("    " + what)


def main():
    folders = [a for a in sys.argv[1:] if not a.startswith("-")]
    if not folders or set(sys.argv[1:]) - set(folders) - {"--plant"}:
        raise SystemExit(__doc__)
    with tempfile.TemporaryDirectory() as downloads, browser(downloads) as one:
        for folder in folders:
            (plant if "--plant" in sys.argv else check)(one, pathlib.Path(folder).resolve() / "study.html")


main()
