// SPDX-License-Identifier: GPL-3.0-or-later
// Fields along the particles at the final time, against the exact solution.

function profileSection(view) {
  const entries = view.doc.profiles.filter(
    (entry) => view.series.includes(entry.series) && entry.position.length,
  );
  if (entries.length === 0) return null;
  const fields = [...new Set(entries.flatMap((entry) => Object.keys(entry.computed)))];
  const dimension = d3.max(entries, (entry) => entry.position.length);
  const state = {
    field: fields.includes(view.memory.field)
      ? view.memory.field
      : fields.includes(view.choice.field)
        ? view.choice.field
        : fields[0],
    axis: 0,
  };
  const place = element("div", {});
  const drawAll = (changes) => {
    Object.assign(state, changes);
    view.memory.field = state.field;
    place.replaceChildren(profilePanels(view, entries, state));
  };
  drawAll({});
  const axes = d3.range(dimension).map((k) => [String(k), `${["x", "y", "z"][k]} [m]`]);
  return section(
    view.doc,
    "profile",
    "Profiles against the exact solution",
    element(
      "div",
      { class: "choices" },
      select(
        "Field",
        fields.map((f) => [f, f]),
        state.field,
        (field) => drawAll({ field }),
      ),
      dimension > 1 ? select("Along", axes, "0", (axis) => drawAll({ axis: Number(axis) })) : null,
    ),
    element(
      "p",
      { class: "hint" },
      "Of each ladder's finest run that kept its profile, its first replicate. Line (dots in " +
        "2D and 3D): exact. " +
        "Of vectors the first component.",
    ),
    place,
  );
}

function profilePanels(view, entries, { field, axis }) {
  const entriesOf = (series) =>
    entries.filter((entry) => series.includes(entry.series) && entry.computed[field]);
  const values = entries.flatMap((entry) => entry.exact[field] ?? []);
  // Runs that went astray must not hide the others: the exact solution sets the scale.
  const [low, high] = paddedLinear(values);
  const y = [low - 0.35 * (high - low), high + 0.35 * (high - low)];
  return panelGrid(
    bySetting(view).filter(({ series }) => entriesOf(series).length),
    ({ title, series }) => {
      const inPanel = entriesOf(series);
      const rows = inPanel
        .flatMap((entry) =>
          entry.computed[field].map((value, k) => ({
            name: entry.series.name,
            line: entry.series.index,
            x: entry.position[axis][k],
            value,
            entry,
          })),
        )
        .filter((row) => row.value !== null);
      const longest = d3.greatest(inPanel, (entry) => entry.position[0].length);
      const isCurve = longest.position.length === 1;
      const exact = (isCurve ? [longest] : inPanel)
        .flatMap((entry) =>
          (entry.exact[field] ?? []).map((value, k) => ({
            x: entry.position[axis][k],
            value,
          })),
        )
        .filter((row) => row.value !== null);
      const outside = rows.filter((row) => row.value < y[0] || row.value > y[1]).length;
      const plot = Plot.plot(
        plotOptions(`Profile: ${field}, ${title}`, {
          x: { label: `${["x", "y", "z"][axis]} [m] →`, ticks: 6 },
          y: { domain: y, label: `↑ ${field}`, grid: true, ticks: 5, tickFormat: formatNumber, clamp: true },
          marks: [
            ...dotMark(view, rows, "x", "value", { r: 2.4, strokeWidth: 1, fillOpacity: 0.75 }),
            isCurve
              ? Plot.line(
                  d3.sort(exact, (row) => row.x),
                  {
                    x: "x",
                    y: "value",
                    stroke: "var(--ink)",
                    strokeWidth: 1.6,
                    ariaDescription: "exact",
                  },
                )
              : Plot.dot(exact, { x: "x", y: "value", r: 1.2, fill: "var(--ink)", ariaDescription: "exact" }),
            tips(
              rows,
              "x",
              "value",
              (row) => `${row.name}\nx = ${formatNumber(row.x)}: ${formatNumber(row.value)}`,
            ),
          ],
        }),
      );
      const failed = inPanel.filter((entry) => entry.run.status !== "ok").map((entry) => entry.series.name);
      const remarks = [
        outside ? `${plural(outside, "point")} beyond the axis, drawn at its edge` : "",
        failed.length ? `failed: ${failed.join(", ")}` : "",
      ].filter(Boolean);
      return figure(
        view,
        `${field}, ${title}`,
        plot,
        [...new Set(rows.map((row) => row.name))],
        [title, ...remarks].join(" — "),
      );
    },
  );
}
