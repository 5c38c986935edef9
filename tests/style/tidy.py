"""tidy.py ROOT BUILD [FOLDER...]: clang-tidy 14 with the .clang-tidy of ROOT over the files that
BUILD/compile_commands.json names, of these folders only; fails on findings.

What costs is headers, which the checks walk through as well: files that are compiled alike are looked
at together, twenty at a time, where no two of them seem to define the same name. Files of which the
compiler says that they do not go together are halved until they do.

A file without findings is looked at again when something has changed that it is made of: itself and
what it includes of ROOT, its command, .clang-tidy, clang-tidy, the packages that bring headers.
BUILD/tidy keeps what it was made of.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

PROGRAMS = ["clang-tidy-14", "clang-tidy"]
TOGETHER = 20
INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)
# What a line that is not indented defines: a function, a type or a variable, no member of a class.
DEFINED = re.compile(rb"^(?!using|namespace|template|#|/|\})[A-Za-z_][^;={(\n]*?\b(?<!::)(\w+)[ \t]*"
                     rb"(?:\[[^\]\n]*\])?[ \t]*(?:[({=;]|:(?!:))", re.MULTILINE)


def find_program():
    for name in PROGRAMS:
        path = shutil.which(name)
        if path and " version 14." in output_of([path, "--version"]):
            return path
    print("clang-tidy 14 is not installed (apt-get install clang-tidy-14): it is not asked")
    sys.exit(77)  # which ctest calls skipped


def output_of(command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def packages():
    """Names and versions of the packages that bring headers; nothing where they come otherwise."""
    if not shutil.which("dpkg-query"):
        return ""
    return subprocess.run(["dpkg-query", "-W", "*-dev", "catch2"], capture_output=True, text=True,
                          check=False).stdout


class Sources:
    """What files of `root` are made of. Every include in quotes counts, whatever stands around it."""

    def __init__(self, root):
        self.root = root
        self.read = {}

    def parts(self, path):
        """Hashes of `path` and of all that it includes, by path."""
        found, open_ = {}, [path]
        while open_:
            path = open_.pop()
            if path not in found:
                found[path], includes = self.part(path)
                open_ += includes
        return sorted((str(path), digest) for path, digest in found.items())

    def part(self, path):
        if path not in self.read:
            text = path.read_bytes()
            names = [name.decode() for name in INCLUDE.findall(text)]
            places = [folder / name for name in names for folder in (path.parent, self.root)]
            self.read[path] = (hashlib.sha256(text).hexdigest(),
                               [place.resolve() for place in places if place.is_file()])
        return self.read[path]


def options_by_file(root, build):
    """Where each file of `root` is compiled, and with what; one that is compiled twice counts once."""
    options = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        path = (pathlib.Path(entry["directory"]) / entry["file"]).resolve()
        if path.is_relative_to(root) and not path.is_relative_to(build):
            words = shlex.split(entry["command"])
            words = words[next(i for i, word in enumerate(words) if "clang++" in word) + 1:]
            if "-o" in words:
                del words[words.index("-o"):words.index("-o") + 2]
            words = [word for word in words if word not in ("-c", "-Werror", entry["file"])]
            options[path] = (entry["directory"], *words)
    return options


def batches(work):
    """Lists of files to be looked at together, with their options."""
    found = []
    for path, options in work:
        names = {name for name in DEFINED.findall(path.read_bytes()) if not name.isupper()}
        for batch in found:
            if batch["options"] == options and len(batch["paths"]) < TOGETHER \
                    and not names & batch["names"]:
                break
        else:
            batch = {"options": options, "paths": [], "names": set()}
            found.append(batch)
        batch["paths"].append(path)
        batch["names"] |= names
    return [(batch["paths"], batch["options"]) for batch in found]


class Tidy:
    def __init__(self, root):
        self.program = find_program()
        self.config = root / ".clang-tidy"

    def rules(self):
        return [output_of([self.program, "--version"]), packages(),
                self.config.read_text(encoding="utf-8")]

    def look(self, paths, options):
        """(paths, findings) of the files that could be looked at together."""
        with tempfile.TemporaryDirectory() as folder:
            together = pathlib.Path(folder) / "together.cpp"
            together.write_text("".join(f'#include "{path}"\n' for path in paths), encoding="utf-8")
            run = subprocess.run([self.program, "--quiet", f"--config-file={self.config}",
                                  str(together), "--", *options[1:]], cwd=options[0],
                                 capture_output=True, text=True, check=False)
        if run.returncode == 0:
            return [(paths, "")]
        if "[clang-diagnostic-error" in run.stdout and len(paths) > 1:
            half = len(paths) // 2
            return self.look(paths[:half], options) + self.look(paths[half:], options)
        return [(paths, run.stdout or run.stderr)]


def main():
    root, build = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    folders = [root / name for name in sys.argv[3:]] or [root]
    tidy, sources, stamps = Tidy(root), Sources(root), build / "tidy"
    stamps.mkdir(exist_ok=True)
    rules, count, work, keys = tidy.rules(), 0, [], {}
    for path, options in sorted(options_by_file(root, build).items()):
        if any(path.is_relative_to(folder) for folder in folders):
            count += 1
            key = hashlib.sha256(repr((rules, options, sources.parts(path))).encode()).hexdigest()
            stamp = stamps / str(path.relative_to(root)).replace("/", ".")
            if not stamp.is_file() or stamp.read_text(encoding="utf-8") != key:
                work.append((path, options))
                keys[path] = (stamp, key)
    if count == 0:
        sys.exit(f"no files of these folders in '{build}/compile_commands.json'")
    print(f"clang-tidy looks at {len(work)} of {count} files, the others are as it saw them",
          flush=True)
    clean, said = True, {""}  # one in a header is found with every file that includes it
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = [pool.submit(tidy.look, *batch) for batch in batches(work)]
        for run in concurrent.futures.as_completed(runs):
            for paths, findings in run.result():
                clean = clean and not findings
                for finding in re.split(r"^(?=/)", findings, flags=re.MULTILINE):
                    if finding not in said:
                        print(finding, end="", flush=True)
                        said.add(finding)
                for stamp, key in () if findings else (keys[path] for path in paths):
                    stamp.write_text(key, encoding="utf-8")
    if not clean:
        sys.exit("there are findings")
    print(f"{count} files without findings")


if __name__ == "__main__":
    main()
