#!/usr/bin/env python3
"""Is a file a job template of Open Job Description, jobtemplate-2023-09, without extensions?

    check_job_template.py FILE          says what is wrong with it; status 1 if anything is
    check_job_template.py --run FILE    also runs its steps here, task by task, as a worker would
    check_job_template.py --plant FILE  also plants faults in it, each of which the check has to find

Written from the specification's text ("Template Schemas [Version: 2023-09]"; sections in brackets), for the
parts of it that templates of tilelight have; anything else in a template is an error here.
"""
import copy
import json
import re
import subprocess
import sys
import unicodedata

IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,63}\Z")  # 7.1
AMOUNT = re.compile(r"([A-Za-z_]\w*:)?amount(\.[A-Za-z_]\w*)+\Z")  # 3.3.1.1
KNOWN_AMOUNTS = {"vcpu": 1, "memory": 0, "gpu": 0, "gpu.memory": 0, "disk.scratch": 0}
REFERENCE = re.compile(r"\{\{\s*([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*)\s*\}\}")  # 7.3


class Check:
    def __init__(self):
        self.faults = []

    def fault(self, where, what):
        self.faults.append(f"{where}: {what}")

    def keys(self, where, value, required, optional=()):
        """An object with these keys and no others."""
        if not isinstance(value, dict):
            self.fault(where, "is no object")
            return False
        for key in required:
            if key not in value:
                self.fault(where, f"has no {key}")
        for key in value:
            if key not in required and key not in optional:
                self.fault(where, f"has {key}, which it cannot have")
        return all(key in value for key in required)

    def items(self, where, value, least, most):
        if not isinstance(value, list) or not least <= len(value) <= most:
            self.fault(where, f"is no list of {least} to {most}")
            return []
        return value

    def text(self, where, value, least, most, but="", controls=False):
        """A string of so many characters, without those of category Cc except those of `but`."""
        if not isinstance(value, str) or not least <= len(value) <= most:
            self.fault(where, f"is no string of {least} to {most} characters")
            return False
        if not controls and any(unicodedata.category(c) == "Cc" and c not in but for c in value):
            self.fault(where, "has control characters")
        return True

    def whole(self, where, value, least):
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            self.fault(where, f"is no whole number from {least}")

    def format_string(self, where, value, names):
        """7.3: two braces open a reference to one of `names`; no others may stand there."""
        for name in REFERENCE.findall(value):
            if name not in names:
                self.fault(where, f"refers to {name}, which is not known there")
        rest = REFERENCE.sub("", value)
        if "{{" in rest or "}}" in rest:
            self.fault(where, "has two braces that are no reference")


def check_parameter(check, where, parameter):
    kinds = {"STRING": (), "PATH": ("objectType", "dataFlow")}  # 2.1, 2.2
    if not check.keys(where, parameter, ("name", "type"),
                      ("description", "default", "objectType", "dataFlow")):
        return
    if parameter["type"] not in kinds:
        check.fault(where, f"is of type {parameter['type']}")
        return
    for key, values in (("objectType", ("FILE", "DIRECTORY")),
                        ("dataFlow", ("NONE", "IN", "OUT", "INOUT"))):
        if key in parameter and key not in kinds[parameter["type"]]:
            check.fault(where, f"has {key}, which its type cannot have")
        elif key in parameter and parameter[key] not in values:
            check.fault(f"{where} {key}", f"is {parameter[key]}")
    if not isinstance(parameter["name"], str) or not IDENTIFIER.match(parameter["name"]):
        check.fault(where, "has a name that is no identifier")
    if "default" in parameter:
        check.text(f"{where} default", parameter["default"], 0, 1024, controls=True)  # 2.5
    if "description" in parameter:
        check.text(f"{where} description", parameter["description"], 1, 2048, "\n\r\t")


def check_space(check, where, space):
    """3.4; the names of its parameters."""
    names = []
    if not check.keys(where, space, ("taskParameterDefinitions",)):
        return names
    definitions = space["taskParameterDefinitions"]
    for number, definition in enumerate(check.items(where, definitions, 1, 16)):
        here = f"{where} {number}"
        if not check.keys(here, definition, ("name", "type", "range")):
            continue
        if definition["type"] != "STRING":  # 3.4.1.3
            check.fault(here, f"is of type {definition['type']}")
        if not isinstance(definition["name"], str) or not IDENTIFIER.match(definition["name"]):
            check.fault(here, "has a name that is no identifier")
        names.append(definition["name"])
        for value in check.items(f"{here} range", definition["range"], 1, 1024):
            if check.text(f"{here} range", value, 1, 1024, controls=True):
                check.format_string(f"{here} range", value, ())
    if len(set(names)) < len(names):
        check.fault(where, "has two parameters of one name")
    return names


