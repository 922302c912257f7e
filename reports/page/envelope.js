// SPDX-License-Identifier: GPL-3.0-or-later
// How far a parameter can be driven before a run breaks: every value that was tried.

function envelopeSection(doc) {
  if (doc.envelopes.length === 0) return null;
  const view = { doc, styles: stylesOf(doc.envelopes) };
  const groups = [...d3.group(doc.envelopes, (e) => `${e.case}: ${e.parameter}`)].map(
    ([title, envelopes]) => ({ title, envelopes }),
  );
  return section(
    doc,
    "envelope",
    "Stability envelope",
    element(
      "p",
      { class: "hint" },
      "One row for each formulation and setting. The bar goes from where the study begins to the last value " +
        "that held; " +
        "filled: held, cross: failed.",
    ),
    panelGrid(groups, (group) => envelopePanel(view, group)),
  );
}

function envelopePanel(view, { title, envelopes }) {
  const keys = varyingSettings(envelopes);
  const row = (e) => [e.name, ...keys.map((key) => e.settings[key])].join(" · ");
  const isLogarithmic =
    envelopes.every((e) => e.logarithmic) && envelopes.every((e) => e.points.every((p) => p.value > 0));
  const points = envelopes.flatMap((e) => e.points.map((p) => ({ ...p, row: row(e), name: e.name })));
  const { from } = view.doc.study.envelope;
  const values = [from, ...points.map((p) => p.value), ...envelopes.flatMap((e) => [e.held, e.failed])].filter(
    (v) => v !== null,
  );
  const x = isLogarithmic ? paddedLog(values) : paddedLinear(values);
  const held = envelopes.filter((e) => e.held !== null);
  const longest = d3.max(envelopes, (e) => row(e).length);
  const width = plotWidth(null);
  const marginLeft = Math.min(0.45 * width, 24 + 6.6 * longest);
  const rows = new Set(envelopes.map(row)).size;
  const plot = Plot.plot(
    plotOptions(`Stability envelope: ${title}`, {
      width,
      marginLeft,
      height: 70 + 36 * rows,
      x: {
        type: isLogarithmic ? "log" : "linear",
        domain: x,
        label: `${envelopes[0].parameter} →`,
        ...(isLogarithmic ? decades(x) : { ticks: 6 }),
      },
      marks: [
        // Long names take several lines.
        Plot.axisY({ label: null, lineWidth: (marginLeft - 16) / 12 }),
        Plot.ruleY(held, {
          x1: from,
          x2: "held",
          y: row,
          stroke: (e) => view.styles.get(e.name).colour,
          strokeWidth: 6,
          strokeOpacity: 0.35,
          ariaDescription: "held",
        }),
        ...dotMark(
          view,
          points.filter((p) => p.status === "ok"),
          "value",
          "row",
        ),
        Plot.dot(
          points.filter((p) => p.status !== "ok"),
          {
            x: "value",
            y: "row",
            r: 5,
            symbol: failureSymbol,
            stroke: "var(--danger)",
            strokeWidth: 2,
            ariaDescription: "failed",
          },
        ),
        tips(points, "value", "row", (p) => `${p.row}\n${formatNumber(p.value)}: ${p.status}`),
      ],
    }),
  );
  const words = envelopes.map(
    (e) =>
      `${row(e)}: holds ${e.held === null ? "nowhere that was tried" : `to ${formatNumber(e.held)}`}` +
      `${e.failed === null ? ", no failure found" : `, ${e.status} at ${formatNumber(e.failed)}`}` +
      `${e.reason ? ` (${e.reason})` : ""}`,
  );
  const node = figure(view, title, plot, [...new Set(envelopes.map((e) => e.name))]);
  node.classList.add("wide");
  node.append(
    element(
      "details",
      {},
      element("summary", {}, "In words"),
      element("ul", {}, ...words.map((text) => element("li", {}, text))),
    ),
  );
  return node;
}
