# SPDX-License-Identifier: GPL-3.0-or-later
"""Kinds of figures. Each takes a table of series: what a reader calls it, and the traits that choose its runs."""

import math

from . import results, style


class Series:
    """Series("mirror", walls="mirror", pair_weight="kernel"); `look` is one of style.look's, for a form that several
    figures show alike."""

    def __init__(self, name, look=None, **traits):
        self.name, self.look, self.traits = name, look, traits

    def runs(self, document, where):
        wanted = {**where, **self.traits}
        found = results.select(document["runs"], **wanted)
        if not found:
            raise results.ResultsError(f"series {self.name}: no run has {wanted}")
        return found

    def points(self, document, where, **how):
        try:
            return results.points(self.runs(document, where), **how)
        except results.ResultsError as error:
            raise results.ResultsError(f"series {self.name}: {error}")


def curves(axes, document, table, where, along="resolution", y=None, x=None, middle=results.geometric_mean):
    """A curve for each series, a band from the least to the largest over seeds, a cross where runs broke."""
    rows = 0  # of crosses
    for index, series in enumerate(table):
        points = series.points(document, where, along=along, y=y or results.error(), x=x, middle=middle)
        shown = [point for point in points if math.isfinite(point.x) and math.isfinite(point.y)]
        look = style.look(index if series.look is None else series.look)
        (line,) = axes.plot([p.x for p in shown], [p.y for p in shown], label=series.name, **look)
        line.set_gid(f"series-{index}")
        if any(p.low < p.high for p in shown):
            axes.fill_between([p.x for p in shown], [p.low for p in shown], [p.high for p in shown],
                              color=look["color"], alpha=0.15, linewidth=0)
        broken = [point.x for point in points if point.broken and math.isfinite(point.x)]
        # One row for each series of which a run broke.
        cross(axes, broken, [1.0 - 0.045 * rows] * len(broken), look["color"], axes.get_xaxis_transform())
        rows += bool(broken)


def cross(axes, x, y, colour, transform):
    """Where runs broke, at an edge of the panel."""
    if len(x):
        axes.plot(x, y, "x", color=colour, markersize=5, transform=transform, clip_on=False, label="_broken")
        axes.plot([], [], "x", color=style.INK, markersize=5, label=style.BROKE).pop().set_in_layout(False)


def slope(axes, order, x, y):
    """What an order looks like: a thin line through the ends of x, from y on."""
    end = y * (x[1] / x[0]) ** order
    axes.plot(x, (y, end), color=style.INK, linewidth=0.8, label="_slope")
    axes.annotate("N" + f"{order:g}".translate(str.maketrans("-.0123456789", "⁻·⁰¹²³⁴⁵⁶⁷⁸⁹")), (x[1], end), textcoords="offset points", xytext=(5, -3), fontsize=9)


def against_resolution(axes, document, table, where, y=None, label="l2 error, relative"):
    curves(axes, document, table, where, y=y)
    axes.set(xscale="log", yscale="log", xlabel="N, particles along an axis", ylabel=label)
    style.plain_numbers(axes.xaxis, sorted({run["resolution"] for run in results.select(document["runs"], **where)}))
    style.plain_numbers(axes.yaxis)


def error_against_time(document, table, scenes, along="resolution"):
    """A panel for each scene, {title: traits}: error against run time, a mark for each N, along which a form gets dearer."""
    figure, axes = style.panels(len(scenes), sharey=True)
    for panel, (title, where) in zip(axes, scenes.items()):
        curves(panel, document, table, where, along=along, x=results.seconds)
        panel.set(xscale="log", yscale="log", xlabel="run time [s]", title=title)
        style.plain_numbers(panel.xaxis)
        style.plain_numbers(panel.yaxis)
    axes[0].set_ylabel("l2 error, relative")
    style.legend(figure, columns=2)
    return figure


def error_against_parameter(document, table, scenes, parameter, label):
    """A panel for each scene: error against a parameter of the case, such as the contrast of two conductivities."""
    figure, axes = style.panels(len(scenes), sharey=True)
    figure.supxlabel(label, fontsize=10)
    for panel, (title, where) in zip(axes, scenes.items()):
        curves(panel, document, table, where, along=parameter)
        panel.set(xscale="log", yscale="log", title=title)
        style.plain_numbers(panel.xaxis)
        style.plain_numbers(panel.yaxis)
    axes[0].set_ylabel("l2 error, relative")
    style.legend(figure)
    return figure


def dots(document, forms, treatments, scenes, y=None, label="l2 error, relative"):
    """A panel for each scene, a row for each form, in it a mark for each treatment; a bar from the least to the largest
    over seeds. `forms` and `treatments` are tables of series whose traits are joined; a pair without runs is left out."""
    figure, axes = style.panels(len(scenes), height=1.2 + 0.14 * len(forms) * (len(treatments) + 1), sharey=True)
    for panel, (title, where) in zip(axes, scenes.items()):
        for index, treatment in enumerate(treatments):
            look = {**style.look(index), "linestyle": "none"}
            shown = []
            for row, form in enumerate(forms):
                both = {**where, **form.traits, **treatment.traits}
                if not results.select(document["runs"], **both):
                    continue
                at = row + 0.7 * ((index + 0.5) / len(treatments) - 0.5)
                for point in form.points(document, {**where, **treatment.traits}, along="resolution",
                                         y=y or results.error()):
                    shown.append((at, point))
            (line,) = panel.plot([p.y for _, p in shown], [at for at, _ in shown], label=treatment.name, **look)
            line.set_gid(f"series-{index}")
            panel.hlines([at for at, _ in shown], [p.low for _, p in shown], [p.high for _, p in shown],
                         color=look["color"], linewidth=1.4)
            broken = [at for at, point in shown if point.broken]
            cross(panel, [1.0] * len(broken), broken, look["color"], panel.get_yaxis_transform())
        panel.set(xscale="log", xlabel=label, title=title)
        panel.grid(axis="y", visible=False)
        for between in range(1, len(forms)):
            panel.axhline(between - 0.5, color=style.INK, linewidth=0.8, alpha=0.15)
        style.plain_numbers(panel.xaxis)
    axes[0].set_yticks(range(len(forms)), [form.name for form in forms])
    axes[0].set_ylim(len(forms) - 0.5, -0.5)
    style.legend(figure)
    return figure


def energy_made(document, table, scenes):
    """A panel for each scene: what pairs of particles made or lost of the energy, against N."""
    figure, axes = style.panels(len(scenes), sharey=True)
    for panel, (title, where) in zip(axes, scenes.items()):
        against_resolution(panel, document, table, where, y=results.energy_made, label="")
        panel.set_title(title)
    axes[0].set_ylabel("energy made or lost, relative")
    style.legend(figure)
    return figure


def signed_decades(axis, least, most):
    """Decades on either side of zero; what is smaller than `least` lies on it."""
    axis.axes.set_yscale("symlog", linthresh=10.0 ** least, linscale=0.6)
    decades = [10.0 ** power for power in range(most, least, -3)]
    style.plain_numbers(axis, [-d for d in decades] + [0.0] + decades)