def check_requirements(check, where, requirements):
    if not check.keys(where, requirements, ("amounts",)):
        return
    names = []
    for amount in check.items(where, requirements["amounts"], 1, 50):
        if not check.keys(where, amount, ("name", "min")):
            continue
        name = amount["name"]
        names.append(str(name).lower())
        if not isinstance(name, str) or len(name) > 100 or not AMOUNT.match(name):
            check.fault(where, f"{name} is no capability")
        elif name.startswith("amount.worker."):
            if name[14:] not in KNOWN_AMOUNTS:
                check.fault(where, f"{name} is reserved, and unknown")
            check.whole(f"{where} {name}", amount["min"], KNOWN_AMOUNTS.get(name[14:], 0))
    if len(set(names)) < len(names):
        check.fault(where, "has an amount twice")


def check_script(check, where, script, names):
    """3.5 and 5."""
    if not check.keys(where, script, ("actions",)) or not check.keys(
            where, script["actions"], ("onRun",)):
        return
    action = script["actions"]["onRun"]
    if not check.keys(where, action, ("command",), ("args", "timeout", "cancelation")):
        return
    words = [(f"{where} command", action["command"], 1)]
    words += [(f"{where} args", word, 0) for word in action.get("args", [])]
    for here, word, least in words:
        if check.text(here, word, least, sys.maxsize):
            check.format_string(here, word, names)
    if "cancelation" in action and action["cancelation"] != {"mode": "NOTIFY_THEN_TERMINATE"}:  # 5.3.2
        check.fault(f"{where} cancelation", f"is {action['cancelation']}")
    if "timeout" in action:
        check.whole(f"{where} timeout", action["timeout"], 1)


def check_step(check, where, step, parameters):
    if not check.keys(where, step, ("name", "script"),
                      ("description", "dependencies", "hostRequirements", "parameterSpace")):
        return
    check.text(f"{where} name", step["name"], 1, 64)  # 3.1
    names = {f"{kind}.{name}" for kind in ("Param", "RawParam") for name in parameters}
    names.add("Session.WorkingDirectory")
    if "description" in step:
        check.text(f"{where} description", step["description"], 1, 2048, "\n\r\t")
    if "parameterSpace" in step:
        for name in check_space(check, f"{where} parameterSpace", step["parameterSpace"]):
            names |= {f"Task.Param.{name}", f"Task.RawParam.{name}"}
    if "hostRequirements" in step:
        check_requirements(check, f"{where} hostRequirements", step["hostRequirements"])
    check_script(check, f"{where} script", step["script"], names)


def check_dependencies(check, steps):
    """3.2: on steps of the job, and not in a circle."""
    names = [step.get("name") for step in steps]
    if len(set(names)) < len(names):
        check.fault("steps", "two have one name")
    on = {}
    for step in steps:
        where = f"step {step.get('name')} dependencies"
        entries = step.get("dependencies", [])
        if "dependencies" in step:
            entries = check.items(where, entries, 1, sys.maxsize)
        on[step.get("name")] = [entry.get("dependsOn") for entry in entries
                                if check.keys(where, entry, ("dependsOn",))]
        for name in on[step.get("name")]:
            if name not in names:
                check.fault(where, f"there is no step {name}")
    done = set()
    while True:
        ready = [name for name in on if name not in done and set(on[name]) & set(on) <= done]
        if not ready:
            break
        done.update(ready)
    if len(done) < len(on):
        check.fault("steps", "depend on each other in a circle")


def faults_of(template):
    check = Check()
    if not check.keys("the template", template, ("specificationVersion", "name", "steps"),
                      ("description", "parameterDefinitions")):
        return check.faults
    if template["specificationVersion"] != "jobtemplate-2023-09":
        check.fault("specificationVersion", f"is {template['specificationVersion']}")
    parameters = []
    for number, parameter in enumerate(
            check.items("parameterDefinitions", template.get("parameterDefinitions", [None]), 1, 50)):
        if parameter is not None:
            check_parameter(check, f"parameter {number}", parameter)
            parameters.append(parameter.get("name"))
    if len(set(parameters)) < len(parameters):
        check.fault("parameterDefinitions", "two have one name")
    if check.text("name", template["name"], 1, 128):
        check.format_string("name", template["name"], ())
    if "description" in template:
        check.text("description", template["description"], 1, 2048, "\n\r\t")
    steps = check.items("steps", template["steps"], 1, sys.maxsize)
    for number, step in enumerate(steps):
        check_step(check, f"step {number}", step, parameters)
    if all(isinstance(step, dict) for step in steps):
        check_dependencies(check, steps)
    return check.faults


def run(template):
    """Every task of every step, in order; the highest status."""
    values = {f"Param.{p['name']}": p["default"] for p in template.get("parameterDefinitions", [])}
    highest = 0
    for step in template["steps"]:
        definitions = step.get("parameterSpace", {}).get("taskParameterDefinitions", [])
        tasks = [{f"Task.Param.{d['name']}": value} for d in definitions for value in d["range"]]
        for task in tasks or [{}]:
            known = {**values, **task}
            action = step["script"]["actions"]["onRun"]
            words = [REFERENCE.sub(lambda m: known[m.group(1)], word)
                     for word in [action["command"], *action.get("args", [])]]
            highest = max(highest, subprocess.run(words, check=False).returncode)
    return highest


