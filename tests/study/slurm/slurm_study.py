#!/usr/bin/env python3
"""Studies on a real Slurm of this machine: slurm_study.py FLOWSLIDE. Ends with 77 where there is none;
with FLOWSLIDE_SLURM=needed in the environment that is a failure.

A study that ran as job arrays has the table of one that the local pool ran, to the byte, although a
row of it fails and its folder has a name that a shell would take apart. A task that is cancelled, one
that loses its machine and one that comes to its time limit go on from their checkpoints, the same
command sends only what is missing, and no stage that was done runs again.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from cluster import CannotStart, Cluster, missing  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
SKIPPED = 77
STUDY = """schema: 1
name: tiny
study:
  workflow: %(root)s/workflows/mochikoshi-static.yaml
  set:
    stages.flow.with.cell: %(cell)s
    stages.flow.with.end: %(end)s
    stages.report.with.figures: false
    stages.report.with.paraview: false
  vary:
    c_soft: {setting: stages.map.with.c_soft_ratio, values: [%(values)s]}
    audit:
      setting: stages.map.with.audit
      values: [{enforce: false}%(more)s]
      labels: [%(labels)s]
  slurm: {partition: day, time: 20 min, cpus: %(cpus)s, chunk: 0.1 s, memory: 1 GB}
