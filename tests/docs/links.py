"""links.py ROOT: fails on a link between pages that leads nowhere, and on a page below docs/ that
docs/README.md does not name. Notes of changes are written for the changelog in the root."""

import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")
FOLDERS_WITHOUT_PAGES = {"build", "runs", "tests", ".git"}


def anchors(page):
    found = set()
    for line in page.read_text(encoding="utf-8").split("\n"):
        heading = re.match(r"#+\s+(.*)", line)
        if heading:
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(1))
            text = re.sub(r"[`*]", "", text).strip().lower()
            found.add(re.sub(r"[^\w\- ]", "", text).replace(" ", "-"))
    return found


def links(page):
    text = re.sub(r"```.*?```|`[^`]*`|\$\$.*?\$\$|\$[^$\n]*\$", "",
                  page.read_text(encoding="utf-8"), flags=re.S)
    return [link for link in LINK.findall(text) if ":" not in link]


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = [p for p in sorted(root.rglob("*.md"))
             if p.relative_to(root).parts[0] not in FOLDERS_WITHOUT_PAGES]
    faults, count = [], 0
    for page in pages:
        changes = page.parent.name == "changes" and page.name != "README.md"
        for link in links(page):
            count += 1
            path, _, anchor = link.partition("#")
            target = (root if changes else page.parent) / path if path else page
            if not target.exists():
                faults.append(f"{page.relative_to(root)}: ({link}) leads nowhere")
            elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                faults.append(f"{page.relative_to(root)}: ({link}) has no such heading")
    docs = root / "docs"
    index = docs / "README.md"
    named = {(docs / link.partition("#")[0]).resolve() for link in links(index)}
    for page in pages:
        if docs in page.parents and page != index and page.parent.name != "changes" \
                and page.resolve() not in named:
            faults.append(f"{page.relative_to(root)}: is not named in docs/README.md")
    print("\n".join(faults + [f"{count} links, {len(faults)} faults"]))
    sys.exit(1 if faults or count == 0 else 0)


main()
