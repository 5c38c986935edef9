#!/usr/bin/env python3
"""Draws settings at random from the JSON Schema of workflows and runs a small scene with them.

Every run has to end by itself with 0, 2, 3 or 4, or, told to stop after --seconds, with 130 within
five seconds of that. A draw depends on its seed and on the schema alone.

  fuzz_settings.py build/release/flowslide --draws 200 --seed 1
"""
import argparse
import collections
import json
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ALLOWED = {0, 2, 3, 4, 130}
MEMORY = 8 << 30  # of one run [bytes]

BLOCK = [["0 m", "0 m"], ["16 m", "0 m"], ["16 m", "3 m"], ["0 m", "6 m"]]
SOIL = {"youngs_modulus": "5 MPa", "poisson_ratio": 0.3, "cohesion": "2 kPa",
        "friction_angle": "30 deg"}
SCENE = {
    "schema": 1,
    "name": "small",
    "stages": {
        "mesh": {"uses": "mesh.section", "with": {
            "size": "2 m", "materials": {"soil": {"tag": 1}},
            "blocks": {"body": {"outline": BLOCK, "material": "soil"}}}},
        "motion": {"uses": "motion.prepare", "with": {
            "synthetic": {"pga": "0.2 g", "tm": "0.3 s", "d5_95": "1 s", "dt": "0.02 s",
                          "lead": "0 s"}}},
        "shake": {"uses": "fem.run",
                  "in": {"mesh": "mesh.mesh", "motion": "motion.motion"}, "with": {
            "materials": {"soil": {"density": "1900 kg/m3", "void_ratio": 0.8,
                                   "permeability": ["1e-6 m/s", "1e-6 m/s"], "mohr_coulomb": SOIL}},
            "base": {"motion": "within"}, "end": "0.2 s", "output_interval": "0.1 s"}},
        "zone": {"uses": "transfer.zone", "in": {"history": "shake.history"}, "with": {
            "when": "gravity", "zone": "all", "liquefiable": ["soil"], "windows": {},
            "pond_surface": "6 m",
            "strength": {"table": [["10 kPa", "1 kPa"], ["100 kPa", "5 kPa"]]}}},
        "map": {"uses": "transfer.map",
                "in": {"history": "shake.history", "zone": "zone.zone"}, "with": {
            "cell": "1 m", "c_soft_ratio": 0.5, "audit": {"enforce": False},
            "materials": {"soil": {"mohr_coulomb": SOIL,
                                   "liquefied": {"youngs_modulus": "5 MPa", "poisson_ratio": 0.45,
                                                 "residual_strain": 1.0}}}}},
        "flow": {"uses": "mpm.run", "in": {"particles": "map.particles"}, "with": {
            "cell": "1 m", "end": "0.5 s", "transfer": "aflip", "left_roller": "0 m",
            "ground": {"surface": [["0 m", "0 m"]]}, "frame_interval": "0.25 s",
            "sample_interval": "0.05 s",
            "softening": {"reference_length": "1.25 m"}}},
        "report": {"uses": "report.runout", "in": {
            "history": "shake.history", "zone": "zone.zone", "particles": "map.particles",
            "audit": "map.audit", "flow": "flow.history"},
            "with": {"figures": False}},
    },
}


def alternatives(schema):
    """A schema without what stands for a reference to another setting."""
    for choice in schema.get("anyOf", []):
        if "pattern" not in choice or not choice["pattern"].startswith(r"^\$"):
            return choice
    return schema


def number(rng, schema):
    """Within the bounds of the schema where it has any, over forty decades where not."""
    low = schema.get("minimum", schema.get("exclusiveMinimum"))
    high = schema.get("maximum", schema.get("exclusiveMaximum"))
    if rng.random() < 0.5 and low is not None and high is not None:
        return rng.choice([low, high, rng.uniform(low, high)])
    value = 10.0 ** rng.uniform(-20, 20) if rng.random() < 0.6 else 10.0 ** rng.uniform(-3, 3)
    if low is None and rng.random() < 0.3:
        value = -value
    value = rng.choice([value, value, value, 0.0, 1.0])
    return value if low is None or value >= low else low + value


