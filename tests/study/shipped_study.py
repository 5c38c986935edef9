#!/usr/bin/env python3
"""The shipped study for a first look, as a user starts it: shipped_study.py FLOWSLIDE.

Every row ends; stronger shaking of one motion liquefies no less; a second start has nothing to do
and leaves the table as it is.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
failures = []


def expect(what, true):
    print(f"{'ok' if true else 'FAILED'}: {what}", flush=True)
    if not true:
        failures.append(what)


def run(program, out):
    start = time.monotonic()
    ended = subprocess.run([program, "study", "run", "workflows/mochikoshi-study-quick.yaml", "--out",
                            str(out)], cwd=ROOT, capture_output=True, text=True)
    return ended, time.monotonic() - start


def main():
    with tempfile.TemporaryDirectory() as name:
        out = pathlib.Path(name) / "quick"
        ended, seconds = run(sys.argv[1], out)
        print(f"{seconds:.0f} s")
        expect(f"it ends well: {ended.stderr[-300:]}", ended.returncode == 0)
        table = (out / "table.csv").read_bytes()
        rows = list(csv.DictReader(table.decode().splitlines()))
        expect("every row is done", rows and all(r["state"] == "done" for r in rows))
        depths = {(r["motion"], r["pga [g]"], r["c_soft"]): float(r["liquefaction_depth_pond_m"])
                  for r in rows if r["motion"]}
        pairs = [(depths[m, "0.3", c], depths[m, p, c]) for m, p, c in depths if p == "0.4"]
        expect(f"stronger shaking liquefies no less: {pairs}",
               len(pairs) == 4 and all(weak <= strong for weak, strong in pairs))
        expect("the static dam flows", any(float(r["runout_m"]) > 10 for r in rows
                                           if not r["motion"]))
        again, seconds_again = run(sys.argv[1], out)
        expect(f"again it has nothing to do, in {seconds_again:.1f} s",
               again.returncode == 0 and seconds_again < 0.2 * seconds)
        expect("and the table is the same", (out / "table.csv").read_bytes() == table)
    sys.exit(1 if failures else 0)


main()
