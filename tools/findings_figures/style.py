# SPDX-License-Identifier: GPL-3.0-or-later
"""How figures look, and how they are written: text as text, ink in the reader's colour, the same bytes every time."""

import io
import math
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

INK = "#010203"  # drawn with, and replaced by the colour of the reader's scheme
LIGHT, DARK = "#1f2328", "#e6edf3"  # text on GitHub's white and on its #0d1117

# After Okabe & Ito, each with a contrast of at least 3.4 to white and to #0d1117.
COLOURS = ("#1f7fc4", "#d55e00", "#009e73", "#c05fae", "#9a7b00", "#808080")
MARKERS = ("o", "s", "^", "D", "v", "P")
DASHES = ("-", (0, (5, 2)), (0, (1, 1.5)), (0, (6, 2, 1, 2)), (0, (3, 1, 1, 1, 1, 1)), (0, (8, 3)))

plt.rcParams.update({
    "svg.fonttype": "none",
    "svg.hashsalt": "sphverify",
    "font.family": "sans-serif",
    "font.size": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10,
    "axes.ymargin": 0.12,  # room for the crosses of runs that broke
    "axes.grid": True,
    "grid.alpha": 0.15,
    "grid.linewidth": 0.8,
    "legend.frameon": False,
    "figure.constrained_layout.w_pad": 0.08,
    "xtick.minor.pad": 5.0,
    "ytick.minor.pad": 5.0,
    "lines.linewidth": 1.6,
    "lines.markersize": 6,
    **{name: INK for name in ("text.color", "axes.edgecolor", "axes.labelcolor", "axes.titlecolor", "xtick.color",
                              "ytick.color", "grid.color")},
})

BROKE = "a run broke"  # what a cross means

SCHEME = f"<style>svg {{ color: {LIGHT} }} @media (prefers-color-scheme: dark) {{ svg {{ color: {DARK} }} }}</style>"


def panels(count=1, height=3.4, **options):
    """A figure and its axes beside each other."""
    figure, axes = plt.subplots(1, count, figsize=(7.4, height), squeeze=False, layout="constrained", **options)
    return figure, list(axes[0])


def look(index):
    """Colour, marker and dash of a series, each enough to tell it from others."""
    return {"color": COLOURS[index], "marker": MARKERS[index], "linestyle": DASHES[index], "markerfacecolor": "none"}


def plain_numbers(axis, numbers=None):
    """1e-3 as the tables print it, not 10 with a raised -3; places given are labelled alone."""

    def plain(value, _):
        return f"{value:g}" if 1e-2 < abs(value) < 1e4 or value == 0 else tidy(value)

    def between(value, _):
        """A scale of less than two decades has too few powers of ten."""
        first, last = axis.get_view_interval()
        return plain(value, _) if 0 < last < 100 * first and tidy(value)[0] in "25" else ""

    axis.set_major_formatter(plain)
    axis.set_minor_formatter(between)
    if numbers:
        axis.set_major_locator(matplotlib.ticker.FixedLocator(numbers))
        axis.set_minor_locator(matplotlib.ticker.NullLocator())


def decades(limits):
    """Powers of ten within limits, for narrow panels; none where they are less than two, so that others are labelled."""
    first, last = (math.log10(limit) for limit in limits)
    powers = [10.0 ** power for power in range(math.ceil(first), math.floor(last) + 1)]
    return powers if len(powers) > 1 else None


def tidy(value):
    return re.sub(r"e([+-])0*", lambda sign: "e-" if sign[1] == "-" else "e", f"{value:.0e}")


def legend(figure, columns=None):
    """Above all panels, where no data are. What several panels hold is named once."""
    named = {}
    for axes in figure.axes:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            named.setdefault(label, handle)
    if BROKE in named:
        named[BROKE] = named.pop(BROKE)  # last
    columns = columns or -(-len(named) // -(-len(named) // 4))
    rows = -(-len(named) // columns)
    figure.legend(named.values(), named.keys(), loc="upper center", ncol=columns, handlelength=3.2)
    share = (0.1 + 0.21 * rows) / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - share))


def save(figure, path):
    written = io.StringIO()
    figure.savefig(written, format="svg", transparent=True,
                   metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(figure)
    svg = written.getvalue().replace(INK, "currentColor")
    # What matplotlib measured with is not what the reader has.
    svg = re.sub(r"font: ([^;\"]*?px) [^;\"]*", r"font: \1 sans-serif", svg)
    svg = re.sub(r"[ \t]+$", "", svg, flags=re.MULTILINE)
    path.write_text(svg.replace("<defs>", SCHEME + "\n <defs>", 1))
