#!/usr/bin/env python3
"""A study with what a page must bear, made of one that was measured: make_odd_study.py STUDY OUT

A second frame; errors of nothing, and such as are not known; times that are unstable, or missing; a map whose
file is gone; names of markup; claims; a knob, a cause and fields that no page has heard of.
"""
import json
import pathlib
import shutil
import sys


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    source, out = map(pathlib.Path, sys.argv[1:])
    shutil.copytree(source, out)
    study = json.loads((source / "study.json").read_text())
    study["frames"].append(json.loads(json.dumps(study["frames"][0])))
    study["frames"][1]["name"] = "again"
    study["when"] = "2031-02-03T04:05:06Z"
    study["knobs"].append({"name": "colour", "meaning": "new", "trades": "", "cause": "fashion",
                           "of_files": False, "usual": "grey", "exact": "grey", "words": "grey,red"})
    study["causes"].append({"name": "fashion", "meaning": "which no page has a colour for"})
    study["claims"] = [
        {"name": "tenth", "claim": "</script><b>a tenth is saved</b>", "source": "Somebody 2001",
         "method": "by looking", "figures": [
             {"what": "saved", "unit": "%", "theirs": [10, 20], "ours": 12.5, "low": 12, "high": 13.25},
             {"what": "by <b>others</b>", "unit": "", "theirs": None, "ours": 1e-5, "low": 1e-5,
              "high": 1e-5}]},
        {"name": "nothing", "figures": [{"what": "not known", "ours": None}]}]
    frame = study["frames"][0]
    frame["source"] = "</script><script>document.title = 'broken out'</script>"
    configs = frame["configurations"]
    for c in configs:
        c["knobs"]["colour"] = "grey"
    configs[1]["unstable"] = True
    configs[2]["times"]["light_ratio"]["unstable"] = True
    configs[3]["times"]["light_ratio"] = configs[3]["times"]["light_ms"] = None
    configs[4]["values"].update(error_rms=0, error_p999=0, error_max=0, flip=0, psnr=None)
    configs[5]["values"].update(flip=None, flip_max=None)
    configs[6]["knobs"]["colour"] = "red"
    configs[6]["main_cause"] = "fashion"
    with_maps = [c for c in configs if c["map"]]
    (out / with_maps[-1]["map"]).unlink()
    for key in ("map_errors", "intervals"):
        study.pop(key, None)
    for key in ("exposure", "planes", "lights"):
        del study["frames"][1][key]
    for frame in study["frames"]:
        set_fronts(study, frame)
    (out / "study.json").write_text(json.dumps(study, indent=1))


def set_fronts(study, frame):
    """What was changed has another front."""
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    import study_page
    for key, flag in (("light_ratio", "front_light"), ("job_ratio", "front_job")):
        front = study_page.front_of(study, frame, "error_rms", key)
        for i, config in enumerate(frame["configurations"]):
            config["values"][flag] = float(i in front)


main()
