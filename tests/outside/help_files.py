#!/usr/bin/env python3
"""Has the manual every command and option of the program's help, and are they completed in bash, with the
words that the program takes?

    help_files.py PROGRAM FOLDER SCRATCH
"""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys

PROGRAM, FOLDER, SCRATCH = (pathlib.Path(path).resolve() for path in sys.argv[1:])
NONE = "no-such-word"
faults = []

ASK = """
compopt() { :; }
. "$1"
while read -ra COMP_WORDS; do
    [ "${COMP_WORDS[-1]}" != EMPTY ] || COMP_WORDS[-1]=
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _tilelight
    echo "${COMPREPLY[*]}"
done
"""


def run(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=SCRATCH)
    return done.stdout, done.stderr.split("\n")[0]


def completed(questions):
    """What bash completes of each, a set of words; the last word is EMPTY where nothing is typed yet."""
    done = subprocess.run(["bash", "-c", ASK, "bash", FOLDER / "tilelight.bash"], cwd=SCRATCH, text=True,
                          capture_output=True, input="".join(question + "\n" for question in questions))
    if done.stderr:
        faults.append("bash says: " + done.stderr)
    return [set(line.split()) for line in done.stdout.splitlines()]


def expect(what, wanted, found):
    for word in sorted(wanted - found):
        faults.append(f"{what}: {word} is missing")


def options_of(text):
    """Of a help as it is read: {option: what its argument is called, or None}."""
    found = {}
    for line in text.splitlines():
        if re.match(r" {2,6}-", line):
            head = re.split(r" {2,}", line.strip())[0]
            value = re.search(r"--[\w-]+\[?=(\S+)|^-\w (\S+)$", head)
            for option in re.findall(r"(?:^|, )(--[\w-]+|-.)", head):
                found[option] = (value[1] or value[2]) if value else None
    return found


def page_of(name):
    with gzip.open(FOLDER / "man1" / (name + ".1.gz"), "rt") as file:
        return file.read().replace("\\-", "-")


def check_page(name, words):
    page = page_of(name)
    expect(name + ".1", words, set(re.findall(r"\\fB(.+?)\\fR", page)))
    if shutil.which("groff"):
        said = subprocess.run(["groff", "-man", "-ww", "-z", "-Tutf8"], input=page, text=True,
                              capture_output=True)
        if said.stderr:
            faults.append(f"groff on {name}.1: {said.stderr}")


def refusal(command, option, words):
    """What the program says of an option with these words, one after the other; None: it takes them all."""
    said = run(command, *(f"{option}={word}" for word in words), "--stop-here")[1]
    return None if "unrecognized option" in said else said


def check_words(command, option, words):
    """Are the words that are completed those that the program takes of the ones that it tells?"""
    said = refusal(command, option, [NONE])
    told = said and re.search(rf'"{NONE}".*(?:; [\w ]+: | is none of | there are )(.+)$', said)
    others = set(told[1].split(", ")) - words if told else set()
    expect(f"{command} {option}=", {word for word in others if not refusal(command, option, [word])}, set())
    refused = words and refusal(command, option, sorted(words))
    if refused:
        faults.append(f"{command} {option}: a word is completed, and {refused}")
    return len(words)


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    listed = re.findall(r"^  ([a-z]+)\b(?!.*\(not in this build\))", run("--help")[0].split("\n\n")[1], re.M)
    helps = {command: run(command, "--help")[0] for command in listed}
    options = {command: options_of(text) for command, text in helps.items()}
    check_page("tilelight", {"tilelight " + command for command in listed})
    for command in listed:
        check_page("tilelight-" + command, set(options[command]))

    expect("commands", set(listed), completed(["tilelight EMPTY"])[0])
    for command, found in zip(listed, completed([f"tilelight {command} -" for command in listed])):
        expect(command, set(options[command]), {word.rstrip("=") for word in found})

    # Once for options that several commands share.
    asked = {}
    for command in listed:
        for option, value in options[command].items():
            if value and option.startswith("--"):
                asked.setdefault((option, value), (command, option))
    found = completed([f"tilelight {command} {option} = EMPTY" for command, option in asked.values()])
    count = sum(check_words(*question, words) for question, words in zip(asked.values(), found))
    print(*faults, sep="\n")
    print(len(listed), "commands,", sum(map(len, options.values())), "options,", count, "words")
    return 1 if faults or count < 50 else 0


sys.exit(main())
