"""spelling.py ROOT [CODESPELL]: fails on words that codespell knows to be misspelled.

Ends with 77, which ctest calls skipped, where codespell is not installed.
"""

import pathlib
import shutil
import subprocess
import sys

ENDINGS = {".cpp", ".hpp", ".md", ".py", ".sh", ".cmake", ".txt", ".yaml", ".bib", ".in"}
FOLDERS = {"build", "runs", "fixtures", "corpus", "bad", "images", ".git", ".cache"}
# Names and symbols: n^d of PM4Sand, a constant, people, journals, mechanics, papers that conclude
# studies, and a trough in the ground.
KNOWN = ["nd", "kinf", "hart", "numer", "statics", "theses", "trough", "co-ordinate", "fro"]
# Wrong on purpose, in tests of messages about misspelled words.
WRONG_ON_PURPOSE = ["gaus", "wiht", "valu", "vaccuum"]


def files_below(root):
    for path in sorted(root.rglob("*")):
        parts = path.relative_to(root).parts
        if path.suffix in ENDINGS and not FOLDERS & set(parts) and path.is_file():
            yield str(path)


def main():
    root = pathlib.Path(sys.argv[1])
    program = shutil.which(sys.argv[2] if len(sys.argv) > 2 else "codespell")
    if not program:
        print("codespell is not installed (apt-get install codespell): the spelling is not checked")
        sys.exit(77)
    files = list(files_below(root))
    if not files:
        sys.exit(f"no files below '{root}'")
    words = ",".join(KNOWN + WRONG_ON_PURPOSE)
    if subprocess.run([program, "-L", words, *files], check=False).returncode:
        sys.exit("words are misspelled (left of the arrow): correct them, or add what is right to "
                 "KNOWN in tests/style/spelling.py")
    print(f"{len(files)} files have no misspelled word that codespell knows")


main()
