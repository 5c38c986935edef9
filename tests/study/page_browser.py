#!/usr/bin/env python3
"""Opens the page of a study in a headless Chromium: page_browser.py TEST_STUDY TEST_REPORT [PICTURES [--write]].

TEST_STUDY writes a page of known rows, TEST_REPORT the pages of two runs of other lengths beside it;
with PICTURES, a folder, what was seen is left there as PNG, and with --write fixtures/pictures is
written anew, after a change that was looked at. Ends with 77, skipped, where there is no
Chromium.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "report"))
sys.dont_write_bytecode = True
from browser import Browser, find_chromium  # noqa: E402
from page_functions import check_ground, check_zero  # noqa: E402
from pictures import Pictures  # noqa: E402

DOTS = "document.querySelectorAll('.scatter circle.dot:not(g[transform] circle)')"
failures = []


def expect(what, true):
    print(f"{'ok' if true else 'FAILED'}: {what}", flush=True)
    if not true:
        failures.append(what)


def write_pages(folder, test_study, test_report):
    def write(program, name, **more):
        subprocess.run([program, "[.page-child]"], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "FLOWSLIDE_PAGE": str(folder / name), **more})
    write(test_report, "long.html", FLOWSLIDE_PAGE_END="40")
    write(test_report, "short.html", FLOWSLIDE_PAGE_END="20")
    write(test_study, "study.html")
    write(test_study, "whole.html", FLOWSLIDE_WHOLE="yes")


def choose(page, which, value):
    """Chooses a column as a hand would: y, x or colour."""
    place = ("y", "x", "colour").index(which)
    page.run(f"(() => {{ const s = document.querySelectorAll('.choose select')[{place}]; "
             f"s.value = '{value}'; s.dispatchEvent(new Event('change')); return s.value; }})()")


def dots(page):
    """Middle of each dot in the window."""
    return page.run(f"[...{DOTS}].map(e => {{ const b = e.getBoundingClientRect(); "
                    "return [b.left + b.width / 2, b.top + b.height / 2]; })")


def labels(page, axis):
    return page.run(f"document.querySelectorAll('.scatter svg > text.label')[{axis}].textContent")


def click(page, x, y, **more):
    page.point_at(x, y)
    for kind in ("mousePressed", "mouseReleased"):
        page.point_at(x, y, kind, button="left", clickCount=1, **more)


def show_explorer(page):
    """A finger touches what was drawn last: wait for it."""
    page.run("document.getElementById('explore').scrollIntoView({behavior: 'instant'})")
    page.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def check_section(page):
    """The section of dam_case, whose toe is at 75 m, and the fronts of its runs beneath it."""
    soils = page.run("document.querySelectorAll('#fronts path.soil').length")
    expect(f"soils are drawn ({soils})", soils == 3)
    key = page.run("document.querySelector('.soilkey').textContent")
    expect(f"and named: {key}", "soil 1" in key and "water" in key)
    rugs = page.run("document.querySelectorAll('#fronts line.rug').length")
    expect(f"each run with a page is a stroke ({rugs})", rugs == 18)
    expect("the toe is marked", page.run(
        "[...document.querySelectorAll('#fronts text')].some(e => e.textContent === 'toe')"))
    # Control of the scale: the mesh ends 10 m beyond the toe.
    far = page.run("(() => { const of = (s) => document.querySelector(s).getBoundingClientRect(); "
                   "const soils = [...document.querySelectorAll('#fronts path.soil')].map(e => "
                   "e.getBoundingClientRect()); const left = Math.min(...soils.map(b => b.left)), "
                   "right = Math.max(...soils.map(b => b.right)); "
                   "const toe = of('#fronts line.mark').left; return (right - toe) / (right - left); })()")
    expect(f"the toe is in its place ({far:.4f})", abs(far - 10 / 225) < 0.004)
    page.run("document.querySelector('svg.fronts').focus()")
    page.key("ArrowRight")
    tip = page.run("document.querySelector('#fronts .tip').innerText")
    told = page.run("JSON.parse(document.getElementById('stories').textContent).fronts[6] - 75")
    expect(f"a run tells its runout ({tip!r})", "factor" in tip and f"{told:.1f}" in tip)


def check_strands(page):
    """The histories of 18 rows with pages, of two kinds that end after 20 and 40 s."""
    page.wait("document.querySelector('#strands path.strand') !== null")
    paths = "document.querySelectorAll('#strands path.strand').length"
    expect(f"runs that share a history share a curve ({page.run(paths)})", page.run(paths) == 2)
    names = page.run("[...document.querySelectorAll('#strands select')[0].options].map(o => o.value)")
    expect(f"charts: {names}", names == ["runout", "depth crest", "depth pond", "crest down",
                                         "crest across", "spectrum"])
    page.run("document.querySelector('svg.strands').focus()")
    page.key("ArrowRight")
    tip = page.run("document.querySelector('#strands .tip').innerText")
    expect(f"a curve tells its rows ({tip!r})", "row 7: " in tip or "row 8: " in tip)
    expect("and how many share it", "and 8 more with the same" in tip)
    grey = "document.querySelectorAll('#strands path.off').length"
    page.run("document.querySelector('#rows tr[data-row=\"6\"] td').click()")
    expect("a click on a row lets the others become grey", page.run(grey) == 1)
    expect("and marks it", page.run("document.querySelectorAll('#rows tr.on').length") == 1)
    told = page.run("document.querySelector('#strands .picked').innerText")
    expect(f"and names it ({told})", told.startswith("row 7: "))
    page.run("document.querySelector('#strands .picked button').click()")
    expect("it can be let go", page.run(grey) == 0)
    for name in names:
        page.run("(() => { const s = document.querySelector('#strands select'); "
                 f"s.value = '{name}'; s.dispatchEvent(new Event('change')); }})()")
        longest = page.run("Math.max(...[...document.querySelectorAll('#strands path.strand')]"
                           ".map(p => p.getTotalLength()))")
        expect(f"{name} is drawn ({longest:.0f})", longest > 100)
    # Known: the motion of the pages has its acceleration of 2 m/s2 in a period of 0.63 s.
    expect("a spectrum has periods", "period" in page.run(
        "[...document.querySelectorAll('#strands text.label')].map(e => e.textContent).join()"))


def check_explorer(page):
    show_explorer(page)
    # Eight rows with three repeats; the results of the first three rows are not known.
    expect("repeats are one point", len(dots(page)) == 7)
    expect("their scatter is a bar", page.run(
        "document.querySelectorAll('.scatter line.bar').length") == 7)
    expect("rows without a value are counted: "
           + page.run("document.querySelector('.missing').innerText"), page.run(
               "document.querySelector('.missing summary').textContent") ==
           "3 of 24 rows have no value here")
    expect("and named", page.run("[...document.querySelectorAll('.missing li')]"
                                 ".map(e => e.textContent)[1]") == "row 2: one a, factor 1, repeat 1")
    page.run("document.querySelector('.choices input').click()")
    expect("or each row is a point", len(dots(page)) == 21)
    expect("without a bar", page.run("document.querySelectorAll('.scatter line.bar').length") == 0)
    page.run("document.querySelector('.choices input').click()")


def check_choices(page):
    choose(page, "x", "factor")
    choose(page, "y", "sum")
    expect("axes are named", (labels(page, 0), labels(page, 1)) == ("factor", "sum"))
    places = sorted({round(x) for x, _ in dots(page)})
    expect(f"two factors are two places {places}", len(places) == 2)
    choose(page, "x", "sum")
    expect("another x is another place", len({round(x) for x, _ in dots(page)}) == 6)
    choose(page, "colour", "")
    fills = f"[...new Set([...{DOTS}].map(e => e.getAttribute('fill')))]"
    expect("one colour", len(page.run(fills)) == 1)
    choose(page, "colour", "one")
    expect("a colour for each word", len(page.run(fills)) == 4)
    choose(page, "colour", "sum")
    expect("a scale for numbers", len(page.run(fills)) == 6)
    choose(page, "x", "factor")
    choose(page, "colour", "one")


def check_zoom(page):
    ticks = "[...document.querySelectorAll('.scatter text.tick')].map(e => e.textContent).join()"
    whole = page.run(ticks)
    left, top, width, height = page.run(
        "(() => { const r = document.querySelector('.scatter svg').getBoundingClientRect(); "
        "return [r.left, r.top, r.width, r.height]; })()")
    page.point_at(left + 0.1 * width, top + 0.2 * height, "mousePressed", button="left", clickCount=1)
    page.point_at(left + 0.3 * width, top + 0.5 * height, button="left")
    page.point_at(left + 0.4 * width, top + 0.6 * height, "mouseReleased", button="left", clickCount=1)
    expect("a box is zoomed into", page.run(ticks) != whole)
    expect("and told", "points are in view" in page.run("document.querySelector('.view').textContent"))
    page.key("0")
    expect("0 shows all", page.run(ticks) == whole)
    page.key("+")
    expect("+ comes closer", page.run(ticks) != whole)
    page.run("document.querySelector('.scatter svg').dispatchEvent(new MouseEvent('dblclick'))")
    expect("a double click shows all", page.run(ticks) == whole)
    page.run("document.querySelector('.scatter svg').dispatchEvent(new WheelEvent('wheel', "
             f"{{deltaY: -400, clientX: {left + width / 2}, clientY: {top + height / 2}}}))")
    expect("the wheel comes closer", page.run(ticks) != whole)
    page.run("[...document.querySelectorAll('.explorer button')]"
             ".find(b => b.textContent === 'whole').click()")
    expect("a button shows all", page.run(ticks) == whole)


def check_saving(page):
    """What a click saves: its name and type, its size, and whether anything is on it."""
    page.run("(() => { window.kept = []; const link = HTMLAnchorElement.prototype, old = link.click; "
             "const make = URL.createObjectURL; let last; "
             "URL.createObjectURL = (b) => ((last = b), make.call(URL, b)); "
             "link.click = function () { this.download ? kept.push([this.download, last]) "
             ": old.call(this); }; })()")
    for place in (".explorer", "#charts figure"):
        for kind in ("SVG", "PNG"):
            before = page.run("kept.length")
            page.run(f"[...document.querySelectorAll('{place} button')]"
                     f".find(b => b.textContent === '{kind}').click()")
            page.wait(f"kept.length > {before}")
            name, mime = page.run("[kept.at(-1)[0], kept.at(-1)[1].type]")
            expect(f"{place}: {name} is saved", name.endswith("." + kind.lower()) and
                   mime == {"SVG": "image/svg+xml", "PNG": "image/png"}[kind])
        width, dark = page.run(
            "createImageBitmap(kept.at(-1)[1]).then((b) => { const c = new OffscreenCanvas(b.width, "
            "b.height), pen = c.getContext('2d'); pen.drawImage(b, 0, 0); const d = "
            "pen.getImageData(0, 0, b.width, b.height).data; let n = 0; for (let i = 0; i < d.length; "
            "i += 4) n += d[i] + d[i + 1] + d[i + 2] < 600; return [b.width, n]; })")
        expect(f"{place}: the picture has {width} points across, {dark} of them dark",
               width > 1000 and 1000 < dark < 2_000_000)


def frame_source(page, side):
    return page.run(f"document.querySelector('iframe[name={side}]').src")


def check_opening(page):
    expect("no run is open", page.run("document.getElementById('two').hidden"))
    x, y = sorted(dots(page))[1]
    page.point_at(x, y)
    tip = page.run("document.querySelector('.scatter .tip').innerText")
    expect(f"a point tells its row and values ({tip!r})",
           "row 13: one </script>, factor 1" in tip and "5 \u00b1 0.005" in tip and "mean of 3" in tip)
    click(page, x, y)
    expect("a click opens its run", "/short.html?row=row+13" in frame_source(page, "left")
           and frame_source(page, "left").endswith("#the-flow"))
    which = page.run("document.querySelector('[data-side=left]').textContent")
    expect(f"above it stands which row it is ({which})",
           which == "row 13: one </script>, factor 1")
    said = page.wait_in("left", "document.querySelector('.of-row')?.textContent")
    expect(f"and in its own heading ({said})", said == which)
    expect("and in its title", page.run_in("left", "document.title").startswith("row 13: "))
    expect("on the left alone", frame_source(page, "right") == "")
    expect("and is told to be below the chart", page.run(
        "document.querySelector('.chosen a[href=\"#side-by-side\"]').innerText")
        == "Open on the left, below.")
    page.run("document.querySelector('.scatter svg').focus()")
    page.key("End")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter", modifiers=8)
    page.call("Input.dispatchKeyEvent", type="keyUp", key="Enter", code="Enter", modifiers=8)
    expect("Shift and Enter open on the right", "#the-flow" in frame_source(page, "right"))
    expect("what is open is marked", page.run(
        "[...document.querySelectorAll('.scatter .opentext')].map(e => e.textContent).join()")
        == "left,right")


def check_touch(page):
    """A finger chooses a point; buttons below the chart open its run."""
    show_explorer(page)
    x, y = sorted(dots(page))[1]
    page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    page.wait("document.querySelector('.chosen button') !== null")
    told = page.run("document.querySelector('.chosen').innerText")
    expect(f"a finger chooses a point ({told})", "factor 1" in told and "left right" in told)
    expect("and opens nothing by itself", frame_source(page, "left") == "")
    page.run("document.querySelectorAll('.chosen button')[1].click()")
    expect("its buttons do", "#the-flow" in frame_source(page, "right"))
    expect("beside nothing too wide", page.run(
        "document.documentElement.scrollWidth <= innerWidth"))


def readout(page, side):
    """What the player of a side says; a file may not look into another, the browser's tools may."""
    return page.run_in(side, "document.querySelector('.readout').textContent")


