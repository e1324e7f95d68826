#!/usr/bin/env python3
"""Are the installed headers whole, each by itself, and is what they declare all that leaves the library?

    public_headers.py BUILD CC CXX LIBRARY SCRATCH
"""
import pathlib
import re
import shutil
import subprocess
import sys

BUILD, CC, CXX, LIBRARY, SCRATCH = sys.argv[1:]
STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only"]
PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs"


def output_of(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{command[0]}:\n{done.stdout}{done.stderr}")
    return done.stdout


def compile_each_alone(include, headers):
    """As C and as C++, with nothing else to be found."""
    for language, compiler, standard in (("c", CC, "c11"), ("cpp", CXX, "c++17")):
        sources = []
        for header in headers:
            sources.append(SCRATCH / f"{header.stem}.{language}")
            sources[-1].write_text(f"#include <tilelight/{header.name}>\nextern int something;\n")
        output_of(compiler, f"-std={standard}", *STRICT, "-I", include, *sources)


def declared(include, headers):
    """Functions as the compiler lists them; objects by the word extern."""
    source, listed = SCRATCH / "all.c", SCRATCH / "functions"
    source.write_text("".join(f"#include <tilelight/{header.name}>\n" for header in headers))
    output_of(CC, "-std=c11", "-fsyntax-only", "-aux-info", listed, "-I", include, source)
    names = set()
    for line in listed.read_text().splitlines():
        found = re.match(r"/\* (\S+?):\d+:\w+ \*/ extern .*?(\w+) \(", line)
        if found and pathlib.Path(found[1]).is_relative_to(include):
            names.add(found[2])
    for header in headers:
        text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.S)
        names |= set(re.findall(r"^extern [^\"({;]*?(\w+)(?:\[\w+\])*;", text, flags=re.M))
    return names


def leaving():
    lines = output_of("nm", "-D", "--defined-only", LIBRARY).splitlines()
    return {line.split()[2].split("@")[0] for line in lines if line.split()[1] != "A"}


def check_page():
    page = (PAGE / "library.md").read_text()
    for name in ("light.c", "CMakeLists.txt"):
        if (PAGE / "library" / name).read_text() not in page:
            sys.exit(f"docs/library.md: the text of docs/library/{name} is not on it")


SCRATCH = pathlib.Path(SCRATCH)
shutil.rmtree(SCRATCH, ignore_errors=True)
include = SCRATCH / "include"
output_of("cmake", "--install", BUILD, "--prefix", SCRATCH, "--component", "development")
headers = sorted((include / "tilelight").glob("*.h"))
compile_each_alone(include, headers)
wanted, found = declared(include, headers), leaving()
for name in sorted(wanted - found):
    print(name, "is declared, and does not leave the library")
for name in sorted(found - wanted):
    print(name, "leaves the library, and no public header declares it")
check_page()
print(len(headers), "headers,", len(found), "names")
sys.exit(0 if headers and found == wanted else 1)
