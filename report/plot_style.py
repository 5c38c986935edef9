"""Style shared by the figures of a flowslide report."""
import matplotlib

matplotlib.use("Agg")
matplotlib.rcdefaults()
matplotlib.rcParams.update({
    "font.size": 8, "axes.titlesize": 8, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "axes.linewidth": 0.6, "xtick.major.width": 0.6, "ytick.major.width": 0.6,
    "lines.linewidth": 1.2, "legend.fontsize": 7.5, "legend.frameon": False,
    "svg.hashsalt": "flowslide", "savefig.dpi": 220})

WIDTH = 7.2  # inches, the text width of a page
INK = "0.15"
# Okabe and Ito's palette, distinguishable with any colour vision.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9")
