#!/usr/bin/env python3
"""A small study of the Mochikoshi dam from its motions to the page: dam_study.py FLOWSLIDE [PICTURES].

Killed three times and resumed it has the table of one that was not; a row that is added runs its own
stages only; a dam that stands is a row with a runout of 0 and not a failure; and the page says in a
browser what it should. With PICTURES, a folder, what the browser showed is left there.
"""
import csv
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/report"))
sys.dont_write_bytecode = True
from browser import Browser, find_chromium  # noqa: E402

STUDY = """schema: 1
name: dam
description: A dam on a coarse mesh.
study:
  workflow: %s
  set:
    stages.shake.with.end_with_motion: {arias: 0.9, after: 0.5 s}
    stages.mesh.with.size: 5 m
    stages.mesh.with.size_along_x: [[-340 m, 25 m], [-110 m, 6 m], [87.5 m, 6 m]]
    stages.flow.with.cell: 5 m
    stages.flow.with.end: 20 s
    # so coarse a grid of the flow cannot carry all of the energy
    stages.map.with.audit: {kinetic_energy: 0.05}
    stages.report.with.figures: false
    stages.report.with.paraview: false
  vary:
    pga: {setting: stages.motion.with.pga, values: [0.02 g, 0.4 g]}
    c_soft: {setting: stages.map.with.c_soft_ratio, values: [%s]}
  repeat: {count: 2, motion: 0, grid: true, rows: {pga: [0.4 g]}}
"""
MOTION = "    stages.motion.with.preset: loma-prieta-lick\n"
failures = []


def expect(what, true):
    print(f"{'ok' if true else 'FAILED'}: {what}", flush=True)
    if not true:
        failures.append(what)


def write_study(folder, strengths):
    text = STUDY % (ROOT / "workflows/mochikoshi.yaml", strengths)
    (folder / "dam.yaml").write_text(text.replace("  set:\n", "  set:\n" + MOTION), encoding="utf-8")


def command(program, folder, out, *more):
    return [program, "study", "run", str(folder / "dam.yaml"), "--out", str(folder / out), *more]


def finished(study):
    """What stages have found, and when it was written."""
    return {path: path.stat().st_mtime_ns for path in study.glob("stages/*/*.json")}


def run_with_kills(program, folder):
    """Ends the study three times by SIGKILL, when it has made some more stages; then lets it end."""
    dice, seen = random.Random(15), {}
    for _ in range(3):
        before = len(finished(folder / "killed"))
        process = subprocess.Popen(command(program, folder, "killed"), stdout=subprocess.DEVNULL)
        wanted = before + dice.randint(2, 5)
        while process.poll() is None and len(finished(folder / "killed")) < wanted:
            time.sleep(0.01)
        process.kill()
        process.wait()
        seen |= finished(folder / "killed")
    end = subprocess.run(command(program, folder, "killed"), stdout=subprocess.DEVNULL)
    expect("a study that was killed three times ends well", end.returncode == 0)
    now = finished(folder / "killed")
    expect(f"none of {len(seen)} stages that were done ran again of {len(now)}",
           len(seen) < len(now) and all(now.get(path) == at for path, at in seen.items()))