def time_of(page, side):
    return float(readout(page, side).split()[2])


def both(page):
    return time_of(page, "left"), time_of(page, "right")


def rule(page, value):
    page.run(f"(() => {{ const s = document.querySelector('.together select'); s.value = '{value}'; "
             "s.dispatchEvent(new Event('change')); })()")


def scrub(page, side, time):
    page.run_in(side, f"(() => {{ const s = document.querySelector('.bar input'); s.value = {time}; "
                "s.dispatchEvent(new Event('input')); })()")


def until(page, what, true):
    for _ in range(100):
        if true():
            return expect(what, True)
        page.run("new Promise(done => setTimeout(done, 50))")
    return expect(f"{what} (never: {both(page)})", False)


def open_both(page, names=None):
    """The shorter run, of 20 s, on the left, the longer, of 40 s, on the right."""
    for row, side in ((6, "left"), (7, "right")):
        page.run(f"document.querySelector('#rows a[data-row=\"{row}\"][target={side}]').click()")
        where = f"location.pathname.endsWith('{names[row - 6]}')" if names else (
            "location.href.startsWith('about:srcdoc')")
        page.wait_in(side, f"{where} && document.documentElement.dataset.ready")
    page.wait("!document.querySelector('.together input').disabled")


def check_together(page):
    open_both(page, ("short.html", "long.html"))
    play = "document.querySelector('.play').click()"
    scrub(page, "right", 12)
    expect(f"players are apart {both(page)}", both(page) == (20, 12))
    page.run("document.querySelector('.together input').click()")
    until(page, "ticked, they show one time", lambda: both(page) == (20, 20))
    scrub(page, "left", 7)
    until(page, "one follows the other", lambda: both(page) == (7, 7))
    scrub(page, "right", 30)
    until(page, "the shorter waits at its end", lambda: both(page) == (20, 30))
    page.run_in("right", "document.querySelector('.bar select').value = '50'; document"
                ".querySelector('.bar select').dispatchEvent(new Event('change'))")
    scrub(page, "right", 2)
    until(page, "and is taken along", lambda: both(page) == (2, 2))
    expect("so is the speed",
           page.run_in("left", "document.querySelector('.bar select').value") == "50")
    page.run_in("left", play)
    until(page, "played from either side, both end", lambda: both(page) == (20, 40))
    rule(page, "stop")
    scrub(page, "left", 1)
    until(page, "both stand at 1 s", lambda: both(page) == (1, 1))
    page.run_in("right", play)
    until(page, "or both stop where the shorter ends", lambda: both(page) == (20, 20))
    expect("and stand", [page.run_in(s, "document.querySelector('.play').ariaLabel")
                         for s in ("left", "right")] == ["Play", "Play"])
    rule(page, "stretch")
    scrub(page, "left", 5)
    until(page, "or both take equally long", lambda: both(page) == (5, 10))
    check_nonsense(page)
    page.run("document.querySelector('.together input').click()")
    scrub(page, "left", 3)
    expect(f"apart again {both(page)}", both(page) == (3, 10))


