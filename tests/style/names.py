"""names.py ROOT: fails where two source files of a module give one name, in namespaces without a
name, to two things: files of a module are compiled together (docs/adr/0019), where the second would
be refused, or be an overload that the first one's file calls by mistake.

Files that their CMakeLists.txt sets `apart` do not count.
"""

import collections
import pathlib
import re
import sys

HIDDEN = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
# What a line that is not indented defines: a function, a type or a variable, no member of a class.
DEFINED = re.compile(r"^(?!using|namespace|template|requires|#|/|\})[A-Za-z_][^;={(\n]*?\b(?<!::)"
                     r"(\w+)[ \t]*(?:\[[^\]\n]*\])?[ \t]*(?:[({=;]|:(?!:)|final\b)", re.MULTILINE)
# Further names of a line such as "constexpr double kLength = 1.0, kHeight = 2.0;".
FURTHER = re.compile(r"^constexpr[^;({]*?;", re.MULTILINE)
ALIAS = re.compile(r"^using (\w+) = ([^;]*);", re.MULTILINE)
APART = re.compile(r"\bapart\(([^)]*)\)")
QUOTED = re.compile(r'R"(\w*)\(.*?\)\1"', re.DOTALL)


def modules(root):
    """Source files by the folder of the module that compiles them."""
    found = collections.defaultdict(list)
    for path in sorted(root.rglob("*.cpp")):
        folder = path.parent
        while not (folder / "CMakeLists.txt").is_file() and folder != root:
            folder = folder.parent
        if path.relative_to(root).parts[0] not in ("tests", "build"):
            found[folder].append(path)
    return found


def hidden_names(path):
    """Names in namespaces without a name; aliases with what they stand for, which may be repeated."""
    text = QUOTED.sub('""', path.read_text(encoding="utf-8"))
    names = set()
    for part in HIDDEN.findall(text):
        names |= {name for name in DEFINED.findall(part) if name != "final"}
        for line in FURTHER.findall(part):
            names |= set(re.findall(r"(\w+) = ", line))
    for name, meaning in ALIAS.findall(text):
        names.add((name, " ".join(meaning.split())))
    return names


def clashes(folder, paths):
    apart = " ".join(APART.findall((folder / "CMakeLists.txt").read_text(encoding="utf-8"))).split()
    where, aliases = collections.defaultdict(list), collections.defaultdict(dict)
    for path in paths:
        if str(path.relative_to(folder)) in apart:
            continue
        for name in hidden_names(path):
            if isinstance(name, tuple):
                aliases[name[0]][name[1]] = path
            else:
                where[name].append(path)
    for name, meanings in aliases.items():
        where[name] += meanings.values()
    return {name: sorted(found) for name, found in where.items() if len(found) > 1}


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    count = 0
    for folder, paths in modules(root).items():
        for name, found in sorted(clashes(folder, paths).items()):
            count += 1
            print(f"'{name}' is something else in each of " +
                  ", ".join(str(path.relative_to(root)) for path in found))
    if count:
        sys.exit(f"{count} names are taken twice in a module (its files are compiled together, "
                 "docs/adr/0019) call them what they are, or share the one thing in a header")


if __name__ == "__main__":
    main()
