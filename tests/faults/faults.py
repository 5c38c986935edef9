#!/usr/bin/env python3
"""Makes one system call or request for memory after the other go wrong in short runs of the program.

    faults.py PROGRAM SHIM [--places | --full] [--scene NAME] [--action NAME] [--at N] [--jobs N]

After each: the exit code is that of files (4), nothing incomplete lies under a final name, and the
same command, undisturbed, ends with the bytes of a run that never was disturbed.

Of all calls from one place in the program (its innermost callers, whichever run they are in) the
first is taken with --places, and of these places every so manieth, a different one for each action,
without it: see STRIDES. --full takes every call of every run.
"""

import argparse
import collections
import glob
import json
import multiprocessing
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import scenes as scene_list
import tree

LIMIT = 60  # seconds that a run may take

CHANGING = "owcsnum"  # letters of calls that change the disk, see Call in faults.hpp
ACTIONS = {  # name: letter, kind, the calls it is made for
    "fail": ("f", "files", CHANGING),
    "misread": ("f", "files", "rl"),
    "full": ("F", "files", "owm"),
    "dead": ("d", "files", CHANGING + "rl"),
    "part": ("p", "files", "wr"),
    "interrupt": ("i", "files", "owsr"),
    "kill": ("k", "files", CHANGING),
    "torn": ("t", "files", "w"),
    "cut": ("c", "files", CHANGING),
    "cut names": ("C", "files", CHANGING),
    "stop": ("s", "files", CHANGING),
    "memory": ("f", "memory", None),
    "no memory": ("d", "memory", None),
}
# Every how manieth place is taken in a short run.
STRIDES = {"fail": 2, "misread": 4, "full": 8, "dead": 10, "part": 8, "interrupt": 12, "kill": 4,
           "torn": 2, "cut": 5, "cut names": 6, "stop": 12, "memory": 120, "no memory": 500}
KILLS = 24  # of the 120 of a scene that is only killed