# Each changes a good template so that it is one no more.
def light(template):
    return template["steps"][0]


def set_at(*path):
    *path, value = path

    def plant(template):
        place = template
        for key in path[:-1]:
            place = place[key]
        place[path[-1]] = value
    return plant


ACTION = ("steps", 0, "script", "actions", "onRun")
SPACE = ("steps", 0, "parameterSpace", "taskParameterDefinitions", 0)
PLANTS = {
    "another version": set_at("specificationVersion", "jobtemplate-2024-01"),
    "no name": lambda t: t.pop("name"),
    "a key of none": set_at("priority", 50),
    "a name of two lines": set_at("name", "a\nb"),
    "a long name": set_at("name", "a" * 129),
    "a bell in the description": set_at("description", "\a"),
    "a long description": set_at("description", "a" * 2049),
    "no step": set_at("steps", []),
    "a step without a script": lambda t: light(t).pop("script"),
    "a script of a later version": set_at("steps", 0, "script", {"bash": {"script": "true"}}),
    "two steps of one name": set_at("steps", 1, "name", "Light"),
    "a step that is not there": set_at("steps", 1, "dependencies", 0, "dependsOn", "Lights"),
    "a circle": set_at("steps", 0, "dependencies", [{"dependsOn": "Gather"}]),
    "no dependency in the list": set_at("steps", 1, "dependencies", []),
    "an argument that is a number": lambda t: light(t)["script"]["actions"]["onRun"]["args"].append(1),
    "an argument of two lines": lambda t: light(t)["script"]["actions"]["onRun"]["args"].append("a\nb"),
    "an unknown parameter": lambda t: light(t)["script"]["actions"]["onRun"]["args"].append("{{Param.No}}"),
    "a chunk outside its step": lambda t: t["steps"][1]["script"]["actions"]["onRun"]["args"].append(
        "{{Task.Param.Chunk}}"),
    "braces that open": lambda t: light(t)["script"]["actions"]["onRun"]["args"].append("a{{b"),
    "braces that close": lambda t: light(t)["script"]["actions"]["onRun"]["args"].append("a}}b"),
    "an expression": lambda t: light(t)["script"]["actions"]["onRun"]["args"].append("{{1 + 1}}"),
    "an empty command": set_at(*ACTION, "command", ""),
    "no time": set_at(*ACTION, "timeout", 0),
    "an end of no kind": set_at(*ACTION, "cancelation", {"mode": "NOTIFY"}),
    "time as a string": set_at(*ACTION, "timeout", "60"),
    "too many chunks": set_at(*SPACE, "range", ["1"] * 1025),
    "no chunk": set_at(*SPACE, "range", []),
    "a long chunk": set_at(*SPACE, "range", ["1" * 1025]),
    "a chunk of a kind of an extension": set_at(*SPACE, "type", "CHUNK[INT]"),
    "a parameter called as none may be": set_at("parameterDefinitions", 0, "name", "1st"),
    "a parameter of no type": set_at("parameterDefinitions", 0, "type", "FOLDER"),
    "a flow of a string": set_at("parameterDefinitions", 1, "dataFlow", "IN"),
    "a flow that is none": set_at("parameterDefinitions", 0, "dataFlow", "BOTH"),
    "a long value": set_at("parameterDefinitions", 0, "default", "a" * 1025),
    "two parameters of one name": set_at("parameterDefinitions", 1, "name", "Folder"),
    "a capability that is none": set_at("steps", 0, "hostRequirements",
                                        {"amounts": [{"name": "amount.worker.cores", "min": 1}]}),
    "memory as text": set_at("steps", 0, "hostRequirements",
                             {"amounts": [{"name": "amount.worker.memory", "min": "4G"}]}),
    "a requirement of nothing": set_at("steps", 0, "hostRequirements", {"amounts": []}),
}


def plant_all(template):
    missed = 0
    for name, plant in PLANTS.items():
        planted = copy.deepcopy(template)
        plant(planted)
        if not faults_of(planted):
            print(f"not found: {name}", file=sys.stderr)
            missed += 1
    print(f"{len(PLANTS) - missed} of {len(PLANTS)} planted faults found")
    return missed


def main():
    *how, path = sys.argv[1:]
    with open(path, encoding="utf-8") as file:
        template = json.load(file)
    faults = faults_of(template)
    for fault in faults:
        print(fault, file=sys.stderr)
    if faults:
        return 1
    if how == ["--plant"]:
        return 1 if plant_all(template) else 0
    return run(template) if how == ["--run"] else 0


if __name__ == "__main__":
    sys.exit(main())
