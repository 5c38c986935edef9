#!/usr/bin/env python3
"""Runs every stage on disks of 82 sizes around what it needs. Needs the right to mount (root).

    disk_sizes.py PROGRAM SHIM

A disk too small ends the command with 4 and nothing incomplete under a final name; with room made,
the same command then ends with the bytes of an undisturbed run.
"""

import argparse
import os
import subprocess
import sys
import tempfile

import faults
import scenes as scene_list
import tree

PAGE = 4096  # sizes of a tmpfs are whole pages
SIZES = 82
AMPLE = 1 << 28
SKIPPED = 77  # what ctest takes for a test that could not be made here


class Disk:
    """A tmpfs at the worker's folder, filled with the state from which a scene starts."""

    def __init__(self, root):
        self.root = root

    def __enter__(self):
        os.makedirs(self.root, exist_ok=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={AMPLE}", "flowslide-faults",
                        self.root], check=True)
        return self

    def __exit__(self, *_):
        subprocess.run(["umount", self.root], check=True)

    def resize(self, size):
        subprocess.run(["mount", "-o", f"remount,size={size}", self.root], check=True)

    def used(self):
        about = os.statvfs(self.root)
        return (about.f_blocks - about.f_bfree) * about.f_frsize


def run_sized(worker, disk, scene, prepared, pages):
    """Exit code on a disk with room for so many pages more, and what is wrong afterwards."""
    state, command, start, whole = prepared
    disk.resize(AMPLE)
    worker.restore(state)
    disk.resize(disk.used() + pages * PAGE)
    code, *_ = worker.program.run(worker.root, command)
    now = tree.snapshot(worker.root)
    wrong = [] if code in (0, 4, *scene.codes) else [f"ends with {code}"]
    if code == 0:
        wrong += tree.differences(now, whole)
    if code not in scene.codes:  # a study of which a row failed is complete, but another one
        wrong += tree.incomplete(worker.root, now, start, whole, bool(scene.codes))
    disk.resize(AMPLE)
    code_again, *_ = worker.program.run(worker.root, command)
    if code_again != 0:
        wrong.append(f"again: ends with {code_again}")
    wrong += [f"again: {w}" for w in tree.differences(tree.snapshot(worker.root), whole)]
    return code, wrong


def needed_pages(worker, disk, scene, prepared):
    few, enough = 0, 1
    while run_sized(worker, disk, scene, prepared, enough)[0] != 0:
        few, enough = enough, 2 * enough
    while enough - few > 1:
        middle = (few + enough) // 2
        if run_sized(worker, disk, scene, prepared, middle)[0] == 0:
            enough = middle
        else:
            few = middle
    return enough


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("shim")
    parser.add_argument("--scene", action="append")
    parser.add_argument("--few", action="store_true", help="every eighth of the sizes")
    options = parser.parse_args()
    options.control = False
    if os.geteuid() != 0:
        print("skipped: only root can mount disks of chosen sizes")
        return SKIPPED
    options.program, options.shim = map(os.path.abspath, (options.program, options.shim))
    total = bad = 0
    with tempfile.TemporaryDirectory(prefix="flowslide-disks-") as folder:
        with Disk(f"{folder}/0/root") as disk:
            worker = faults.Worker(options, f"{folder}/0", fine=True)
            for scene in scene_list.scenes():
                if options.scene and scene.name not in options.scene:
                    continue
                disk.resize(AMPLE)
                prepared = worker.prepare(scene)
                need = needed_pages(worker, disk, scene, prepared)
                first = max(0, need - 3 * SIZES // 4)
                counts = {0: 0, 4: 0}
                sizes = range(first, first + SIZES, 8 if options.few else 1)
                for pages in sizes:
                    code, wrong = run_sized(worker, disk, scene, prepared, pages)
                    counts[code] = counts.get(code, 0) + 1
                    total += 1
                    bad += bool(wrong)
                    for problem in wrong[:2]:
                        print(f"FAILED {scene.name}, {pages} pages of {need}: {problem}")
                print(f"{scene.name}: needs {need} pages; {len(sizes)} sizes, exit codes {counts}",
                      flush=True)
    print(f"{total} disk sizes, {bad} wrong")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
