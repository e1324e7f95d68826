#!/usr/bin/env python3
"""Does zsh complete a line, after Tab, to another? It is asked in a terminal, as nothing else completes.

    ask_zsh.py FOLDER LINE EXPECTED     FOLDER has _tilelight
"""
import os
import pty
import select
import sys
import time

FOLDER, LINE, EXPECTED = sys.argv[1:]
LONGEST = 20  # s


def read_until(fd, text):
    read, end = b"", time.time() + LONGEST
    while text not in read and time.time() < end:
        if select.select([fd], [], [], 0.2)[0]:
            read += os.read(fd, 65536)
    return read


process, fd = pty.fork()
if process == 0:
    os.environ.update(TERM="dumb", ZDOTDIR=FOLDER)
    os.execvp("zsh", ["zsh", "-f", "-i"])
# A key that prints the line that is edited, between marks that no echo of these commands holds.
os.write(fd, f"""PROMPT=''; fpath=({FOLDER} $fpath); autoload -U compinit; compinit -u -D
show() {{ print -rn -- "<""<$BUFFER>"">" }}; zle -N show; bindkey '^X' show; print rea""dy
""".encode())
read_until(fd, b"ready\r\n")
os.write(fd, LINE.encode() + b"\t\x18")
said = read_until(fd, b">>").decode()
os.write(fd, b"\x03exit\n")
os.close(fd)
line = said.rpartition("<<")[2].partition(">>")[0]
if line != EXPECTED:
    sys.exit(f"{LINE!r} becomes {line!r}, not {EXPECTED!r}")
