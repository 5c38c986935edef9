"""What a command has left on the disk, and whether it may lie there."""

import hashlib
import json
import os
import re

# Wall times and what follows from them. Everything else has to be the same in every run.
TIMES = {"seconds", "modified_ns", "wall_s", "wall", "cached", "why", "fem_seconds",
         "flow_point_updates_per_s", "peak_memory_bytes"}
# Written anew in every run, so it may tell of an unfinished one.
ALWAYS = {"run.lock", ".flowslide.lock"}
# What a study tells of its rows and stages, failed ones too, written anew in every run.
SUMMARY = {"table.csv", "table.h5", "columns.csv", "analysis.json", "study.html"}

# Of the page of a study: when it was computed, and how long that took.
COST = re.compile(rb"<div class='wide'><table><tr><th class='word'>computed from.*?</table></div>")


def without_times(value):
    if isinstance(value, dict):
        if value.get("name") == "facts.json":
            return "facts.json"  # its checksum follows from the times in it
        return {k: without_times(v) for k, v in value.items() if k not in TIMES}
    if isinstance(value, list):
        return [without_times(v) for v in value]
    return value


def is_temporary(path):
    return any(part.endswith(".partial") for part in path.split("/"))


def content(path, root):
    """Of a file, in the same words wherever the worker's folder is."""
    with open(path, "rb") as file:
        raw = file.read()
    if path.endswith((".json", ".lock")):
        try:
            value = without_times(json.loads(raw))
            value.pop("sha256", None)  # of the text itself, with its times
            raw = json.dumps(value).encode()
        except (AttributeError, ValueError):
            pass
        raw = raw.replace(root.encode(), b"ROOT")
    if os.path.basename(path) == "study.html":
        raw = COST.sub(b"", raw)
    return hashlib.sha256(raw).hexdigest()


def snapshot(root, folders=("out", "made")):
    """{path: content}, with 'folder' and 'link to ...' for what is no file."""
    seen = {}
    for top in folders:
        for folder, names, files in os.walk(f"{root}/{top}"):
            for name in names + files:
                path = f"{folder}/{name}"
                key = os.path.relpath(path, root)
                if os.path.basename(folder) == "sessions" and not is_temporary(key):
                    # One for each time that the study ran, with its time as a name.
                    whole = "a whole session" if parses(path) else "a broken session"
                    seen[f"{os.path.dirname(key)}/SESSION.json"] = whole
                elif os.path.islink(path):
                    seen[key] = "link to " + os.readlink(path)
                elif name in names:
                    seen[key] = "folder"
                elif name == ".flowslide.lock":
                    seen[key] = "guard"
                else:
                    seen[key] = content(path, root)
    return seen


def is_summary(path):
    name = os.path.basename(path)
    return name in SUMMARY or name.endswith(".failed.json") or "figures" in path.split("/")


def incomplete(root, now, start, whole, rows_fail=False):
    """Names under which something lies that is neither what was there nor the whole of the result.
    With `rows_fail`, but for the summary of a study, which may tell of a failed row."""
    wrong = []
    for key, found in now.items():
        name = os.path.basename(key)
        # The session file goes after its result has its name; the record does not list it.
        if is_temporary(key) or found == "folder" or name == "session.json":
            continue
        if rows_fail and is_summary(key):
            continue
        if name in ALWAYS:
            if name == "run.lock" and not parses(f"{root}/{key}"):
                wrong.append(f"{key} is no JSON")
        elif found not in (start.get(key), whole.get(key)):
            wrong.append(f"{key} is neither old nor new" if key in whole else f"{key} is too much")
        elif found.startswith("link to ") and not os.path.exists(f"{root}/{key}"):
            wrong.append(f"{key} points to nothing")
    for key, made in whole.items():
        folder = os.path.dirname(key)
        result = f"{folder}/stage.json" in now or key.endswith("/stage.json")
        if result and not is_temporary(folder) and folder in now and key not in now:
            if key.endswith("/stage.json") and folder in start:
                continue  # an old result that was being removed; without its record it is none
            wrong.append(f"{key} is missing in a result")
    if any(k.startswith("made/") and k.endswith(".pvd") for k in now):
        wrong += [f"{k} is missing" for k in whole if k.startswith("made/") and k not in now]
    return wrong


def parses(path):
    try:
        with open(path) as file:
            json.load(file)
        return True
    except ValueError:
        return False


def differences(now, whole):
    """What a second, undisturbed run has not made good. Temporary names that nobody takes away are
    told apart from the rest: they harm nobody but the owner of the disk."""
    wrong = [f"{k} differs" if k in now else f"{k} is missing"
             for k, made in whole.items() if now.get(k) != made]
    wrong += [f"{k} is litter" if is_temporary(k) else f"{k} is too much"
              for k in now if k not in whole]
    return wrong
