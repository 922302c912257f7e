// SPDX-License-Identifier: GPL-3.0-or-later
// Error over run time. On the Pareto front nothing measured is both faster and nearer.

function costRows(view) {
  const rows = [];
  for (const s of view.series) {
    const entry = orderEntry(s, view.choice);
    if (!entry) continue;
    s.levels.forEach((level, k) => {
      const error = entry.errors[k];
      if (error === null || error <= 0 || !(level.time.seconds > 0)) return;
      rows.push({
        name: s.name,
        line: s.index,
        series: s,
        level,
        ...level.time,
        error: error / (view.isRelative ? entry.scale : 1),
      });
    });
  }
  return rows;
}

function paretoFront(rows) {
  let smallest = Infinity;
  return d3
    .sort(
      rows,
      (row) => row.seconds,
      (row) => row.error,
    )
    .filter((row) => {
      if (row.error >= smallest) return false;
      smallest = row.error;
      return true;
    });
}

function costSection(view) {
  const rows = costRows(view);
  if (rows.length === 0) return null;
  const front = paretoFront(rows);
  const timed = rows.filter((row) => row.low > 0 && row.high !== null);
  const x = paddedLog(rows.flatMap((row) => [row.seconds, row.low, row.high]));
  const y = paddedLog(rows.map((row) => row.error));
  const title = `Error against run time, ${view.one.name}, region ${view.choice.region}`;
  const label = `${view.isRelative ? "relative " : ""}${view.choice.norm} error of ${view.choice.field}`;
  const setting = (row) => `${settingText(row.series, view.varying)} · N = ${row.level.resolution}`;
  const error = (row) => (view.isRelative ? formatPercent(row.error) : formatNumber(row.error));
  const plot = Plot.plot(
    plotOptions(`${title}: ${label}`, {
      width: view.width,
      height: Math.min(460, Math.max(300, 0.6 * view.width)),
      x: { type: "log", domain: x, ...decades(x), label: "run time [s] →" },
      y: { type: "log", domain: y, ...decades(y), grid: true, label: `↑ ${label}` },
      marks: [
        view.isRelative && y[0] < 0.01 && y[1] > 0.01
          ? Plot.ruleY([0.01], { stroke: "var(--quiet)", strokeDasharray: "1 3" })
          : null,
        Plot.line(front, {
          x: "seconds",
          y: "error",
          curve: "step-after",
          stroke: "var(--front)",
          strokeWidth: 5,
          strokeOpacity: 0.35,
          ariaDescription: "Pareto front",
        }),
        ...lineMark(view, rows, "seconds", "error", { strokeWidth: 1, strokeOpacity: 0.45 }),
        Plot.ruleY(timed, {
          x1: "low",
          x2: "high",
          y: "error",
          stroke: (row) => view.styles.get(row.name).colour,
          strokeWidth: 1.2,
          marker: "tick",
          ariaDescription: "interval of the run time",
        }),
        ...dotMark(view, rows, "seconds", "error"),
        tips(
          rows,
          "seconds",
          "error",
          (row) => `${row.name}\n${setting(row)}\n${formatTime(row)}, ${error(row)}`,
        ),
      ],
    }),
  );
  const list = element(
    "ol",
    { class: "front" },
    ...front.map((row) =>
      element("li", {}, `${formatTime(row)}: ${error(row)}, ${row.name}, ${setting(row)}`),
    ),
  );
  const drawn = figure(view, title, plot, [...new Set(rows.map((row) => row.name))]);
  drawn.classList.add("single");
  const failed = view.series.filter((s) => s.levels.some((level) => level.failed > 0));
  return section(
    view.doc,
    "cost",
    "Error against run time",
    element(
      "p",
      { class: "hint" },
      "One line for each ladder, coarse to fine; the broad band is the Pareto front: " +
        "nothing measured here is both faster and nearer." +
        (timed.length ? " Bars: 95% interval of the median run time." : "") +
        (failed.length
          ? ` Levels that failed have neither error nor time: ${plural(failed.length, "ladder")} of ` +
            `${view.series.length} have some, listed under Failures.`
          : ""),
    ),
    disturbanceNote(view.doc),
    drawn,
    element(
      "details",
      { class: "front-list" },
      element("summary", {}, `The front, ${plural(front.length, "point")}`),
      list,
    ),
  );
}
