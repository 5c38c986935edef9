"""Charts of a page against stored pictures of them, so coarse that another font passes.

A picture is cut into squares of 40 px. Of each it is told how much of it is ink, which differs from
the paper, and how much is coloured, as a digit from 0 (none) to z (all) of 36. Stored are these
digits: a chart is seen in them by the eye, too. Two pictures are as far apart as the share of ink, or
of colour, that is in another place.
"""
import pathlib

DIGITS = "0123456789abcdefghijklmnopqrstuvwxyz"
SQUARE = 40
FARTHEST = 0.3  # letters of another font lie in the same squares, but for some; see the controls
STORED = pathlib.Path(__file__).resolve().parents[2] / "fixtures/pictures"

# What the page does with a picture of itself: ink and colour of each square.
MEASURE = """(async () => {
  const image = new Image();
  image.src = 'data:image/png;base64,%s';
  await image.decode();
  const { width, height } = image, across = %d, down = %d;
  const canvas = Object.assign(document.createElement('canvas'), { width, height });
  const pen = canvas.getContext('2d');
  pen.drawImage(image, 0, 0);
  const d = pen.getImageData(0, 0, width, height).data;
  const seen = new Map();
  for (let i = 0; i < d.length; i += 4) {
    const key = (d[i] << 16) | (d[i + 1] << 8) | d[i + 2];
    seen.set(key, (seen.get(key) || 0) + 1);
  }
  const paper = [...seen].reduce((a, b) => (b[1] > a[1] ? b : a))[0];
  const of = [paper >> 16, (paper >> 8) & 255, paper & 255];
  const ink = new Array(across * down).fill(0), colour = ink.slice(), size = ink.slice();
  for (let y = 0, i = 0; y < height; ++y)
    for (let x = 0; x < width; ++x, i += 4) {
      const k = Math.floor((y * down) / height) * across + Math.floor((x * across) / width);
      const rgb = [d[i], d[i + 1], d[i + 2]];
      size[k] += 1;
      ink[k] += Math.max(...rgb.map((v, c) => Math.abs(v - of[c]))) > 60;
      colour[k] += Math.max(...rgb) - Math.min(...rgb) > 60;
    }
  return [ink, colour].map((all) => all.map((v, k) => v / size[k]));
})()"""


def digits_of(shares):
    """Roots, so that a thin line is more than nothing."""
    return "".join(DIGITS[min(35, round(35 * share ** 0.5))] for share in shares)


def place(page, selector):
    """Left, top, width, height of the first element, once what is above it does not grow any more."""
    where, before = [], None
    while where != before:
        before = where
        page.run("new Promise(done => setTimeout(done, 200))")
        where = page.run(
            f"(() => {{ const r = document.querySelector({selector!r}).getBoundingClientRect(); "
            "return [r.left + scrollX, r.top + scrollY, r.width, r.height]; })()")
    return where


def measured(page, where):
    """Lines of digits of a place: its ink, an empty line, its colour."""
    left, top, width, height = where
    answer = page.call("Page.captureScreenshot", format="png", captureBeyondViewport=True,
                       clip={"x": left, "y": top, "width": width, "height": height, "scale": 1})
    across, down = (max(1, round(length / SQUARE)) for length in (width, height))
    ink, colour = page.run(MEASURE % (answer["data"], across, down))
    rows = [digits_of(part[k * across:(k + 1) * across])
            for part in (ink, colour) for k in range(down)]
    return "\n".join(rows[:down] + [""] + rows[down:]) + "\n"


def apart(stored, seen):
    """Share of ink or of colour that is in another place, the larger; 1 for another size."""
    farthest = 0.0
    for before, now in zip(stored.strip("\n").split("\n\n"), seen.strip("\n").split("\n\n")):
        before, now = before.split("\n"), now.split("\n")
        if [len(line) for line in before] != [len(line) for line in now]:
            return 1.0
        values = [(DIGITS.index(a) / 35, DIGITS.index(b) / 35)
                  for a, b in zip("".join(before), "".join(now))]
        ink = max(sum(a * a for a, _ in values), sum(b * b for _, b in values))
        if ink > 0.0:
            farthest = max(farthest, sum(abs(a * a - b * b) for a, b in values) / ink / 2)
    return farthest


class Pictures:
    """Those of one page; `write` stores what is seen in place of comparing it."""

    def __init__(self, name, expect, write=False):
        self.path, self.expect, self.write = STORED / f"{name}.txt", expect, write
        self.stored = {}
        if not write:
            for part in self.path.read_text(encoding="ascii").split("# ")[1:]:
                title, picture = part.split("\n", 1)
                self.stored[title] = picture

    def look(self, page, title, selector):
        seen = measured(page, place(page, selector))
        if self.write:
            self.stored[title] = seen
            return
        far = apart(self.stored[title], seen)
        self.expect(f"{title} looks as it did ({far:.3f} of it is elsewhere)", far < FARTHEST)

    def control(self, page, title, selector, what, code):
        """After `code` the page must not pass any more."""
        where = place(page, selector)
        page.run(code)  # and looked at before the page draws again
        far = apart(self.stored[title], measured(page, where))
        self.expect(f"control: {title} with {what} does not ({far:.3f})", far > 1.2 * FARTHEST)

    def save(self):
        if not self.write:
            return
        self.path.parent.mkdir(exist_ok=True)
        text = "".join(f"# {title}\n{seen}" for title, seen in self.stored.items())
        self.path.write_text(text, encoding="ascii")