def rows_of(study):
    with open(study / "table.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_rows(study):
    rows = rows_of(study)
    still = [r for r in rows if float(r["pga [g]"]) == 0.02]
    expect("the weak motion has rows", len(still) == 2)
    expect("the dam stands: " + str({r["outcome"] for r in still}),
           all(r["outcome"] == "stood" and float(r["runout_m"]) == 0 for r in still))
    expect("and is handed over when the record ends",
           all(abs(float(r["transfer_time_s"]) - float(r["fem_end_s"])) < 0.15 for r in still))
    strong = [r for r in rows if float(r["pga [g]"]) == 0.4]
    expect("control: the strong one does not", all(r["outcome"] != "stood" for r in strong))
    expect("every row is done", all(r["state"] == "done" for r in rows))


def check_added(program, folder):
    before = {r["id"]: r for r in rows_of(folder / "killed")}
    seen = finished(folder / "killed")
    write_study(folder, "0.5, 0.75, 1")
    end = subprocess.run(command(program, folder, "killed"), stdout=subprocess.DEVNULL)
    expect("a study with rows added ends well", end.returncode == 0)
    new = [path for path in finished(folder / "killed") if path not in seen]
    kinds = sorted({path.parent.name for path in new})
    expect(f"they ran {kinds}", kinds == ["flow", "map", "report"] and len(new) == 9)
    after = {r["id"]: r for r in rows_of(folder / "killed")}
    place = lambda row: {k: v for k, v in row.items() if k != "row"}
    expect("the rows before are as they were",
           len(after) == len(before) + 3
           and all(place(after[i]) == place(row) for i, row in before.items()))


def check_page(study, pictures):
    program = find_chromium()
    if not program:
        print("no Chromium: the page is not looked at")
        return
    with Browser(program) as page:
        page.call("Page.navigate", url=(study / "study.html").as_uri())
        page.wait("document.readyState === 'complete'")
        text = page.run("document.body.innerText")
        for words in ("How far", "How sure", "Why", "What would change it", "Numerics alone move"):
            expect(f"the page says: {words}", words in text)
        expect("charts are drawn", page.run("document.querySelectorAll('figure svg').length") > 4)
        expect("each row has its run", page.run(
            "document.querySelectorAll('#rows a[target=left]').length") == len(rows_of(study)))
        for width in (1200, 390):
            page.call("Emulation.setDeviceMetricsOverride", width=width, height=1400,
                      deviceScaleFactor=1, mobile=False)
            expect(f"nothing is wider than a page of {width}", page.run(
                "document.documentElement.scrollWidth <= innerWidth"))
            if pictures:
                page.picture(pictures / f"study-{width}.png", whole=False)
        page.run("document.querySelector('#rows a[target=left]').click()")
        page.wait("frames['left'].length === 0 && document.querySelector('[name=left]')"
                  ".clientHeight > 100")
        expect(f"no word of trouble {page.said}", not page.said)


def write_whole(program, study):
    end = subprocess.run([program, "study", "report", str(study), "--whole"], capture_output=True,
                         text=True)
    expect("a file to send is written", end.returncode == 0)
    return " ".join(end.stdout.split()), " ".join(end.stderr.split())


def check_whole(program, folder, study):
    """All runs are in one file; one whose page has gone comes back as the guide says."""
    rows = len(rows_of(study))
    out, err = write_whole(program, study)
    expect(f"with all runs in it ({out.split(' (')[-1]}", f"the runs of {rows} of {rows} rows" in out)
    expect("and nothing to tell", "no run in it" not in err)
    gone = next(path for path in sorted((study / "stages/report").iterdir()) if path.is_dir())
    shutil.rmtree(gone)
    out, err = write_whole(program, study)
    expect("one without a page is told", f"the runs of {rows - 1} of {rows} rows" in out
           and f"1 of {rows} rows have no run in it because its page was not kept" in err)
    gone.with_suffix(".json").unlink()
    subprocess.run(command(program, folder, study.name), stdout=subprocess.DEVNULL)
    out, _ = write_whole(program, study)
    expect("and comes back as the guide says", f"the runs of {rows} of {rows} rows" in out)


def look_at_whole(study):
    program = find_chromium()
    if not program:
        return
    alone = study / "alone"
    alone.mkdir()
    (study / "study-whole.html").rename(alone / "study-whole.html")
    with Browser(program) as page:
        page.open(alone / "study-whole.html", 1280)
        page.run("document.querySelector('#rows a[target=left]').click()")
        page.wait_in("left", "location.protocol === 'about:' && document.documentElement.dataset.ready")
        expect("a run opens from the file alone", page.run_in(
            "left", "document.documentElement.dataset.ready") == "yes")
        expect(f"no word of trouble {page.said}", not page.said)


def main():
    program = sys.argv[1]
    pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_study(folder, "0.5, 1")
        whole = subprocess.run(command(program, folder, "whole"), stdout=subprocess.DEVNULL)
        expect("the study ends well", whole.returncode == 0)
        check_rows(folder / "whole")
        run_with_kills(program, folder)
        expect("its table is that of one that was not", (folder / "killed/table.csv").read_bytes()
               == (folder / "whole/table.csv").read_bytes())
        check_added(program, folder)
        check_page(folder / "killed", pictures)
        check_whole(program, folder, folder / "killed")
        look_at_whole(folder / "killed")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
