#!/usr/bin/env python3
"""Joins the sources of the report's page into one script and one style sheet.

`report/page/bundle.py` writes report/page/bundle/page.js and page.css, which the program embeds;
`--check` says whether they are what it would write. The scripts are joined in the order below, each
once, inside one function: none of their names reaches the page.
"""
import pathlib
import re
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
ORDER = ["tools", "arrays", "colours", "chart", "view", "points", "windows", "profile", "player",
         "section", "histories", "page"]

STYLES = ["text", "parts", "paper"]


def script():
    found = {path.stem for path in (FOLDER / "src").glob("*.js")}
    if found != set(ORDER):
        sys.exit(f"page/src has {sorted(found ^ set(ORDER))} beside those that are joined; "
                 "mend ORDER in bundle.py")
    parts = [(FOLDER / "src" / f"{name}.js").read_text() for name in ORDER]
    text = re.sub(r"^ *(/\*.*?\*/|//[^\n]*)\n", "", "\n".join(parts), flags=re.S | re.M)
    lines = [line.strip() for line in text.splitlines()]
    joined = "\n".join(line for line in lines if line)
    return "(() => {\n\"use strict\";\n" + joined + "\n})();\n"


def style():
    sheets = [(FOLDER / "src" / f"{name}.css").read_text() for name in STYLES]
    lines = [line.strip() for line in "\n".join(sheets).splitlines()]
    return "\n".join(line for line in lines if line) + "\n"


def main():
    stale = []
    for name, text in (("page.js", script()), ("page.css", style())):
        path = FOLDER / "bundle" / name
        if sys.argv[1:] != ["--check"]:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            stale.append(name)
    if stale:
        sys.exit(f"report/page/bundle is older than its sources ({', '.join(stale)}): run "
                 "report/page/bundle.py and commit what it writes")


main()