def check_nonsense(page):
    nonsense = ("null", "7", "'flowslide-player'", "{}", "{kind: 'flowslide-player'}",
                "{kind: 'flowslide-player', time: 'x', rate: 1, playing: false, lead: false}",
                "{kind: 'flowslide-player', time: NaN, rate: 1, playing: false, lead: false}",
                "{kind: 'flowslide-player', time: 1, rate: 3, playing: false, lead: false}",
                "{kind: 'flowslide-player', time: 1, rate: 1, playing: 1, lead: false}")
    for words in nonsense:
        page.run(f"document.querySelector('iframe[name=left]').contentWindow.postMessage({words}, '*')")
        page.run_in("left", f"parent.postMessage({words}, '*')")
    page.run("new Promise(done => setTimeout(done, 300))")
    expect(f"nonsense moves nothing {both(page)}", both(page) == (5, 10))
    # control: the last one without its mistake
    page.run("document.querySelector('iframe[name=left]').contentWindow.postMessage({kind: "
             "'flowslide-player', time: 1, rate: 1, playing: false, lead: false}, '*')")
    until(page, "control: an order does", lambda: both(page) == (1, 10))


def check_whole(page):
    """The pages of runs are in the file, and no other is there."""
    expect("no page is unpacked", page.run("document.querySelectorAll('iframe[src]').length") == 0)
    open_both(page)
    expect(f"runs open from memory {both(page)}", both(page) == (20, 40))
    expect("their text is there", page.run_in("left", "document.querySelector('h1').textContent")
           == 'Dam <of> the "test" & more')
    expect("rows without a run are told", "but for 6 of 24 rows" in page.run(
        "document.getElementById('side-by-side').textContent"))
    page.run("document.querySelector('.together input').click()")
    scrub(page, "right", 7)
    until(page, "and play together", lambda: both(page) == (7, 7))
    page.run_in("left", "window.before = true")
    show_explorer(page)
    click(page, *sorted(dots(page))[1])
    page.wait_in("left", "!window.before && document.documentElement.dataset.ready")
    expect("a click on a point opens another", "</script>" in page.run(
        "document.querySelector('[data-side=left]').textContent"))
    top = "document.getElementById('histories').getBoundingClientRect().top"
    expect("with its row in its heading", page.run_in(
        "left", "document.querySelector('.of-row').textContent").startswith("row 13: "))
    expect("at its flow", 0 <= page.run_in("left", top.replace("histories", "the-flow")) < 100)
    expect("not at its histories", page.run_in("left", top) > 300)
    page.run_in("left", "document.querySelector('nav a[href=\"#histories\"]').click()")
    expect("a link within it leads there", page.run_in("left", top) < 100)
    page.run("window.open = (open => (...a) => window.tab = open.apply(window, a))(window.open)")
    page.run("document.querySelector('#rows a[target=_blank]').click()", userGesture=True)
    page.wait("window.tab?.document.documentElement?.dataset.ready")
    expect("a run has a tab of its own", page.run("tab.document.documentElement.dataset.ready")
           == "yes")
    told = page.run("tab.document.querySelector('.of-row').textContent")
    expect(f"and its row ({told})", told.startswith("row 7: ") and told in page.run(
        "tab.document.title"))
    page.run("tab.close()")


