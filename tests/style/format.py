"""format.py ROOT [--fix]: fails on files in C++ that clang-format 14 would write otherwise, with the
.clang-format of the checkout; --fix rewrites them.

Ends with 77, which ctest calls skipped, where clang-format 14 is not installed: others wrap lines in
other places.
"""

import pathlib
import shutil
import subprocess
import sys

PROGRAMS = ["clang-format-14", "clang-format"]
FOLDERS = {"build", "runs", "fixtures", "docs", ".git"}
CONFIG = pathlib.Path(__file__).resolve().parents[2] / ".clang-format"


def find_program():
    for name in PROGRAMS:
        path = shutil.which(name)
        if path and " version 14." in subprocess.run([path, "--version"], capture_output=True,
                                                     text=True, check=True).stdout:
            return path
    print("clang-format 14 is not installed (apt-get install clang-format-14): the format is not "
          "checked")
    sys.exit(77)


def main():
    root, fix = pathlib.Path(sys.argv[1]).resolve(), "--fix" in sys.argv[2:]
    program = find_program()
    files = []
    for path in sorted(root.rglob("*.[ch]pp")):
        parts = path.relative_to(root).parts
        if not FOLDERS & set(parts) and parts[:3] != ("tests", "style", "bad"):
            files.append(str(path))
    if not files:
        sys.exit(f"no files below '{root}'")
    # One process for all: starting one takes as long as what it does.
    told = subprocess.run([program, f"--style=file:{CONFIG}", "--dry-run", *files],
                          capture_output=True, text=True, check=True).stderr
    faults = sorted({path for path in files if f"{path}:" in told})
    for path in faults:
        print(pathlib.Path(path).relative_to(root))
    if faults and fix:
        subprocess.run([program, f"--style=file:{CONFIG}", "-i", *faults], check=True)
    elif faults:
        sys.exit(f"{len(faults)} of {len(files)} files are not in format: "
                 "tests/style/format.py ROOT --fix")
    print(f"{len(files)} files are in format")


main()
