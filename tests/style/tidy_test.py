"""tidy.py looks at what has changed since it had no findings, and at nothing else; it takes apart
what does not compile together."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
GOOD = "inline int* nothing() { return nullptr; }\n"
BAD = "inline int* nothing() { return 0; }\n"
SAME = "namespace {\n  int same() { return 1; }\n}\nint DIFFERENT() { return same(); }\n"


def tidy(root, status, *words):
    run = subprocess.run([sys.executable, "-B", str(HERE / "tidy.py"), str(root), str(root / "build")],
                         capture_output=True, text=True, check=False)
    said = run.stdout + run.stderr
    if run.returncode == 77:
        print(said)
        sys.exit(77)
    for word in words:
        assert word in said, f"'{word}' is not in:\n{said}"
    assert run.returncode == status, f"ended with {run.returncode}:\n{said}"


def main():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        for name in ("core", "build"):
            (root / name).mkdir()
        shutil.copy(HERE.parents[1] / ".clang-tidy", root)
        (root / "core/a.hpp").write_text(GOOD, encoding="utf-8")
        (root / "core/a.cpp").write_text('#include "core/a.hpp"\n', encoding="utf-8")
        for name in "bcd":
            (root / f"core/{name}.cpp").write_text(SAME.replace("DIFFERENT", name), encoding="utf-8")
        entries = [{"directory": str(root), "file": f"core/{name}.cpp",
                    "command": f"clang++ -std=c++20 -I. -c core/{name}.cpp"} for name in "abcd"]
        (root / "build/compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")

        tidy(root, 0, "looks at 4 of 4 files", "4 files without findings")
        tidy(root, 0, "looks at 0 of 4 files")
        (root / "core/a.hpp").write_text(BAD, encoding="utf-8")
        for _ in range(2):
            tidy(root, 1, "looks at 1 of 4 files", "core/a.hpp:1:32", "zero as null pointer")
        (root / "core/a.hpp").write_text(GOOD, encoding="utf-8")
        tidy(root, 0, "looks at 0 of 4 files")
        (root / "core/b.cpp").write_text(BAD, encoding="utf-8")
        (root / "core/c.cpp").write_text("int c();\n", encoding="utf-8")
        tidy(root, 1, "looks at 2 of 4 files", "core/b.cpp:1:32", "zero as null pointer")


main()