HIDE = "document.styleSheets[0].insertRule('%s { visibility: hidden; }')"
SEEN = {"section and fronts": "svg.fronts", "chart of points": ".scatter svg",
        "histories": "svg.strands", "tornado": "#charts figure svg"}


def look(page, folder, write):
    """What the charts look like; and that a page without one, or with another, would be seen."""
    looks = Pictures("study", expect, write)
    for name, width, dark, phone in (("desktop", 1280, False, False), ("phone", 390, False, True),
                                     ("dark", 1280, True, False)):
        page.open(folder / "study.html", width, dark=dark, phone=phone)
        page.wait("document.querySelector('#strands path.strand') !== null")
        for title, selector in SEEN.items():
            looks.look(page, f"{name}, {title}", selector)
    looks.save()
    page.open(folder / "study.html", 1280)
    page.wait("document.querySelector('#strands path.strand') !== null")
    for title, selector in SEEN.items():
        looks.control(page, f"desktop, {title}", selector, "left and right exchanged",
                      f"document.querySelector('{selector}').style.transform = 'scaleX(-1)'")
        page.run(f"document.querySelector('{selector}').style.transform = ''")
    dots = SEEN["chart of points"]
    looks.control(page, "desktop, chart of points", dots, "no points",
                  HIDE % ".scatter circle")
    for title, selector in SEEN.items():
        looks.control(page, f"desktop, {title}", selector, "nothing in it",
                      HIDE % selector)


