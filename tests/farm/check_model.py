#!/usr/bin/env python3
"""Is the model of farms what can be added up by hand, where it can, and never better than its bounds?"""
import math
import pathlib
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from farm_model import gather, saturation, simulate

failures = []


def same(what, got, want):
    if not math.isclose(got, want, rel_tol=1e-9):
        failures.append(f"{what}: {got}, not {want}")


def at_least(what, got, least):
    if got < least * (1 - 1e-9):
        failures.append(f"{what}: {got} is below {least}")


same("one node", simulate(1, 100, 25, 2.0, 0.5), 4 * 2 + 100 * 0.5)
same("as many as chunks", simulate(4, 100, 25, 2.0, 0.5), 2 + 25 * 0.5)
same("more than chunks", simulate(99, 100, 25, 2.0, 0.5), 2 + 25 * 0.5)
same("a chunk that is short", simulate(1, 101, 25, 2.0, 0.5), 5 * 2 + 101 * 0.5)
same("chunks that do not fit", simulate(3, 100, 25, 2.0, 0.5), 2 * (2 + 25 * 0.5))
same("storage that is full", simulate(4, 100, 25, 2.0, 0.5, 10.0, 20.0), 2 + 100 * 10 / 20)
same("storage for half of them", simulate(2, 2, 1, 0.0, 1.0, 1.0, 1.0), 2.0)
same("storage in turns", simulate(1, 2, 1, 1.0, 1.0, 1.0, 0.5), 2 * (1 + 2))
same("no start", simulate(2, 10, 1, 0.0, 1.0), 5.0)
same("gather", gather(100, 2.0, 0.1), 12.0)
same("gather from storage", gather(100, 2.0, 0.1, 10.0, 20.0), 52.0)
same("full at", saturation(0.5, 2.0, 25, 10.0, 100.0), 100 * (2 + 12.5) / (10 * 25))

rng = random.Random(1)
for _ in range(300):
    nodes, frames, chunk = rng.randint(1, 40), rng.randint(1, 400), rng.randint(1, 40)
    start, frame, moved = rng.uniform(0, 5), rng.uniform(0.01, 2), rng.uniform(1, 50)
    bandwidth = rng.uniform(1, 500)
    got = simulate(nodes, frames, chunk, start, frame, moved, bandwidth)
    what = f"{nodes} nodes, {frames} frames by {chunk}"
    at_least(what, got, (math.ceil(frames / chunk) * start + frames * frame) / nodes)
    at_least(what, got, start + frames * moved / bandwidth)
    at_least(what, got, start + min(chunk, frames) * frame)
    at_least(what, got, simulate(nodes, frames, chunk, start, frame))

for failure in failures:
    print(failure, file=sys.stderr)
sys.exit(1 if failures else 0)
