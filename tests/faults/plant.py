#!/usr/bin/env python3
"""Plants faults in a copy of the project and tells which test catches each; scripts/plant-faults runs it.

    tests/faults/plant.py COPY [--list | NAME...]
    tests/faults/plant.py --check    does each still apply to the project as it is?
"""
import os
import pathlib
import shutil
import subprocess
import sys
import time

from faults import FAULTS

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEFT_OUT = {"build", ".git"}
SKIPPED = 77
LONGEST = 300  # s, of a test
NOT_ENDED = -1000  # within that time; no signal has that number


def fail(sentence):
    raise SystemExit("plant-faults: " + sentence)


def update(path, content):
    """Writes what differs, so that what does not is not built again."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def copy_sources(source):
    kept = set()
    for folder, folders, files in os.walk(ROOT):
        folders[:] = [name for name in folders if name not in LEFT_OUT]
        for name in files:
            path = pathlib.Path(folder) / name
            kept.add(source / path.relative_to(ROOT))
            update(source / path.relative_to(ROOT), path.read_bytes())
            os.chmod(source / path.relative_to(ROOT), path.stat().st_mode)
    for path in [path for path in source.rglob("*") if path.is_file()]:
        if path not in kept:
            path.unlink()


def configure(source, build):
    # Not optimised is built sooner, and has the same bits. The check of kernels by clang, which takes longer
    # than all else and is no test, is left out.
    run(["cmake", "-G", "Ninja", "-S", source, "-B", build, "-DTILELIGHT_TESTS=ON",
         "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_C_FLAGS_RELEASE=-O0",
         "-DTL_CLANG=" + shutil.which("true")])


def run(command, **options):
    """Of a step that has to go well."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          **options)
    if done.returncode != 0:
        sys.stderr.write(done.stdout.decode(errors="replace")[-4000:])
        fail("\"%s\" failed with status %d; its last lines stand above."
             % (" ".join(str(word) for word in command[:4]), done.returncode))


def program_of(build, target):
    for folder in ("tests", "tests/hard"):
        if (build / folder / target).exists():
            return build / folder / target
    fail("the build made no %s; name a program of tests/ in tests/faults/faults.py." % target)


def test_status(source, build, target, arguments):
    scratch = build / "scratch"
    scratch.mkdir(exist_ok=True)
    environment = dict(os.environ, POCL_CACHE_DIR=str(build / "pocl-cache"), TILELIGHT_CACHE="",
                       TILELIGHT_SOURCE=str(source), TILELIGHT_SCRATCH=str(scratch),
                       TILELIGHT_PROGRAM=str(build / "tilelight"))
    try:
        return subprocess.run([program_of(build, target)] + arguments, env=environment, timeout=LONGEST,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    except subprocess.TimeoutExpired:
        return NOT_ENDED


def test_name(fault):
    return " ".join([fault.target] + fault.arguments)


def outcome(status, fault):
    """A fault may make its test run on; so may a machine that is busy: it is told."""
    how = {0: "MISSED by", NOT_ENDED: "not seen to pass in %d s by" % LONGEST}.get(status, "caught by")
    return how + " " + test_name(fault)


def check_that_tests_pass(source, build, faults):
    """A test that fails without a fault catches none. Each program once, with all that it is asked for."""
    for target in sorted({fault.target for fault in faults}):
        words = sorted({word for fault in faults if fault.target == target for word in fault.arguments})
        status = test_status(source, build, target, words)
        if status == SKIPPED:
            fail("%s is skipped here: it needs an OpenCL device." % target)
        if status != 0:
            fail("%s %s fails without any fault (status %d)." % (target, " ".join(words), status))


def planted(text, fault):
    count = text.count(fault.before)
    if count != 1:
        fail("fault %s no longer applies: its text stands %d times in %s, and must stand there once; move "
             "the fault in tests/faults/faults.py with the code." % (fault.name, count, fault.file))
    return text.replace(fault.before, fault.after)


def check_that_texts_stand(source, faults):
    for fault in faults:
        planted((source / fault.file).read_text(), fault)


def try_fault(source, build, fault):
    path = source / fault.file
    clean = path.read_text()
    path.write_text(planted(clean, fault))
    try:
        run(["cmake", "--build", build, "--target", fault.target])
        status = test_status(source, build, fault.target, fault.arguments)
    finally:
        path.write_text(clean)
    return status


def chosen(names):
    known = {fault.name: fault for fault in FAULTS}
    for name in names:
        if name not in known:
            fail("no fault is called \"%s\"; there are: %s." % (name, " ".join(known)))
    return [known[name] for name in names] if names else FAULTS


def main():
    if sys.argv[1:] == ["--check"]:
        check_that_texts_stand(ROOT, FAULTS)
        return
    copy, words = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    if words == ["--list"]:
        for fault in FAULTS:
            print("%-18s %-72s %s" % (fault.name, fault.what, test_name(fault)))
        return
    faults = chosen(words)
    source, build = copy / "source", copy / "build"
    copy_sources(source)
    check_that_texts_stand(source, faults)
    configure(source, build)
    run(["cmake", "--build", build, "--target"] + sorted({fault.target for fault in faults}))
    check_that_tests_pass(source, build, faults)
    missed = 0
    for fault in faults:
        start = time.monotonic()
        status = try_fault(source, build, fault)
        missed += status == 0
        print("%-18s %-72s %s (%.0f s)" % (fault.name, fault.what, outcome(status, fault),
                                           time.monotonic() - start), flush=True)
    print("%d of %d faults caught" % (len(faults) - missed, len(faults)))
    if missed:
        raise SystemExit(1)


main()