def main(test_study, test_report, pictures=None, write=None):
    chromium = find_chromium()
    if not chromium:
        print("no Chromium (Debian: chromium): the page of a study is not opened")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_pages(folder, test_study, test_report)
        with Browser(chromium) as page:
            for name, width, dark, phone in (("desktop", 1280, False, False),
                                             ("phone", 390, False, True),
                                             ("dark", 1280, True, False)):
                page.open(folder / "study.html", width, dark=dark, phone=phone)
                expect(f"{name}: the scripts ran",
                       page.run("document.documentElement.dataset.ready") == "yes")
                expect(f"{name}: nothing is wider than the page", page.run(
                    "document.documentElement.scrollWidth <= innerWidth"))
                over = page.run("""(() => { const nav = document.querySelector('nav'),
                    edge = nav.getBoundingClientRect().right;
                    return Math.max(...[...nav.querySelectorAll('a, button')].map(
                        (e) => e.getBoundingClientRect().right - edge)); })()""")
                expect(f"{name}: the menu is not cut off ({over:.0f})", phone or over <= 0)
                if pictures:
                    page.picture(pathlib.Path(pictures, f"study-{name}.png"))
            look(page, folder, write == "--write")
            page.open(folder / "study.html", 390, phone=True)
            check_touch(page)
            page.open(folder / "study.html", 1280)
            check_section(page)
            check_ground(page, expect)
            check_strands(page)
            check_explorer(page)
            check_zero(page, expect)
            check_choices(page)
            check_zoom(page)
            check_saving(page)
            check_opening(page)
            check_together(page)
            alone = folder / "alone"
            alone.mkdir()
            (folder / "whole.html").rename(alone / "whole.html")
            page.call("Network.emulateNetworkConditions", offline=True, latency=0,
                      downloadThroughput=0, uploadThroughput=0)
            page.open(alone / "whole.html", 1280)
            check_whole(page)
            expect("the console is silent: " + "; ".join(page.said), not page.said)
    sys.exit(f"{len(failures)} failed" if failures else 0)


main(*sys.argv[1:])