"""
failures = []


def expect(what, true):
    print(f"{'ok' if true else 'FAILED'}: {what}", flush=True)
    if not true:
        failures.append(what)
    return true


class Study:
    def __init__(self, cluster, program, folder, **settings):
        self.cluster, self.program, self.folder = cluster, program, folder
        folder.mkdir()
        (folder / "study.yaml").write_text(STUDY % ({"root": ROOT} | settings), encoding="utf-8")

    def run(self, out, *more):
        return subprocess.run(
            [self.program, "study", "run", "study.yaml", "--out", out, *more], cwd=self.folder,
            env=self.cluster.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def table(self, out):
        return (self.folder / out / "table.csv").read_bytes()

    def finished(self, out):
        """What stages have found, and when it was written."""
        return {path: path.stat().st_mtime_ns for path in (self.folder / out).glob("stages/*/*.json")
                if not path.name.endswith(".failed.json")}

    def logs(self, out):
        return "".join(f"--- {log}\n{log.read_text(errors='replace')}"
                       for log in sorted((self.folder / out).glob("slurm/*/*.log")))


def check_whole(cluster, program, folder):
    """Three arrays and a report; one of three audits is too strict for so coarse a grid."""
    out = "it's \"a\" study; $(touch harm)"
    study = Study(cluster, program, folder / "whole", cell="5 m", end="3 s", values="0.5, 0.75, 1",
                  more=", {stress: 1e-9}", labels="lenient, strict", cpus=2)
    local = study.run("local")
    expect("in the local pool some rows fail", local.returncode == 1)
    sent = study.run(out, "--executor", "slurm")
    if not expect("jobs are sent: " + sent.stdout, sent.returncode == 0):
        return
    expect("what rows share, rows, and the report", all(
        f"\n{name:<24} job " in sent.stdout for name in ("shared", "rows", "report")))
    again = study.run(out, "--executor", "slurm")
    expect("what waits or runs is not sent again: " + again.stdout.splitlines()[-1],
           again.returncode == 0 and "wait or run already" in again.stdout
           and "scripts" not in again.stdout)
    cluster.await_end()
    good = expect("the table is that of the local pool", (study.folder / out / "table.csv").exists()
                  and study.table(out) == study.table("local"))
    expect("the page is there", (study.folder / out / "study.html").exists())
    expect("nothing in a name is a command", not list(folder.rglob("harm")))
    seen = study.finished(out)
    end = study.run(out, "--executor", "slurm")
    expect("then the same command only tells what failed",
           end.returncode == 1 and "sent" not in end.stdout and "3 failed" in end.stdout)
    good &= expect("and computes nothing", study.finished(out) == seen)
    if not good:
        print(study.logs(out), end.stdout)


def await_flows(cluster, study, out, count):
    """So many runouts are under way."""
    cluster.await_(f"{count} runouts", lambda: len(list(
        (study.folder / out).glob("stages/flow/*.partial/frames*"))) + len(list(
            (study.folder / out).glob("stages/flow/*.partial/*/frames*"))) >= count)


def running_rows(cluster):
    return [f"{job}_{task}" for job, task, state, script in cluster.queue()
            if state == "R" and script.endswith("/rows.sbatch")]


def check_interrupted(cluster, program, folder):
    study = Study(cluster, program, folder / "cut", cell="2.5 m", end="12 s", values="0.5, 0.6, 0.7",
                  more="", labels="lenient", cpus=1)
    sent = study.run("cut", "--executor", "slurm")
    expect("jobs are sent", sent.returncode == 0)
    await_flows(cluster, study, "cut", 2)
    time.sleep(0.2)
    first, second = running_rows(cluster)[:2]
    # As Slurm does before the time limit; it begins again when its place in the queue comes.
    cluster.call("scancel", "--signal=USR1", "--batch", first)
    cluster.call("scancel", second)
    cluster.await_("the end of two tasks", lambda: not {first, second} & set(running_rows(cluster)))
    about = cluster.call("scontrol", "show", "job", first).stdout
    expect("a task that was warned goes back into the queue", "Restarts=1" in about)
    left = list((study.folder / "cut").glob("stages/flow/*.partial/checkpoint"))
    expect(f"{len(left)} checkpoints are left, one of each", len(left) >= 2)
    seen = study.finished("cut")
    again = study.run("cut", "--executor", "slurm")
    expect("the same command sends what was cancelled, and only that: " + again.stdout,
           again.returncode == 0 and re.search(r"\nrows +job \d+, 1 task\n", again.stdout)
           and "\n6 stages wait or run already: " in again.stdout)
    # The loss of a machine: all that run there go back too.
    cluster.await_("a running task", lambda: running_rows(cluster))
    cluster.call("scontrol", "update", f"node={cluster.host}", "state=down", "reason=test")
    cluster.await_end()
    local = study.run("local")
    expect("in the local pool all is done", local.returncode == 0)
    good = expect("the table is that of the local pool", study.table("cut") == study.table("local"))
    now = study.finished("cut")
    good &= expect(f"none of {len(seen)} stages that were done ran again of {len(now)}",
                   0 < len(seen) < len(now) and all(now.get(path) == at
                                                    for path, at in seen.items()))
    if not good:
        print(study.logs("cut"))


def check_messages(cluster, program, folder):
    study = Study(cluster, program, folder / "refused", cell="5 m", end="3 s", values="0.5", more="",
                  labels="lenient", cpus=1)
    file = study.folder / "study.yaml"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("partition: day", "partition: night"), encoding="utf-8")
    wrong = study.run("out", "--executor", "slurm")
    expect("a partition that is not there is told in the words of sbatch", wrong.returncode == 4
           and "invalid partition specified: night" in wrong.stdout)
    file.write_text(text.replace("memory: 1 GB", "memory: 1 TB"), encoding="utf-8")
    wrong = study.run("out", "--executor", "slurm")
    expect("and so is too much memory", wrong.returncode == 4 and "emory" in wrong.stdout)
    file.write_text(text, encoding="utf-8")
    wrong = study.run("at 50 %", "--executor", "slurm")
    expect("what Slurm would replace in a path is refused", wrong.returncode == 2
           and not (study.folder / "at 50 %" / "slurm").exists())
    environment, cluster.environment = cluster.environment, cluster.environment | {"PATH": "/none"}
    wrong = study.run("out", "--executor", "slurm")
    cluster.environment = environment
    expect("without the commands of Slurm that is told",
           wrong.returncode == 4 and "squeue: there is no such program" in wrong.stdout)
    expect("nothing waits", not cluster.queue())


def main():
    program = sys.argv[1]
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    needed = os.environ.get("FLOWSLIDE_SLURM") == "needed"
    if missing():
        print(f"{'FAILED' if needed else 'skipped'}: there is no {', '.join(missing())} (apt-get "
              "install slurmctld slurmd slurm-client munge)")
        sys.exit(1 if needed else SKIPPED)
    with tempfile.TemporaryDirectory(prefix="flowslide-slurm-") as name:
        folder = pathlib.Path(name)
        (folder / "slurm").mkdir()
        os.environ["XDG_CACHE_HOME"] = str(folder / "cache")
        try:
            with Cluster(folder / "slurm") as cluster:
                check_whole(cluster, program, folder)
                check_messages(cluster, program, folder)
                check_interrupted(cluster, program, folder)
        except CannotStart as e:
            print(f"{'FAILED' if needed else 'skipped'}: {e}")
            sys.exit(1 if needed else SKIPPED)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
