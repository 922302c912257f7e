// Error over resolution, both logarithmic, with the replicates' spread and slopes to compare with.

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
      const spread = entry.spreads[k];
      rows.push({ ...row, entry, error: error / scale, spread: spread === null ? null : spread / scale });
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

function convergenceSection(view) {
  const groups = bySetting(view);
  const all = convergenceRows(view, view.series);
  if (all.rows.length === 0 && all.failures.length === 0) return null;
  const positive = all.rows.filter((row) => row.error > 0);
  const resolutions = [...new Set(view.series.flatMap((s) => s.levels.map((l) => l.resolution)))].sort(
    d3.ascending,
  );
  const top = d3.max(positive, (row) => row.error + (row.spread ?? 0));
  const domain = paddedLog([...positive.map((row) => row.error), ...(top ? [top] : [])]);
  const label = `${view.isRelative ? "relative " : ""}${view.choice.norm} error of ${view.choice.field}`;
  const draw = ({ title, series }) => {
    const { rows, failures } = convergenceRows(view, series);
    const shown = rows.filter((row) => row.error > 0);
    const slopes = referenceSlopes(shown, resolutions);
    const describe = (row) =>
      `${row.name}\nN = ${row.level.resolution}: ${
        view.isRelative ? formatPercent(row.error) : formatNumber(row.error)
      }${
        row.spread
          ? ` ± ${
              view.isRelative ? formatPercent(row.spread) : formatNumber(row.spread)
            } over ${row.level.replicates}`
          : ""
      }\norder ${formatOrder(row.entry.order, row.entry.lower, row.entry.upper)}, ${row.entry.verdict}`;
    const plot = Plot.plot(
      plotOptions(`Convergence: ${label}, ${title}`, {
        x: {
          type: "log",
          domain: paddedLog(resolutions, 1.15),
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
          Plot.ruleX(
            shown.filter((row) => row.spread > 0),
            {
              x: (row) => row.level.resolution,
              y1: (row) => Math.max(domain[0], row.error - row.spread),
              y2: (row) => row.error + row.spread,
              stroke: (row) => view.styles.get(row.name).colour,
              strokeWidth: 1.2,
              marker: "tick",
              ariaDescription: "spread of replicates",
            },
          ),
          ...lineMark(view, shown, (row) => row.level.resolution, "error"),
          ...dotMark(view, shown, (row) => row.level.resolution, "error"),
          ...failureMark(
            view,
            failures,
            (row) => row.level.resolution,
            () => domain[1],
          ),
          tips(shown, (row) => row.level.resolution, "error", describe),
          tips(
            failures,
            (row) => row.level.resolution,
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
  };
  const zeros = all.rows.length - positive.length;
  return section(
    view.doc,
    "convergence",
    "Convergence",
    element(
      "p",
      { class: "hint" },
      "Each panel is one setting. Bars: standard deviation of the replicates. Dashed grey: " +
        "the highest order that the solution allows, and half of it. Dotted: 1%. Crosses at the top: runs that " +
        "failed." +
        (zeros ? ` ${plural(zeros, "error")} of exactly 0 cannot be drawn on a logarithmic axis.` : ""),
    ),
    panelGrid(groups, draw),
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
