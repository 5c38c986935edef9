"""functions.py ROOT LINES: fails on a function in C++ of more than LINES lines.

A function is what stands between a line that ends with " {" after a ")" and the "}" of the same
indentation, as clang-format leaves them; lambdas and bodies inside count for the function around
them, and the lines of its head count too. Test cases are functions.
"""

import pathlib
import re
import sys

HEAD_END = re.compile(r"\)(\s*(const|noexcept|override|final|mutable|->\s*[\w:<>,&* ]+))*\s*(:.*)?\{$")
NO_FUNCTION = re.compile(r"^\s*(if|for|while|switch|do|else|try|catch|namespace|struct|class|enum|union)\b")
FOLDERS_WITHOUT_CODE = {"build", "runs", "docs", "fixtures", ".git", ".ci"}


def start_of_head(lines, at):
    """First line of the head that ends in line `at`: where its parentheses are balanced and the
    line before is blank or ends something."""
    depth = 0
    for k in range(at, -1, -1):
        text = re.sub(r'"(\\.|[^"\\])*"', '""', lines[k])
        depth += text.count(")") - text.count("(")
        if depth <= 0 and (k == 0 or not lines[k - 1].strip() or lines[k - 1].rstrip()[-1] in ";}{:/"
                           or lines[k - 1].lstrip().startswith(("//", "#"))):
            return k
    return at


def functions(lines):
    k = 0
    while k < len(lines):
        line = lines[k]
        if HEAD_END.search(line):
            first = start_of_head(lines, k)
            indent = len(lines[first]) - len(lines[first].lstrip())
            if not NO_FUNCTION.match(lines[first]):
                end = next((j for j in range(k + 1, len(lines))
                            if lines[j].startswith(" " * indent + "}")
                            and len(lines[j]) - len(lines[j].lstrip()) == indent), None)
                if end is not None:
                    yield first, end
                    k = end
        k += 1


def main():
    root, limit = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    count = faults = 0
    for path in sorted(root.rglob("*.[ch]pp")):
        name = path.relative_to(root)
        if name.parts[0] in FOLDERS_WITHOUT_CODE or name.parts[:3] == ("tests", "style", "bad"):
            continue
        lines = path.read_text(encoding="utf-8").split("\n")
        for first, end in functions(lines):
            count += 1
            if end - first + 1 > limit:
                faults += 1
                print(f"{name}:{first + 1}: {end - first + 1} lines ({limit} are allowed) "
                      f"{lines[first].strip()[:60]}")
    if count == 0 or faults:
        sys.exit(f"{faults} of {count} functions are too long: cut them along their meaning")
    print(f"{count} functions have at most {limit} lines")


if __name__ == "__main__":
    main()
