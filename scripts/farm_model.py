"""A farm on paper: nodes take chunks of frames from a queue, and share one storage.

Times in seconds, sizes in bytes. A node has one worker at a time, which takes `start_s` before its first frame
and then `frame_s` for each, unless the storage is slower: what moves for a frame, `frame_bytes`, goes through at
`bandwidth` for all nodes together, in equal parts for all that are at frames. Reading, lighting and writing of a
node overlap, as they do in a batch, so the slower of both decides. Nodes are alike and none dies.
"""
import math


def simulate(nodes, frames, chunk, start_s, frame_s, frame_bytes=0.0, bandwidth=math.inf):
    """Seconds until the last chunk is done: from event to event, at rates that hold in between."""
    queue = [min(chunk, frames - first) for first in range(0, frames, chunk)][::-1]
    starting, lighting = {}, {}  # what is left: seconds, frames
    now = 0.0
    for node in range(min(nodes, len(queue))):
        starting[node] = start_s
    while starting or lighting:
        rate = 0.0
        if lighting:
            shared = bandwidth / (frame_bytes * len(lighting)) if frame_bytes else math.inf
            rate = min(1 / frame_s, shared)
        step = min([left for left in starting.values()] + [left / rate for left in lighting.values()])
        now += step
        starting = {node: left - step for node, left in starting.items()}
        lighting = {node: left - step * rate for node, left in lighting.items()}
        for node in [node for node, left in lighting.items() if left < 1e-9 * chunk]:
            del lighting[node]
            if queue:
                starting[node] = start_s
        for node in [node for node, left in starting.items() if left < 1e-12]:
            del starting[node]
            if queue:
                lighting[node] = queue.pop()
    return now


def gather(frames, start_s, check_s, input_bytes=0.0, bandwidth=math.inf):
    """Seconds of the run behind, on one node, which finds all of it done: it reads every input once more."""
    return start_s + frames * max(check_s, input_bytes / bandwidth)


def saturation(frame_s, start_s, chunk, frame_bytes, bandwidth):
    """How many nodes bring as much as the storage takes."""
    node_rate = chunk / (start_s + chunk * frame_s)
    return bandwidth / (frame_bytes * node_rate)
