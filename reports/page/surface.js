// SPDX-License-Identifier: GPL-3.0-or-later
// The error over N and h/dx: what was measured cell by cell, the fitted law as contour lines, the best h/dx at each N,
// the path of least cost, and beside it the neighbour number of Zhu, Hernquist & Li (2015).

const neighbourRule = 0.5;

// Those of the chosen case and formulations; of the chosen field, region and norm where these have surfaces.
function surfacesOf(view) {
  const { choice, state } = view;
  // Controls come last.
  const own = d3
    .sort(view.doc.surfaces, (s) => s.walls === "off")
    .filter(
      (s) =>
        s.caseKey === view.one.key &&
        !state.hidden.has(s.name) &&
        Object.entries(state.settings).every(
          ([key, value]) => value === "" || !(key in s.settings) || s.settings[key] === value,
        ),
    );
  const isChosen = (s) => s.field === choice.field && s.region === choice.region && s.norm === choice.norm;
  return own.some(isChosen) ? own.filter(isChosen) : own;
}

// The exact field's norm, by which errors are divided; 1 where it is 0 or not known.
function surfaceScale(view, surface) {
  const ladder = view.one.series.find((s) => s.label === surface.label && orderEntry(s, surface));
  const scale = ladder ? orderEntry(ladder, surface).scale : 0;
  return scale > 0 ? scale : null;
}

// Half way, on a logarithmic axis, to the neighbours of each value; as far beyond at both ends.
function logEdges(values) {
  const inner = d3.pairs(values, (a, b) => Math.sqrt(a * b));
  const first = values.length > 1 ? values[0] ** 2 / inner[0] : values[0] / 1.4;
  const last = values.length > 1 ? values.at(-1) ** 2 / inner.at(-1) : values[0] * 1.4;
  const edges = [first, ...inner, last];
  return new Map(values.map((value, k) => [value, [edges[k], edges[k + 1]]]));
}

// The path whose cost is run time where it was measured, else the number of pair interactions.
function cheapestPath(surface) {
  return surface.paths.find((p) => p.unit === "seconds") ?? surface.paths[0] ?? null;
}

const costNames = { seconds: "run time", pair_interactions: "pair interactions" };

function surfaceTitle(view, surface) {
  return [surface.name, ...surfaceKeys(view).map((key) => settingText(surface, [key]))].join(" · ");
}

// Settings in which the surfaces differ.
function surfaceKeys(view) {
  return varyingSettings(view.doc.surfaces.filter((s) => s.caseKey === view.one.key));
}

function surfacePanel(view, surface) {
  const scale = surfaceScale(view, surface) ?? 1;
  const format = surfaceScale(view, surface) ? formatPercent : formatNumber;
  const columns = logEdges([...new Set(surface.cells.map((c) => c.resolution))].sort(d3.ascending));
  const rows = logEdges([...new Set(surface.cells.map((c) => c.ratio))].sort(d3.ascending));
  const domain = d3.extent(surface.cells.map((c) => c.error / scale).filter((error) => error > 0));
  const shade = d3.scaleLog().domain(domain).range([0.85, 0.04]).clamp(true);
  const cells = surface.cells.map((c) => ({
    ...c,
    x: columns.get(c.resolution),
    y: rows.get(c.ratio),
    relative: c.error === null ? null : c.error / scale,
  }));
  const known = cells.filter((c) => c.relative > 0);
  const failed = cells.filter((c) => c.error === null);
  const law = surfaceLaw(surface);
  const x = [d3.min(cells, (c) => c.x[0]), d3.max(cells, (c) => c.x[1])];
  const y = [d3.min(cells, (c) => c.y[0]), d3.max(cells, (c) => c.y[1])];
  const inner = { x: d3.extent(columns.keys()), y: d3.extent(rows.keys()) };
  const value = law ? (n, ratio) => law(n, ratio) / scale : betweenCells(known, columns, rows);
  const colour = view.styles.get(surface.name)?.colour ?? "var(--accent)";
  const best = surface.best.filter((b) => b.ratio.value !== null || b.gridRatio !== null);
  const bars = best.filter((b) => b.ratio.lower !== null && b.ratio.upper !== null);
  const path = cheapestPath(surface);
  const rule = path?.rules.find((r) => r.exponent === neighbourRule && r.ratio > 0) ?? null;
  const ruleAt = (resolution) => rule.ratio * (resolution / rule.resolution) ** rule.exponent;
  const title = surfaceTitle(view, surface);
  const plot = Plot.plot(
    plotOptions(`Error surface: ${title}`, {
      height: 330,
      opacity: { type: "identity" },
      x: {
        type: "log",
        domain: x,
        ticks: [...columns.keys()],
        tickFormat: String,
        label: "particles along the first axis, N →",
      },
      y: { type: "log", domain: y, ticks: [...rows.keys()], tickFormat: formatNumber, label: "↑ h/dx" },
      marks: [
        Plot.rect(known, {
          x1: (c) => c.x[0],
          x2: (c) => c.x[1],
          y1: (c) => c.y[0],
          y2: (c) => c.y[1],
          fill: "var(--accent)",
          fillOpacity: (c) => shade(c.relative),
          ariaDescription: "measured error",
        }),
        Plot.dot(failed, {
          x: "resolution",
          y: "ratio",
          r: 5,
          symbol: failureSymbol,
          stroke: "var(--danger)",
          strokeWidth: 2,
          ariaDescription: "failed",
        }),
        ...(value
          ? contourMarks(value, law !== null, format, domain, ...(law ? [x, y] : [inner.x, inner.y]))
          : []),
        rule
          ? Plot.line(
              [path.points[0]?.resolution ?? x[0], x[1]].map((n) => ({ x: n, y: ruleAt(n) })),
              {
                x: "x",
                y: "y",
                stroke: "var(--ink)",
                strokeWidth: 1.6,
                strokeDasharray: "2 3",
                clip: true,
                ariaDescription: "neighbour rule",
              },
            )
          : null,
        path && path.points.length > 1
          ? [
              ["var(--surface)", 6, "border of the path"],
              [colour, 3.5, "path of least cost"],
            ].map(([stroke, strokeWidth, ariaDescription]) =>
              Plot.line(path.points, {
                x: "resolution",
                y: (p) => p.ratio.value,
                stroke,
                strokeWidth,
                clip: true,
                ariaDescription,
              }),
            )
          : null,
        Plot.ruleX(bars, {
          x: "resolution",
          y1: (b) => Math.max(y[0], b.ratio.lower),
          y2: (b) => Math.min(y[1], b.ratio.upper),
          stroke: "var(--ink)",
          strokeWidth: 1.4,
          marker: "tick",
          ariaDescription: "interval of the best h/dx",
        }),
        Plot.dot(best, {
          x: "resolution",
          y: (b) => b.ratio.value ?? b.gridRatio,
          r: 4.5,
          fill: (b) => (b.ratio.value === null ? "var(--surface)" : colour),
          stroke: "var(--ink)",
          strokeWidth: 1.4,
          ariaDescription: "best h/dx",
        }),
        tips(cells, "resolution", "ratio", (c) => surfaceTip(surface, c, scale, format)),
      ],
    }),
  );
  return figure(view, `Error surface, ${title}`, plot, [surface.name], title);
}

