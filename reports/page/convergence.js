// SPDX-License-Identifier: GPL-3.0-or-later
// Error over resolution, both logarithmic: the levels with the replicates' spread, what was fitted to them, and slopes
// to compare with.

function convergenceRows(view, series) {
  const rows = [];
  const failures = [];
  for (const s of series) {
    const entry = orderEntry(s, view.choice);
    const scale = view.isRelative && entry ? entry.scale : 1;
    s.levels.forEach((level, k) => {
      const row = { name: s.name, series: s, level };
      if (level.failed > 0) failures.push(row);
      const error = entry?.errors[k] ?? null;
      if (error === null) return;
      const over = (value) => (value === null ? null : value / scale);
      rows.push({
        ...row,
        entry,
        scale,
        error: error / scale,
        spread: over(entry.spreads[k]),
        mean: over(entry.means[k]),
      });
    });
  }
  return { rows, failures };
}

// Falls through the middle of the errors at the coarsest level as dx^order.
function referenceSlopes(rows, resolutions) {
  const [coarsest, finest] = d3.extent(resolutions);
  const start = rows
    .filter((row) => row.level.resolution === coarsest && row.error > 0)
    .map((row) => row.error);
  if (start.length === 0 || coarsest === finest) return [];
  const middle = Math.exp(d3.mean(start, Math.log));
  const allowed = d3.max(rows, (row) => row.entry.allowed);
  return [allowed / 2, allowed]
    .filter((order) => order > 0)
    .map((order) => ({
      order,
      points: [
        { x: coarsest, y: middle },
        { x: finest, y: middle * (coarsest / finest) ** order },
      ],
    }));
}

// What was fitted to each ladder: the law as a curve, the floor with its band, the fan of the order's interval.
function convergenceFits(view, series) {
  return series.flatMap((s) => {
    const entry = orderEntry(s, view.choice);
    if (!entry || entry.errors.every((error) => error === null)) return [];
    const scale = view.isRelative ? entry.scale : 1;
    const { floor } = entry;
    return [
      {
        name: s.name,
        curve: lawCurve(s, entry, scale),
        fan: orderFan(s, entry, scale),
        floor: floor && { value: floor.value / scale, low: floor.lower / scale, high: floor.upper / scale },
      },
    ];
  });
}

// Errors, and what lies near them of laws and floors: a floor far below all errors must not squeeze them.
function convergenceDomain(rows, fits) {
  const errors = rows.flatMap((row) => [row.error, row.error + (row.spread ?? 0)]);
  const [least, most] = d3.extent(errors.filter((error) => error > 0));
  const fitted = fits.flatMap(({ curve, fan, floor }) => [
    ...curve.map(({ y }) => y),
    ...fan.flatMap(({ low, high }) => [low, high]),
    ...(floor ? [floor.value] : []),
  ]);
  return paddedLog([...errors, ...fitted.filter((y) => y > least / 10 && y < 10 * most)]);
}

function fitMarks(view, fits, [bottom, top], [left, right]) {
  const colour = (name) => view.styles.get(name).colour;
  const floors = fits
    .filter(({ floor }) => floor && floor.high > bottom && floor.low < top)
    .map(({ name, floor }) => ({
      name,
      value: floor.value,
      low: Math.max(bottom, floor.low),
      high: Math.min(top, floor.high),
    }));
  return [
    Plot.rect(floors, {
      x1: left,
      x2: right,
      y1: "low",
      y2: "high",
      fill: (floor) => colour(floor.name),
      fillOpacity: 0.1,
      ariaDescription: "interval of the floor",
    }),
    Plot.ruleY(
      floors.filter(({ value }) => value > bottom && value < top),
      {
        y: "value",
        stroke: (floor) => colour(floor.name),
        strokeWidth: 1.2,
        strokeDasharray: "7 2 1 2",
        ariaDescription: "floor",
      },
    ),
    ...fits
      .filter(({ fan }) => fan.length > 0)
      .map(({ name, fan }) =>
        Plot.areaY(fan, {
          x: "x",
          y1: "low",
          y2: "high",
          fill: colour(name),
          fillOpacity: 0.25,
          clip: true,
          ariaDescription: "interval of the order",
        }),
      ),
    ...fits
      .filter(({ curve }) => curve.length > 0)
      .map(({ name, curve }) =>
        Plot.line(curve, {
          x: "x",
          y: "y",
          stroke: colour(name),
          strokeWidth: 1.6,
          strokeDasharray: view.styles.get(name).dash,
          clip: true,
          ariaDescription: "fitted law",
        }),
      ),
  ];
}

function convergenceTip(view, row) {
  const format = view.isRelative ? formatPercent : formatNumber;
  const { entry } = row;
  const spread = row.spread ? ` ± ${format(row.spread)} over ${row.level.replicates}` : "";
  return [
    row.name,
    `N = ${row.level.resolution}: ${format(row.error)}${spread}`,
    row.mean === null ? null : `signed mean ${format(row.mean)}`,
    `order ${formatOrder(entry.order, entry.lower, entry.upper)}, ${entry.verdict}`,
    entry.reason,
    ...lawLines(entry, row.scale, format),
  ]
    .filter(Boolean)
    .join("\n");
}