def draw(rng, schema, depth=0):
    plain = alternatives(schema)
    if "enum" in plain:
        return rng.choice(plain["enum"])
    kind = plain.get("type")
    if isinstance(kind, list):  # lists and maps may be references too
        kind = kind[0]
    if kind == "boolean":
        return rng.random() < 0.5
    if kind == "integer":
        low, high = plain.get("minimum", -3), plain.get("maximum", 2**31 - 1)
        return int(rng.choice([low, high, rng.uniform(low, min(high, low + 20))]))
    if kind == "number":
        return number(rng, plain)
    if kind == "array":
        if "prefixItems" in plain:
            return [draw(rng, item, depth) for item in plain["prefixItems"]]
        count = rng.randint(plain.get("minItems", 0), plain.get("maxItems", 4))
        return [draw(rng, plain["items"], depth) for _ in range(count)]
    if kind == "object":
        if "properties" not in plain:
            entry = plain.get("additionalProperties", {})
            names = rng.sample(["soil", "a", "b"], rng.randint(0, 2))
            return {name: draw(rng, entry, depth + 1) for name in names}
        required = plain.get("required", [])
        return {key: draw(rng, value, depth + 1) for key, value in plain["properties"].items()
                if key in required or rng.random() < 0.5 ** (depth + 2)}
    if "pattern" in plain:  # a quantity: number and unit
        _, found, units = plain["pattern"].partition(" *(")
        units = units.split(")")[0].split("|") if found else ["%"]
        return f"{number(rng, plain):.6g} {rng.choice(units)}"
    return rng.choice(["soil", "base", "nothing", "1", "~", "a b"])


def places(schema, path=()):
    """Paths of all settings below an object's schema."""
    for key, value in schema.get("properties", {}).items():
        yield path + (key,), value
        yield from places(value, path + (key,))


def put(settings, path, value):
    for key in path[:-1]:
        if not isinstance(settings.get(key), dict):
            settings[key] = {}
        settings = settings[key]
    settings[path[-1]] = value


def draw_workflow(seed, schemas):
    rng = random.Random(seed)
    workflow = json.loads(json.dumps(SCENE))
    name = rng.choice(sorted(workflow["stages"]))
    stage = workflow["stages"][name]
    if name in ("mesh", "motion") and rng.random() < 0.5:
        name, stage = "flow", workflow["stages"]["flow"]
    schema = schemas[stage["uses"]]
    changed = []
    for path, what in rng.sample(sorted(places(schema), key=lambda p: p[0]), rng.randint(1, 3)):
        value = draw(rng, what, len(path))
        put(stage["with"], path, value)
        changed.append(f"{name}.{'.'.join(path)}={json.dumps(value)}")
    return workflow, "; ".join(changed)


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(program, workflow, folder, seconds):
    """Exit code, seconds it took, seconds from the signal to its end, standard error."""
    file = folder / "small.yaml"
    file.write_text(json.dumps(workflow, indent=1))
    begin, stopped = time.monotonic(), None
    with open(folder / "stderr", "w+") as errors:
        command = [program, "run", str(file), "--out", str(folder / "out"), "--threads", "1"]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors,
                                   preexec_fn=limit_memory)
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            stopped = time.monotonic()
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(15)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        end = time.monotonic()
        errors.seek(0)
        text = errors.read()
    return process.returncode, end - begin, end - stopped if stopped else 0.0, text


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--draws", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=45.0)
    parser.add_argument("--verbose", action="store_true")
    args = parser.parse_args()
    program = str(Path(args.program).resolve())
    text = subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout
    stages = json.loads(text)["properties"]["stages"]["additionalProperties"]["allOf"]
    properties = [stage["then"]["properties"] for stage in stages]
    schemas = {p["uses"]["const"]: p["with"] for p in properties}

    codes, failures, longest, slowest_stop = collections.Counter(), 0, 0.0, 0.0
    with tempfile.TemporaryDirectory(prefix="flowslide-fuzz-") as scratch:
        base = Path(scratch) / "base"
        base.mkdir()
        code, _, _, errors = run(program, SCENE, base, 60.0)
        if code != 0:  # the control: the scene itself runs
            sys.exit(f"the scene without changes ended with {code}:\n{errors}")
        for seed in range(args.seed, args.seed + args.draws):
            folder = Path(scratch) / str(seed)
            shutil.copytree(base, folder, symlinks=True)
            workflow, changed = draw_workflow(seed, schemas)
            code, took, to_stop, errors = run(program, workflow, folder, args.seconds)
            good = code in ALLOWED and to_stop < 5.0 and "internal error" not in errors
            codes[code] += 1
            longest, slowest_stop = max(longest, took), max(slowest_stop, to_stop)
            if args.verbose or not good:
                print(f"{'ok ' if good else 'BAD'} seed {seed}: code {code}, {took:.1f} s, "
                      f"{to_stop:.1f} s to stop; {changed[:400]}\n    {errors.strip()[-400:]}",
                      flush=True)
            failures += not good
            shutil.rmtree(folder)
    print(f"{args.draws} draws: codes {dict(sorted(codes.items()))}, longest {longest:.1f} s, "
          f"slowest stop {slowest_stop:.1f} s, {failures} bad")
    if codes[0] == 0 or codes[2] == 0:
        sys.exit("no draw ran, or none was refused: the draw is no longer one of settings")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
