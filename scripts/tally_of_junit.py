"""A report of ctest as lines "passed NAME", "failed NAME: WHY", "skipped NAME: WHY".

Usage: tally_of_junit.py REPORT.xml SUITE
"""

import sys
import xml.etree.ElementTree as ElementTree


def last_words(said):
    """Of a test that failed: its first complaint, else the last line."""
    complaints = [text for text in said if "ERROR" in text or "error:" in text]
    return (complaints or said or ["it said nothing"])[0 if complaints else -1].strip()


def line(case, suite):
    name = "%s/%s" % (suite, case.get("name"))
    said = (case.findtext("system-out") or "").strip().splitlines()
    if case.get("status") == "run":
        return "passed " + name
    if case.find("skipped") is not None and case.get("status") == "notrun":
        return "skipped %s: %s" % (name, said[-1].strip() if said else "it gave no reason")
    failure = case.find("failure")
    why = failure.get("message") if failure is not None else "it did not run"
    return "failed %s: %s" % (name, why or last_words(said))


cases = ElementTree.parse(sys.argv[1]).getroot().findall("testcase")
for result in cases:
    print(line(result, sys.argv[2]))
if not cases:
    print("failed %s: it has no tests" % sys.argv[2])