function convergencePanel(view, { title, series }, resolutions, domain, reach) {
  const { rows, failures } = convergenceRows(view, series);
  const fits = convergenceFits(view, series);
  const label = `${view.isRelative ? "relative " : ""}${view.choice.norm} error of ${view.choice.field}`;
  const shown = rows.filter((row) => row.error > 0);
  const slopes = referenceSlopes(shown, resolutions);
  const x = paddedLog([...resolutions, reach], 1.15);
  // Where a law was fitted the levels are joined faintly, so that the law stands out.
  const fitted = new Set(fits.filter(({ curve }) => curve.length).map(({ name }) => name));
  const byFit = d3.group(shown, (row) => fitted.has(row.name));
  const resolution = (row) => row.level.resolution;
  const plot = Plot.plot(
    plotOptions(`Convergence: ${label}, ${title}`, {
      x: {
        type: "log",
        domain: x,
        ticks: resolutions,
        tickFormat: String,
        label: "particles along the first axis, N →",
      },
      y: { type: "log", domain, ...decades(domain), grid: true, label: `↑ ${label}` },
      marks: [
        view.isRelative && domain[0] < 0.01 && domain[1] > 0.01
          ? Plot.ruleY([0.01], { stroke: "var(--quiet)", strokeDasharray: "1 3" })
          : null,
        ...slopes.map((slope) =>
          Plot.line(slope.points, {
            x: "x",
            y: "y",
            stroke: "var(--quiet)",
            strokeWidth: 1,
            strokeDasharray: "6 3",
            clip: true,
            ariaDescription: "reference slope",
          }),
        ),
        ...slopes.map((slope) => slopeLabel(slope, domain)),
        ...fitMarks(view, fits, domain, x),
        Plot.ruleX(
          shown.filter((row) => row.spread > 0),
          {
            x: resolution,
            y1: (row) => Math.max(domain[0], row.error - row.spread),
            y2: (row) => row.error + row.spread,
            stroke: (row) => view.styles.get(row.name).colour,
            strokeWidth: 1.2,
            marker: "tick",
            ariaDescription: "spread of replicates",
          },
        ),
        ...lineMark(view, byFit.get(true) ?? [], resolution, "error", {
          strokeWidth: 0.8,
          strokeOpacity: 0.5,
        }),
        ...lineMark(view, byFit.get(false) ?? [], resolution, "error"),
        ...dotMark(view, shown, resolution, "error"),
        ...failureMark(view, failures, resolution, () => domain[1]),
        tips(shown, resolution, "error", (row) => convergenceTip(view, row)),
        tips(
          failures,
          resolution,
          () => domain[1],
          (row) =>
            `${row.name}\nN = ${row.level.resolution}: ` +
            `${row.level.failed} of ${row.level.replicates} ${row.level.status}`,
        ),
      ],
    }),
  );
  const failed = [...new Set(failures.map((row) => row.name))];
  return figure(
    view,
    title,
    plot,
    [...new Set(series.map((s) => s.name))],
    failed.length ? `${title} — failed: ${failed.join(", ")}` : title,
  );
}

function convergenceSection(view) {
  const all = convergenceRows(view, view.series);
  if (all.rows.length === 0 && all.failures.length === 0) return null;
  const fits = convergenceFits(view, view.series);
  const resolutions = [...new Set(view.series.flatMap((s) => s.levels.map((l) => l.resolution)))].sort(
    d3.ascending,
  );
  const domain = convergenceDomain(all.rows, fits);
  const reach = d3.max(fits, ({ curve, fan }) => Math.max(curve.at(-1)?.x ?? 0, fan.at(-1)?.x ?? 0)) ?? 0;
  const zeros = all.rows.filter((row) => !(row.error > 0)).length;
  return section(
    view.doc,
    "convergence",
    "Convergence",
    element(
      "p",
      { class: "hint" },
      "Each panel is one setting. " +
        (fits.some(({ curve }) => curve.length)
          ? "Curves: the law that was fitted to the levels, one doubling beyond the finest. "
          : "") +
        (fits.some(({ fan }) => fan.length)
          ? "Fans beyond the finest level: where the error goes within the order's 95% interval. "
          : "") +
        (fits.some(({ floor }) => floor)
          ? "Dash-dotted, with a band: the floor, which the error never falls below, and its 95% interval. "
          : "") +
        "Bars: standard deviation of the replicates. Dashed grey: " +
        "the highest order that the solution allows, and half of it. Dotted: 1%. Crosses at the top: runs that " +
        "failed." +
        (zeros ? ` ${plural(zeros, "error")} of exactly 0 cannot be drawn on a logarithmic axis.` : ""),
    ),
    panelGrid(bySetting(view), (group) => convergencePanel(view, group, resolutions, domain, reach)),
  );
}

// Stands where the slope leaves the panel, or at its end.
function slopeLabel({ order, points: [a, b] }, [low]) {
  const y = Math.max(b.y, low);
  const x = b.x * (y / b.y) ** (-1 / order);
  return Plot.text([{ x, y }], {
    x: "x",
    y: "y",
    text: () => `${order}`,
    dx: 8,
    dy: -6,
    fill: "var(--muted)",
    fontSize: 11,
  });
}