function surfaceTip(surface, cell, scale, format) {
  const over = (value) => format(value / scale);
  const lines = [`${surface.name}`, `N = ${cell.resolution}, h/dx ${formatNumber(cell.ratio)}`];
  if (cell.error === null) return [...lines, "a run failed"].join("\n");
  const spread = cell.spread ? ` ± ${over(cell.spread)} over ${cell.replicates}` : "";
  lines.push(`error ${over(cell.error)}${spread}`);
  if (cell.fitted !== null) lines.push(`by the law ${over(cell.fitted)}`);
  if (cell.seconds !== null) lines.push(formatSeconds(cell.seconds));
  return lines.join("\n");
}

// Lines of equal error, of the law or dashed between the cells, each with its number where it ends furthest right.
function contourMarks(value, isLaw, format, [low, high], x, y) {
  const lines = contourLevels(low, high).flatMap((level) =>
    contourLines(value, level, x, y).map((points) => ({ level, points })),
  );
  const labels = [...d3.group(lines, ({ level }) => level)].map(([level, own]) => ({
    level,
    ...d3.greatest(
      own.flatMap(({ points }) => points),
      (p) => p.x,
    ),
  }));
  return [
    Plot.line(
      lines.flatMap(({ points }, line) => points.map((p) => ({ ...p, line }))),
      {
        x: "x",
        y: "y",
        z: "line",
        stroke: "var(--ink)",
        strokeOpacity: 0.8,
        strokeWidth: 1,
        strokeDasharray: isLaw ? null : "5 3",
        ariaDescription: isLaw ? "contours of the law" : "contours between the cells",
      },
    ),
    Plot.text(labels, {
      x: "x",
      y: "y",
      text: (label) => format(label.level),
      fontSize: 10.5,
      fill: "var(--ink)",
      stroke: "var(--surface)",
      strokeWidth: 3,
      textAnchor: "end",
      dx: -3,
      dy: 6,
      ariaDescription: "contour label",
    }),
  ];
}

function estimateText({ value, lower, upper }, format = formatNumber) {
  if (value === null) return "not known";
  return lower === null || upper === null
    ? format(value)
    : `${format(value)} [${format(lower)}, ${format(upper)}]`;
}

// The law's, unless what was measured is to be taken in its place (`advice`: reports/table/surface_advice.hpp).
function bestText({ ratio, gridRatio, edge, advice }) {
  if (ratio.value === null)
    return gridRatio === null ? "not known" : `${formatNumber(gridRatio)} of those tried`;
  const end = edge === "lower" ? " or less" : edge === "upper" ? " or more" : "";
  const byLaw = estimateText(ratio) + end;
  if (advice === "measured")
    return `${formatNumber(gridRatio)} (measured; by the law ${byLaw}, within its misfit)`;
  if (advice === "untried")
    return `${formatNumber(gridRatio)} (measured; by the law ${byLaw}, where no error counts)`;
  return advice === "apart" ? `${byLaw} (by the law; measured ${formatNumber(gridRatio)})` : byLaw;
}

