// SPDX-License-Identifier: GPL-3.0-or-later
// What all plots share: axes, one panel for each setting, figures with captions and buttons that save them.

const panelWidth = 380;
const panelHeight = 270;
const mostPanels = 24;
// A failed ladder is drawn as a cross, which no formulation has as its symbol.
const failureSymbol = "times";

// Options of a plot that every section starts from; the caption repeats the aria label in words.
function plotOptions(label, extra) {
  return {
    width: panelWidth,
    height: panelHeight,
    marginLeft: 54,
    marginRight: 16,
    marginTop: 24,
    marginBottom: 40,
    ariaLabel: label,
    color: { type: "identity" },
    symbol: { type: "identity" },
    style:
      "--plot-background: var(--surface); background: none; color: var(--ink); font-family: inherit;" +
      " font-size: 12px; max-width: 100%; height: auto; overflow: visible;",
    ...extra,
  };
}

// Labels on whole decades, and on halves of them where there is hardly one.
function decades([low, high]) {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const step = Math.max(1, Math.ceil((last - first) / 6));
  const ticks = d3.range(first, last + 1, step).map((k) => Number(`1e${k}`));
  if (ticks.length >= 2) return { ticks, tickFormat: formatDecade };
  const finer = d3.range(first - 1, last + 1).flatMap((k) => [1, 2, 5].map((m) => Number(`${m}e${k}`)));
  return { ticks: finer.filter((t) => t >= low && t <= high), tickFormat: formatNumber };
}

// A domain of positive numbers with room at both ends.
function paddedLog(values, room = 1.4) {
  const [low, high] = d3.extent(values.filter((v) => v > 0));
  return low === undefined ? [0.1, 1] : [low / room, high * room];
}

function paddedLinear(values) {
  const [low, high] = d3.extent(values.filter((v) => v !== null && Number.isFinite(v)));
  if (low === undefined) return [0, 1];
  const room = 0.05 * (high - low || Math.abs(high) || 1);
  return [low - room, high + room];
}

// Entries of chosen series, by setting: a list of {title, series}.
function bySetting(view) {
  const keys = view.varying;
  const groups = d3.group(view.series, (s) => settingText(s, keys));
  return [...groups].map(([title, series]) => ({ title, series }));
}

// A figure: plot, caption, buttons. `legend` are the names of the formulations drawn.
function figure(view, title, plot, legend, caption = title) {
  const node = element("figure", { class: "panel" }, plot, element("figcaption", {}, caption));
  const file = `${view.doc.name} ${title}`;
  const subject = {
    plot,
    title,
    legend: legend.map((name) => ({ name, style: view.styles.get(name) })),
    file,
  };
  node.append(
    element(
      "div",
      { class: "save" },
      element(
        "button",
        { type: "button", "aria-label": `Save as SVG: ${title}`, onclick: () => saveSvg(subject) },
        "SVG",
      ),
      element(
        "button",
        { type: "button", "aria-label": `Save as PNG: ${title}`, onclick: () => savePng(subject) },
        "PNG",
      ),
    ),
  );
  return node;
}

// The figures of a section, the first ones at once and the rest when asked for.
function panelGrid(groups, draw) {
  const grid = element("div", { class: "panels" });
  for (const group of groups.slice(0, mostPanels)) grid.append(draw(group));
  if (groups.length <= mostPanels) return grid;
  const more = element(
    "button",
    {
      type: "button",
      class: "more",
      onclick: () => {
        more.remove();
        for (const group of groups.slice(mostPanels)) grid.append(draw(group));
      },
    },
    `Show ${groups.length - mostPanels} more panels`,
  );
  grid.append(more);
  return grid;
}

// Marks of points and lines in a formulation's style; several rows of one name are one line.
function lineMark(view, rows, x, y, extra = {}) {
  return [...d3.group(rows, (row) => row.line ?? row.name)].map(([, line]) => {
    const style = view.styles.get(line[0].name);
    return Plot.line(line, {
      x,
      y,
      stroke: style.colour,
      strokeWidth: 1.6,
      strokeDasharray: style.dash,
      ...extra,
    });
  });
}

function dotMark(view, rows, x, y, extra = {}) {
  return [...d3.group(rows, (row) => row.name)].map(([name, dots]) => {
    const style = view.styles.get(name);
    return Plot.dot(dots, {
      x,
      y,
      r: 3.5,
      symbol: style.symbol,
      stroke: style.colour,
      strokeWidth: 1.4,
      fill: style.hollow ? "var(--surface)" : style.colour,
      ...extra,
    });
  });
}

function failureMark(view, rows, x, y) {
  return [...d3.group(rows, (row) => row.name)].map(([name, dots]) =>
    Plot.dot(dots, {
      x,
      y,
      r: 5,
      symbol: failureSymbol,
      stroke: view.styles.get(name).colour,
      strokeWidth: 2.4,
      ariaDescription: "failed",
      dx: 8 * (([...view.styles.keys()].indexOf(name) % 7) - 3),
    }),
  );
}

// Crosses that tell what is wrong from what is right, in a formulation's colour.
function crossMark(view, rows, x, y, description) {
  return [...d3.group(rows, (row) => row.name)].map(([name, dots]) =>
    Plot.dot(dots, {
      x,
      y,
      r: 5,
      symbol: failureSymbol,
      stroke: view.styles.get(name).colour,
      strokeWidth: 2,
      ariaDescription: description,
    }),
  );
}

// One band for each kind, in it one line for each name: where a dot plot has its dots.
function bandsOf(kinds, names) {
  const lines = names.length + 1;
  const place = (kind, name) => kinds.indexOf(kind) * lines + names.indexOf(name);
  const end = kinds.length * lines;
  // Labels of several words take two lines.
  const longest = d3.max(kinds, (kind) =>
    Math.max(kind.length / 2 + 2, ...kind.split(/[ -]/).map((word) => word.length)),
  );
  return {
    place,
    options: {
      height: 70 + Math.max(13 * end, 40 * kinds.length),
      marginLeft: 24 + 7 * longest,
      y: { domain: [end - 0.5, -1], label: null },
    },
    marks: [
      Plot.axisY(
        kinds.map((_, k) => k * lines + 0.5 * (names.length - 1)),
        { tickFormat: (_, k) => kinds[k], tickSize: 0, lineWidth: 0.6 * longest, label: null },
      ),
      Plot.ruleY(
        kinds.slice(1).map((_, k) => (k + 1) * lines - 1),
        { stroke: "var(--rule)" },
      ),
    ],
  };
}

// What a caption says where no mode is drawn as growing.
function noGrowthText(entries) {
  return entries.some((entry) => entry.growing === null)
    ? "the document does not say what grows"
    : "nothing grows";
}

function tips(rows, x, y, title) {
  return Plot.tip(
    rows,
    Plot.pointer({ x, y, title, fontSize: 12, fill: "var(--surface)", stroke: "var(--rule)" }),
  );
}
