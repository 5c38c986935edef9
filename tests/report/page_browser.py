#!/usr/bin/env python3
"""Opens the page of a report in a headless Chromium: page_browser.py TEST_REPORT [PICTURES [--write]].

TEST_REPORT is the program test_report, which writes a page of a known run; with PICTURES, a folder,
what was seen is left there as PNG; with --write fixtures/pictures is written anew, after a change
that was looked at. Ends with 77, skipped, where there is no Chromium.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

from browser import Browser, find_chromium
from pictures import Pictures

TITLE = 'Dam <of> the "test" & more'
failures = []


def expect(what, true):
    print(f"{'ok' if true else 'FAILED'}: {what}")
    if not true:
        failures.append(what)


def check_text(page):
    expect("the title is text", page.run("document.querySelector('h1').textContent") == TITLE)
    expect("warnings stand before all else", page.run(
        "document.querySelector('main').firstElementChild.classList.contains('warnings')"))
    expect("nothing of the page is wider than it", page.run(
        "document.documentElement.scrollWidth <= innerWidth"))


def check_charts(page):
    names = page.run("[...document.querySelectorAll('.panel b')].map(e => e.textContent)")
    for name in ("Runout", "Speed", "Energies", "Depth along the section", "Motion",
                 "Response spectrum", "Depth of liquefaction", "Crest"):
        expect(f"chart {name}", name in names)
    expect("every chart has a curve", page.run(
        "[...document.querySelectorAll('.panel')].every(p => "
        "(p.querySelector('path.line')?.getAttribute('d') || '').length > 20)"))
    # In dam_case the front passes from 40 to 200 m in 30 s; the toe is at x = 75 m.
    page.run("document.querySelector('.panel svg.chart').focus()")
    page.key("ArrowRight")
    tip = page.run("document.querySelector('.panel .tip').textContent")
    expect(f"a chart tells its values ({tip})", "runout" in tip and "m" in tip)
    curve = "document.querySelector('.panel path.line').getAttribute('d')"
    before = page.run(curve)
    page.key("+")
    expect("a chart zooms by key", before != page.run(curve))
    page.key("0")
    expect("and back", before == page.run(curve))


def readout(page):
    return page.run("document.querySelector('.readout').textContent")


def coloured(page, selector):
    """Share of the pixels of a canvas that are not transparent."""
    return page.run(
        "(() => { const c = document.querySelector('%s'), d = c.getContext('2d')"
        ".getImageData(0, 0, c.width, c.height).data; let n = 0; "
        "for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return 4 * n / d.length; })()"
        % selector)


def check_player(page):
    expect("points are drawn", coloured(page, "#player .plot canvas") > 0.15)
    expect("the section is drawn", coloured(page, "#section .plot canvas") > 0.15)
    at_end = readout(page)
    page.run("document.querySelector('#player canvas').focus()")
    page.key("Home")
    expect(f"the player goes to the start ({readout(page)})", readout(page).startswith("t = 0.00"))
    page.key("ArrowRight")
    expect(f"and on by a stored state ({readout(page)})", readout(page).startswith("t = 20.0"))
    page.key("Home")
    page.key(" ", "Space", " ")
    page.wait("!document.querySelector('.readout').textContent.startsWith('t = 0.00')")
    page.key("End")
    runout = page.run("JSON.parse(document.getElementById('run').textContent).runout_m")
    expect(f"and to the end ({at_end})",
           readout(page) == at_end and f"runout {runout:.1f}" in at_end)
    picture = "document.querySelector('#player .plot canvas').toDataURL()"
    before = page.run(picture)
    for mode in ("material", "strength", "speed"):
        page.run(f"[...document.querySelectorAll('#player .choice button')]"
                 f".find(b => b.textContent === '{mode}').click()")
        now = page.run(picture)
        expect(f"colours by {mode}", now != before)
        before = now
    box = page.run("(() => { const b = document.querySelector('#player canvas'); "
                   "b.scrollIntoView({behavior: 'instant'}); const r = b.getBoundingClientRect(); "
                   "return [r.left, r.top, r.width, r.height]; })()")
    page.point_at(box[0] + 0.3 * box[2], box[1] + 0.72 * box[3])
    tip = page.run("document.querySelector('#player .tip').textContent")
    expect(f"a point tells its values ({tip})", "displacement" in tip)


def check_menu(page):
    """Its entries and buttons lie within it, and a chapter that it leads to is not below it."""
    over = page.run("""(() => { const nav = document.querySelector('nav'),
        within = nav.getBoundingClientRect();
        return Math.max(...[...nav.querySelectorAll('a, button')].map(
            (e) => e.getBoundingClientRect().right - within.right)); })()""")
    expect(f"the menu is not cut off ({over:.0f})", over <= 0)
    place = page.run("""(() => { document.documentElement.style.scrollBehavior = 'auto';
        document.querySelector('nav a[href="#key-numbers"]').click();
        const top = (s) => document.querySelector(s).getBoundingClientRect();
        return top('#key-numbers h2, #key-numbers').top - top('nav').bottom; })()""")
    expect(f"and covers no heading ({place:.0f})", place >= 0)


def check_windows(page):
    """By the function itself: nothing of the page reaches its names."""
    code = pathlib.Path(__file__).parents[2].joinpath("report/page/windows.js").read_text()

    def bottom(ground, ys):
        found = page.run("""(() => { %s
            const found = sectionWindows(
              { materials: [{ counts: true }], moved_m: 1, toe_m: 10, ground: %s },
              { count: 2, frames: 3, x0: [0, 5], y0: [0, 10], xs: [0, 5, 0, 30, 0, 50], ys: %s,
                material: [0, 0] });
            return [found.range[0], found.damRange[0]]; })()""" % (code, ground, ys))
        expect(f"the section alone is framed as ever ({found[1]})", abs(found[1] + 0.8) < 1e-9)
        return found[0]

    expect("a flow on level ground is framed as the section",
           abs(bottom("[]", [0, 10, 0, 5, 0, 2]) + 0.8) < 1e-9)
    expect("one that falls is seen whole, at every time",
           abs(bottom("[]", [0, 10, 0, -30, 0, -20]) + 30.8) < 1e-9)
    # The ground falls from 0 at x = 0 to -100 at x = 100, and the points end at x = 50.
    expect("and the ground under it",
           abs(bottom("[[0, 0], [100, -100]]", [0, 10, 0, 5, 0, 2]) + 50.8) < 1e-9)
    expect("which goes on level beyond its ends",
           abs(bottom("[[20, -3], [40, -7]]", [0, 10, 0, 5, 0, 2]) + 7.8) < 1e-9)


HIDE = "document.styleSheets[0].insertRule('%s { visibility: hidden; }')"
SEEN = {"flow": "#player canvas", "section": "#section canvas", "runout": ".panel svg.chart"}


def look(page, path, write):
    looks = Pictures("report", expect, write)
    for name, width, dark, phone in (("desktop", 1280, False, False), ("phone", 390, False, True),
                                     ("dark", 1280, True, False)):
        page.open(path, width, dark=dark, phone=phone)
        for title, selector in SEEN.items():
            looks.look(page, f"{name}, {title}", selector)
    looks.save()
    page.open(path, 1280)
    # Controls: a page whose chart, or whose flow, is missing.
    looks.control(page, "desktop, runout", SEEN["runout"], "no curve",
                  HIDE % ".panel path.line")
    looks.control(page, "desktop, flow", SEEN["flow"], "nothing in it",
                  HIDE % "#player canvas")


def main(program, pictures=None, write=None):
    chromium = find_chromium()
    if not chromium:
        print("no Chromium (Debian: chromium): the page of the report is not opened")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "report.html")
        subprocess.run([program, "[.page-child]"], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "FLOWSLIDE_PAGE": str(path)})
        with Browser(chromium) as page:
            for name, width, dark, phone in (("desktop", 1280, False, False),
                                             ("phone", 390, False, True),
                                             ("dark", 1280, True, False)):
                page.open(path, width, dark=dark, phone=phone)
                expect(f"{name}: numbers are unpacked",
                       page.run("document.documentElement.dataset.ready") == "yes")
                check_text(page)
                if not phone:
                    check_menu(page)
                if pictures:
                    page.picture(pathlib.Path(pictures, f"{name}.png"))
            look(page, path, write == "--write")
            page.open(path, 1280)
            check_charts(page)
            check_player(page)
            check_windows(page)
            expect("the console is silent, and nothing is loaded: " + "; ".join(page.said),
                   not page.said)
            # Control: a script that is not the page's own does not run, and the console tells.
            page.run("document.body.append(Object.assign(document.createElement('script'), "
                     "{textContent: 'window.trapped = 1'}))")
            expect("no other script runs", page.run("typeof trapped") == "undefined")
            page.run("new Promise(done => setTimeout(done, 200))")
            expect("and the console tells of it", bool(page.said))
    sys.exit(f"{len(failures)} failed" if failures else 0)


main(*sys.argv[1:])
