// SPDX-License-Identifier: GPL-3.0-or-later
// Budgets over time: what pairs and time stepping created, and what each wall gave beyond what it prescribes.

function historyQuantities(entries) {
  const quantities = [];
  const add = (key, label, values) => {
    if (entries.some((entry) => values(entry)?.length)) quantities.push({ key, label, values });
  };
  add("drift", "energy created, relative to the energy", (e) =>
    e.drift.map((v) => (v === null ? null : v / (e.scale || 1))),
  );
  add("energy", "energy [J]", (e) => e.energy);
  add("exchanged", "energy through walls and sources [J]", (e) => e.exchanged);
  add("momentum", "momentum along the first axis [kg m/s]", (e) => e.momentum);
  const walls =
    d3.max(entries, (e) => Math.max(e.wall_impulse_defect.length, e.wall_energy_defect.length)) ?? 0;
  for (let k = 0; k < walls; ++k) {
    add(
      `impulse-${k}`,
      `wall ${k + 1}: impulse beyond the prescribed [kg m/s]`,
      (e) => e.wall_impulse_defect[k],
    );
    add(
      `wall-energy-${k}`,
      `wall ${k + 1}: energy beyond the prescribed [J]`,
      (e) => e.wall_energy_defect[k],
    );
  }
  return quantities;
}

function historySection(view) {
  const entries = view.doc.histories.filter((entry) => view.series.includes(entry.series));
  if (entries.length === 0) return null;
  const quantities = historyQuantities(entries);
  if (quantities.length === 0) return null;
  const place = element("div", {});
  const drawAll = (key) => {
    const quantity = quantities.find((q) => q.key === key);
    view.memory.history = key;
    place.replaceChildren(historyPanels(view, entries, quantity));
  };
  const chosen = quantities.some((q) => q.key === view.memory.history)
    ? view.memory.history
    : quantities[0].key;
  drawAll(chosen);
  return section(
    view.doc,
    "history",
    "Budgets over time",
    element(
      "div",
      { class: "choices" },
      select(
        "Quantity",
        quantities.map((q) => [q.key, q.label]),
        chosen,
        drawAll,
      ),
    ),
    element(
      "p",
      { class: "hint" },
      "Of each ladder's finest run that kept its history, its first replicate. " +
        "A cross ends the history of a run that failed.",
    ),
    place,
  );
}

function historyPanels(view, entries, quantity) {
  const rowsOf = (series) =>
    entries
      .filter((entry) => series.includes(entry.series))
      .flatMap((entry) => {
        const values = quantity.values(entry) ?? [];
        return entry.time
          .map((time, k) => ({
            name: entry.series.name,
            line: entry.series.index,
            time,
            value: values[k],
            entry,
          }))
          .filter((row) => row.value !== null && row.value !== undefined && row.time !== null);
      });
  return panelGrid(
    bySetting(view).filter(({ series }) => rowsOf(series).length),
    ({ title, series }) => {
      const rows = rowsOf(series);
      const ends = [...d3.group(rows, (row) => row.line).values()]
        .map((line) => line.at(-1))
        .filter((row) => row.entry.run.status !== "ok");
      const [low, high] = paddedLinear(rows.map((row) => row.value));
      const plot = Plot.plot(
        plotOptions(`History: ${quantity.label}, ${title}`, {
          marginLeft: 64,
          x: { label: "time [s] →", ticks: 5 },
          y: {
            domain: [low, high],
            label: `↑ ${quantity.label}`,
            grid: true,
            ticks: 5,
            tickFormat: formatNumber,
          },
          marks: [
            low < 0 && high > 0 ? Plot.ruleY([0], { stroke: "var(--quiet)" }) : null,
            ...lineMark(view, rows, "time", "value"),
            // Lines that lie on each other are told apart by a few symbols.
            ...dotMark(
              view,
              rows.filter((row) => isMarked(row)),
              "time",
              "value",
            ),
            ...failureMark(view, ends, "time", "value"),
            tips(
              rows,
              "time",
              "value",
              (row) => `${row.name}\nt = ${formatNumber(row.time)}: ${formatNumber(row.value)}`,
            ),
          ],
        }),
      );
      return figure(
        view,
        `${quantity.label}, ${title}`,
        plot,
        [...new Set(rows.map((row) => row.name))],
        title,
      );
    },
  );
}

// Six symbols on each line, at other places on each.
function isMarked(row) {
  const step = Math.max(1, Math.floor(row.entry.time.length / 6));
  return row.entry.time.indexOf(row.time) % step === row.line % step;
}