class Program:
    """The program, waiting in the shim's server for jobs."""

    def __init__(self, program, shim):
        # No home: what one run learns of its cost would give the next one other calls.
        doubles = os.path.join(os.path.dirname(os.path.abspath(__file__)), "doubles")
        environment = dict(os.environ, LD_PRELOAD=shim, GOMP_SPINCOUNT="1000", LC_ALL="C",
                           PATH=f"{doubles}:{os.environ['PATH']}",
                           SOURCE_DATE_EPOCH="0", HOME="", XDG_CACHE_HOME="")
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        env=environment, text=True)

    def run(self, root, arguments, action="-", kind="files", number=0, clock=0.0):
        """(wait status as an exit code, negative for signals; fired; count; list), the list of
        files with letter and place of each call, of memory with the first call from each place."""
        job = [f"{root}.said", root, kind, action, number, clock, LIMIT, "flowslide", *arguments]
        self.process.stdin.write("\t".join(map(str, job)) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            raise RuntimeError("the shim's server has ended")
        status, fired, count, calls = answer.rstrip("\n").split("\t")
        return (os.waitstatus_to_exitcode(int(status)), fired == "1", int(count),
                [tuple(c.split(":")) for c in calls.split()])


class Worker:
    """A folder of its own with the states from which scenes start."""

    def __init__(self, options, folder, fine=False):
        self.options, self.folder, self.root = options, folder, f"{folder}/root"
        self.program = Program(options.program, options.shim)
        os.makedirs(self.root, exist_ok=True)
        scene_list.write_inputs(f"{self.root}/in", fine)
        if not options.control:
            self.call(scene_list.run_command("shake", "texts"))
            shutil.copytree(glob.glob(f"{self.root}/texts/stages/shake/*/recorders")[0],
                            f"{self.root}/in/recorders")
            shutil.rmtree(f"{self.root}/texts")
        os.makedirs(f"{self.root}/made")
        shutil.copytree(self.root, f"{folder}/start")

    def call(self, command):
        code, *_ = self.program.run(self.root, [w.replace("ROOT", self.root) for w in command])
        if code != 0:
            raise RuntimeError(f"{command} ended with {code}: {self.said()}")

    def said(self):
        with open(f"{self.root}.said", errors="replace") as file:
            return file.read()[-2000:]

    def job(self, stage):
        """The command that makes a stage of a finished study, which goes, again."""
        place = f"{self.root}/out/stages/{stage}"
        with open(glob.glob(f"{place}/*.json")[0]) as file:
            key = json.load(file)["record"]["key"]
        with open(f"{self.root}/out/study.json") as file:
            row = json.load(file)["rows"][0]
        shutil.rmtree(place)
        return ["study", "stage", json.dumps({
            "store": f"{self.root}/out", "workflow": row["workflow"], "set": row["set"],
            "stage": stage, "key": key, "threads": 1, "final_state": True, "allow": []})]

    def command(self, scene):
        if scene.stage:
            return self.job(scene.stage)
        words = [w.replace("ROOT", self.root) for w in scene.command]
        for i, word in enumerate(words):
            if word.startswith("FIND/"):
                name = word[5:]
                pattern = name if "/" in name else f"*/*/{name}"
                words[i] = glob.glob(f"{self.root}/out/stages/{pattern}")[0]
        return words

    def prepare(self, scene):
        """Makes the state from which a scene starts, and the undisturbed run."""
        self.restore(f"{self.folder}/start")
        for command in scene.before:
            self.call(command)
        command = self.command(scene)
        if scene.damage:
            path = glob.glob(f"{self.root}/out/stages/*/*/{scene.damage}")[0]
            with open(path, "r+b") as file:
                file.seek(-100, os.SEEK_END)
                byte = file.read(1)
                file.seek(-100, os.SEEK_END)
                file.write(bytes([byte[0] ^ 1]))
        if scene.continued:
            self.stop_half_way(command, scene.clock)
        state = f"{self.folder}/{scene.name}"
        shutil.copytree(self.root, state, symlinks=True)
        start = tree.snapshot(self.root)
        code, *_ = self.program.run(self.root, command, clock=scene.clock)
        if code != 0:
            raise RuntimeError(f"{scene.name} ended with {code}: {self.said()}")
        return state, command, start, tree.snapshot(self.root)

    def survey(self, scene):
        """Calls and requests for memory of an undisturbed run, see Program.run()."""
        state, command, *_ = self.prepare(scene)
        seen = {}
        for kind in ("files", "memory"):
            self.restore(state)
            seen[kind] = self.program.run(self.root, command, kind=kind, clock=scene.clock)[3]
        shutil.rmtree(state)
        return seen

    def stop_half_way(self, command, clock):
        """SIGTERM at the first call of a row after which the run leaves a checkpoint."""
        state = f"{self.folder}/before"
        shutil.copytree(self.root, state, symlinks=True)
        count = self.program.run(self.root, command, clock=clock)[2]
        for number in range(count // 4, count, max(1, count // 20)):
            self.restore(state)
            code, *_ = self.program.run(self.root, command, "s", number=number, clock=clock)
            if code == 130 and glob.glob(f"{self.root}/out/stages/*/*.partial/checkpoint"):
                shutil.rmtree(state)
                return
        raise RuntimeError(f"{command} leaves no checkpoint wherever it is stopped")

    def restore(self, state):
        """The folder itself stays; it may be a disk of its own."""
        for entry in os.scandir(self.root):
            if entry.is_dir(follow_symlinks=False):
                shutil.rmtree(entry.path)
            else:
                os.remove(entry.path)
        shutil.copytree(state, self.root, symlinks=True, dirs_exist_ok=True)

    def inject(self, scene, prepared, name, number):
        """Problems after a fault at one point, and what the run said; None if it had no such call."""
        state, command, start, whole = prepared
        self.restore(state)
        letter, kind, _ = ACTIONS[name]
        code, fired, *_ = self.program.run(self.root, command, letter, kind, number, scene.clock)
        said = self.said()
        if not fired:
            return None
        now = tree.snapshot(self.root)
        problems = []
        killed = name in ("kill", "torn", "cut", "cut names")
        # Before the first stage nobody has asked for the signal yet.
        stopped = {0, 4, 130, -signal.SIGTERM}
        allowed = {-signal.SIGKILL, 0} if killed else stopped if name == "stop" else {0, 4}
        allowed |= set(scene.codes)
        if code not in allowed:
            problems.append(f"ends with {code}: {said.strip().splitlines()[-1:]}")
        if code == 0 and (wrong := tree.differences(now, whole)):
            problems.append(f"ends with 0, but {wrong[0]}")
        if code not in scene.codes:  # a study of which a row failed is complete, but another one
            wrong = tree.incomplete(self.root, now, start, whole, bool(scene.codes))
            problems += [f"leaves: {w}" for w in wrong[:2]]
        code, *_ = self.program.run(self.root, command)
        if code != 0:
            problems.append(f"again: ends with {code}: {self.said().strip().splitlines()[-1:]}")
        else:
            wrong = tree.differences(tree.snapshot(self.root), whole)
            problems += [f"again: {w}" for w in wrong[:2]]
        return problems, said


def choose(options, scenes, surveys):
    """Numbers of the calls that go wrong, by scene and action."""
    taken, chosen = set(), {}
    for scene, seen in zip(scenes, surveys):
        new = {kind: first_of_places(calls, taken) for kind, calls in seen.items()}
        for name in options.action or ACTIONS:
            kind, letters = ACTIONS[name][1:]
            calls = seen[kind]
            numbers = range(1, len(calls) + 1) if options.full else new[kind]
            if kind == "memory":
                numbers = [int(calls[n - 1][0]) for n in numbers]
            else:
                numbers = [n for n in numbers if calls[n - 1][0] in letters]
            if scene.kills_only:
                numbers = chosen_kills(calls) if name == "kill" else []
            elif name.startswith("cut"):
                numbers.append(len(calls) + 1)  # after the end
            if not (options.full or options.places):
                # Strides start anywhere, so that they do not keep step with a pattern of the calls.
                stride = 120 // KILLS if scene.kills_only else STRIDES[name]
                numbers = numbers[random.Random(scene.name + name).randrange(stride)::stride]
            chosen[scene.name, name] = options.at or numbers
    return chosen


def first_of_places(calls, taken):
    """Numbers, from 1, of the calls from places that no run before has come by."""
    numbers = []
    for n, (what, place) in enumerate(calls, 1):
        key = (what if what.isalpha() else "memory", place)
        if key not in taken:
            taken.add(key)
            numbers.append(n)
    return numbers


def chosen_kills(calls):
    """100 calls at random, 10 renames and what comes after them."""
    draw = random.Random(11)
    renames = [i + 1 for i, c in enumerate(calls) if c[0] == "n"]
    chosen = sorted(draw.sample(renames, 10))
    return draw.sample(range(1, len(calls) + 1), 100) + chosen + [n + 1 for n in chosen]


worker = None


def start_worker(options, folder):
    global worker
    worker = Worker(options, f"{folder}/{os.getpid()}")


def survey(scene):
    return worker.survey(scene)


def work(task):
    """A share of the points of a scene: a list of (scene, action, call, number, problems)."""
    options, scene, seen, share = task
    prepared = worker.prepare(scene)
    done = []
    for name, number in share:
        outcome = worker.inject(scene, prepared, name, number)
        if outcome is None:
            continue
        problems, said = outcome
        calls = seen if ACTIONS[name][1] == "files" else ""
        call = calls[number - 1:number] if calls else "a"
        done.append((scene.name, name, call, number, problems))
        if options.at:
            print(f"{scene.name}, {name} at {number} ({call}): {problems or 'passed'}\n{said}")
    shutil.rmtree(prepared[0])
    return done


def run_all(options, folder):
    scenes = [scene_list.CONTROL] if options.control else scene_list.scenes()
    scenes = [s for s in scenes if not options.scene or s.name in options.scene]
    done = []
    with multiprocessing.Pool(options.jobs, start_worker, (options, folder)) as pool:
        surveys = pool.map(survey, scenes, chunksize=1)
        chosen = choose(options, scenes, surveys)
        tasks = []
        for scene, seen in zip(scenes, surveys):
            points = [(name, n) for (s, name), numbers in chosen.items() if s == scene.name
                      for n in numbers]
            letters = "".join(what for what, _ in seen["files"])
            tasks += [(options, scene, letters, points[i::options.jobs])
                      for i in range(options.jobs) if points[i::options.jobs]]
        for share in pool.imap_unordered(work, tasks):
            report_failures(share)
            done += share
    return done


def report_failures(done):
    groups = collections.defaultdict(list)
    for scene, name, call, number, problems in done:
        for problem in problems:
            groups[scene, name, call, problem].append(number)
    for (scene, name, call, problem), numbers in sorted(groups.items()):
        more = f" and {len(numbers) - 5} more" if len(numbers) > 5 else ""
        print(f"FAILED {scene}, {name}, call '{call}' at {numbers[:5]}{more}: {problem}",
              flush=True)


def report(done):
    table = collections.defaultdict(lambda: [0, 0])
    for scene, name, _, _, problems in done:
        table[scene, name][0] += 1
        table[scene, name][1] += not problems
    names = [n for n in ACTIONS if any(key[1] == n for key in table)]
    print("| " + " | ".join(["scene", *names]) + " |\n|" + "---|" * (len(names) + 1))
    for scene in dict.fromkeys(key[0] for key in table):
        row = [table.get((scene, n), [0, 0]) for n in names]
        print("| " + " | ".join([scene] + [f"{good}/{all_}" for all_, good in row]) + " |")
    passed = sum(not d[4] for d in done)
    print(f"{len(done)} injection points, {passed} passed")
    return passed == len(done)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("shim")
    parser.add_argument("--places", action="store_true", help="the first call from every place")
    parser.add_argument("--full", action="store_true", help="every call of every run")
    parser.add_argument("--scene", action="append")
    parser.add_argument("--action", action="append", choices=ACTIONS)
    parser.add_argument("--at", type=int, action="append", help="only these calls")
    parser.add_argument("--control", action="store_true", help="PROGRAM is the careless one")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    options = parser.parse_args()
    options.program, options.shim = map(os.path.abspath, (options.program, options.shim))
    if options.at:
        options.jobs = 1
    begin = time.time()
    # Memory in place of a disk, if there is any: syncing costs nothing there.
    place = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    with tempfile.TemporaryDirectory(prefix="flowslide-faults-", dir=place) as folder:
        good = report(run_all(options, folder))
    print(f"{time.time() - begin:.0f} s")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