// What the surface says in words: the best h/dx at the ends, the path, the rule's price.
function surfaceSentence(view, surface) {
  const title = surfaceTitle(view, surface);
  const [first, last] = [surface.best[0], surface.best.at(-1)];
  const parts = [];
  if (first) {
    parts.push(
      first === last
        ? `best h/dx ${bestText(first)} at N = ${first.resolution}`
        : `best h/dx ${bestText(first)} at N = ${first.resolution}, ${bestText(last)} at N = ${last.resolution}`,
    );
  }
  const path = cheapestPath(surface);
  if (path && path.points.length < 2 && path.reason) parts.push(`no path: ${path.reason}`);
  if (surface.neighbourExponent.value !== null)
    parts.push(`by the law least cost with neighbours ~ N^${estimateText(surface.neighbourExponent)}`);
  const rule = path?.rules.find((r) => r.exponent === neighbourRule);
  if (rule) {
    const ratio = rule.errorRatio;
    parts.push(
      ratio.value === null
        ? `what neighbours ~ N^0.5 cost is not known${rule.remark ? `: ${rule.remark}` : ""}`
        : `neighbours ~ N^0.5: ${estimateText(ratio, formatRatio)} times the error of the best path at the same ` +
            `${costNames[path.unit] ?? path.unit}${rule.remark ? ` (${rule.remark})` : ""}`,
    );
  }
  if (!surface.law) parts.push(`no law: ${surface.reason || "none fits"}`);
  return ["", `${title}: ${parts.join("; ")}.`];
}

function surfaceTable(view, surfaces) {
  const price = (s) => cheapestPath(s)?.rules.find((r) => r.exponent === neighbourRule) ?? null;
  const none = { value: null, lower: null, upper: null };
  const estimate = (label, of, format = formatNumber) => ({
    label,
    value: (s) => of(s).value,
    text: (s) => estimateText(of(s), format),
  });
  const resolutions = [...new Set(surfaces.flatMap((s) => s.best.map((b) => b.resolution)))].sort(
    d3.ascending,
  );
  const columns = filled(
    [
      { label: "formulation", value: (s) => s.name },
      ...surfaceKeys(view).map((key) => ({ label: key, value: (s) => s.settings[key] ?? null })),
      { label: "error of", value: (s) => `${s.field}, ${s.region}, ${s.norm}` },
      { label: "model", value: (s) => s.model ?? s.reason },
      numberColumn("misfit", (s) => s.misfit, formatPercent),
      estimate("smoothing error ~ h^p: p", (s) => s.smoothingExponent),
      estimate("sampling error ~ (dx/h)^s: s", (s) => s.samplingExponent),
      estimate("sampling error ~ dx^t: t", (s) => s.spacingExponent),
      ...resolutions.map((n) => {
        const best = (s) => s.best.find((b) => b.resolution === n);
        return {
          label: `best h/dx at N = ${n}`,
          value: (s) => best(s)?.ratio.value ?? best(s)?.gridRatio ?? null,
          text: (s) => (best(s) ? bestText(best(s)) : "–"),
        };
      }),
      estimate("neighbours ~ N^k: best k", (s) => s.neighbourExponent),
      numberColumn("k of the cells", (s) => cheapestPath(s)?.gridExponent ?? null),
      estimate("k = 0.5: error / best, same cost", (s) => price(s)?.errorRatio ?? none, formatRatio),
      estimate("k = 0.5: cost / best, same error", (s) => price(s)?.costRatio ?? none, formatRatio),
      { label: "remark", value: (s) => price(s)?.remark || cheapestPath(s)?.reason || null },
    ],
    surfaces,
  );
  return sortableTable("Error surfaces", columns, surfaces);
}

function surfaceSection(view) {
  const surfaces = surfacesOf(view);
  if (surfaces.length === 0) return null;
  const shown = surfaces.filter((s) => s.cells.some((c) => c.error > 0));
  const path = surfaces.map(cheapestPath).find((p) => p !== null);
  const { field, region, norm } = surfaces[0];
  return section(
    view.doc,
    "surface",
    "Where the best h/dx lies",
    element(
      "p",
      { class: "hint" },
      `The ${norm} error of ${field}, region ${region}, over N and h/dx: shaded what was measured, the stronger ` +
        "the smaller (each panel by itself); lines of equal error by the fitted law (dashed: between the cells, " +
        "where no law fits); a point the best h/dx at each N with its 95% interval (hollow: the best of those " +
        "tried). " +
        `Thick: the path of least ${costNames[path?.unit] ?? "cost"} to ever smaller errors. Dotted: from its start ` +
        "a neighbour number that grows as N^0.5, N all particles (Zhu, Hernquist & Li 2015). Crosses: a run failed.",
    ),
    sentenceList(surfaces.map((s) => surfaceSentence(view, s))),
    panelGrid(shown, (s) => surfacePanel(view, s)),
    surfaceTable(view, surfaces),
  );
}
