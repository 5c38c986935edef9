"""Small SVG charts of points, that read on white and on dark."""
import html
import math

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 360, 280, 52, 12, 34, 44
COLOURS = ["#1d4ed8", "#c2410c", "#15803d", "#7e22ce"]
STYLE = (
    "<style>text{font:11px system-ui,sans-serif;fill:#444}.t{font-weight:600;fill:#222}"
    ".g{stroke:#e6e6e6}.a{stroke:#888}.e{stroke:#666}.p{fill:none;stroke:#111;stroke-width:1.5}"
    "</style><rect width='100%' height='100%' fill='#fff'/>"
)


def steps(low, high, wanted=5):
    """Round numbers in a range."""
    raw = (high - low) / wanted or 1.0
    unit = 10.0 ** math.floor(math.log10(raw))
    step = unit * next(m for m in (1, 2, 5, 10) if m * unit >= raw - 1e-12)
    first = math.ceil(low / step - 1e-9)
    return [i * step for i in range(first, int(math.floor(high / step + 1e-9)) + 1)]


class Panel:
    """One pair of axes, `index` panels from the left."""

    def __init__(self, index, x_range, y_range, x_label, y_label, title=""):
        self.x_range, self.y_range, self.left = x_range, y_range, index * WIDTH
        self.body = []
        right, bottom = self.left + WIDTH - RIGHT, HEIGHT - BOTTOM
        for v in steps(*x_range):
            self.line(self.x(v), TOP, self.x(v), bottom, "g")
            self.text(self.x(v), bottom + 14, f"{v:g}", "middle")
        for v in steps(*y_range):
            self.line(self.left + LEFT, self.y(v), right, self.y(v), "g")
            self.text(self.left + LEFT - 5, self.y(v) + 4, f"{v:g}", "end")
        self.line(self.left + LEFT, bottom, right, bottom, "a")
        self.line(self.left + LEFT, TOP, self.left + LEFT, bottom, "a")
        middle = self.left + (LEFT + WIDTH - RIGHT) / 2
        self.text(middle, HEIGHT - 10, x_label, "middle", "t")
        self.text(self.left + LEFT, 13, y_label, "start", "t")
        if title:
            self.text(right, 13, title, "end")

    def x(self, v):
        low, high = self.x_range
        return self.left + LEFT + (v - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    def y(self, v):
        low, high = self.y_range
        return HEIGHT - BOTTOM - (v - low) / (high - low) * (HEIGHT - TOP - BOTTOM)

    def line(self, x1, y1, x2, y2, kind):
        self.body.append(
            f"<line x1='{x1:.1f}' y1='{y1:.1f}' x2='{x2:.1f}' y2='{y2:.1f}' class='{kind}'/>")

    def text(self, x, y, words, anchor, kind=""):
        self.body.append(f"<text x='{x:.1f}' y='{y:.1f}' text-anchor='{anchor}' class='{kind}'>"
                         f"{html.escape(words)}</text>")

    def dot(self, x, y, colour, title, bar=0.0):
        if bar:
            self.line(self.x(x), self.y(y - bar), self.x(x), self.y(y + bar), "e")
        self.body.append(
            f"<circle cx='{self.x(x):.1f}' cy='{self.y(y):.1f}' r='3.5' fill='{colour}' "
            f"fill-opacity='.75'><title>{html.escape(title)}</title></circle>")

    def diamond(self, x, y, title):
        """What the paper has."""
        px, py = self.x(x), self.y(y)
        self.body.append(f"<path d='M{px:.1f} {py - 6:.1f}l6 6l-6 6l-6 -6z' class='p'>"
                         f"<title>{html.escape(title)}</title></path>")

    def scatter_bar(self, deviation):
        """The scatter of one run, in the corner."""
        if not deviation:
            return
        x, middle = self.left + WIDTH - RIGHT - 6, TOP + 34
        half = abs(self.y(0) - self.y(deviation))
        self.line(x, middle - half, x, middle + half, "e")
        self.text(x - 6, middle + 4, "scatter of a run", "end")

    def legend(self, names):
        x = self.left + LEFT
        for colour, name in zip(COLOURS, names):
            self.body.append(f"<circle cx='{x + 4}' cy='24' r='3.5' fill='{colour}'/>")
            self.text(x + 11, 28, name, "start")
            x += 24 + 6 * len(name)


def svg(panels, title):
    width = WIDTH * len(panels)
    body = "\n".join(part for panel in panels for part in panel.body)
    return (f"<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{HEIGHT}' "
            f"viewBox='0 0 {width} {HEIGHT}' role='img' aria-label='{html.escape(title)}'>"
            f"{STYLE}\n{body}\n</svg>\n")
