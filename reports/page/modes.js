// SPDX-License-Identifier: GPL-3.0-or-later
// The mode that grows most, or decays least: how fast, how short, and where. Then all modes of a gas about rest.

function modeRows(view) {
  return view.doc.stabilities
    .filter((entry) => view.series.includes(entry.series))
    .map((entry) => ({
      ...entry,
      name: entry.series.name,
      isKnown: entry.growing !== null || entry.worst !== null,
      wavelength: entry.worst?.wavelength ?? null,
      wallShare: entry.worst?.wallShare ?? null,
    }));
}

function modeSection(view) {
  const rows = modeRows(view);
  if (rows.length === 0) return null;
  const sentences = [...d3.group(rows, (row) => row.name)].map(([name, own]) => {
    const known = own.filter((row) => row.isKnown);
    const unknown = own.find((row) => !row.isKnown);
    const why = unknown?.remark ? `: ${unknown.remark}` : "";
    if (known.length === 0) return ["", `${name}: not known${why}.`];
    const rest = unknown ? ` Not known of ${own.length - known.length}${why}.` : "";
    const growing = known.filter((row) => row.grows);
    if (growing.length === 0)
      return ["good", `${name}: no mode grows in ${plural(known.length, "run")}.${rest}`];
    const worst = d3.greatest(growing, (row) => row.worst?.growth);
    return [
      "bad",
      `${name}: modes grow in ${growing.length} of ${plural(known.length, "run")}, fastest at ` +
        `${formatNumber(worst.worst?.growth)}/s in waves of ${formatNumber(worst.wavelength)} dx.${rest}`,
    ];
  });
  return section(
    view.doc,
    "modes",
    "Worst modes",
    element(
      "p",
      { class: "hint" },
      "Of each ladder's finest resolution, every replicate: the mode that grows most, or decays least. The plot " +
        "shows how short its waves are and how much of it lies within 2h of a wall; crosses grow.",
    ),
    sentenceList(sentences),
    modePanels(view, rows),
    modeTable(view, rows),
  );
}

function modePanels(view, all) {
  const placed = all.filter((row) => row.wavelength !== null && row.wallShare !== null);
  if (placed.length === 0) return null;
  const rowsOf = (series) => placed.filter((row) => series.includes(row.series));
  const x = paddedLog(placed.map((row) => row.wavelength));
  return panelGrid(
    bySetting(view).filter(({ series }) => rowsOf(series).length),
    ({ title, series }) => {
      const rows = rowsOf(series);
      const plot = Plot.plot(
        plotOptions(`Worst modes: ${title}`, {
          x: { type: "log", domain: x, ...decades(x), grid: true, label: "wavelength [dx] →" },
          y: {
            domain: [0, 1],
            ticks: 5,
            tickFormat: formatPercent,
            grid: true,
            label: "↑ within 2h of a wall",
          },
          marks: [
            ...dotMark(
              view,
              rows.filter((row) => !row.grows),
              "wavelength",
              "wallShare",
              { ariaDescription: "worst mode" },
            ),
            ...crossMark(
              view,
              rows.filter((row) => row.grows),
              "wavelength",
              "wallShare",
              "growing mode",
            ),
            tips(
              rows,
              "wavelength",
              "wallShare",
              (row) =>
                `${row.name}\ngrowth ${formatNumber(row.worst.growth)}/s, ${formatNumber(row.wavelength)} dx, ` +
                `${formatPercent(row.wallShare)} near a wall`,
            ),
          ],
        }),
      );
      return figure(view, `Worst modes, ${title}`, plot, [...new Set(rows.map((row) => row.name))], title);
    },
  );
}

function modeTable(view, rows) {
  const columns = filled(
    [
      ...runColumns(view.series),
      numberColumn("growth [1/s]", (row) => row.worst?.growth ?? null),
      numberColumn("growth / radius", growthOverRadius),
      numberColumn("frequency [1/s]", (row) => row.worst?.frequency ?? null),
      numberColumn("wavelength [dx]", (row) => row.wavelength),
      numberColumn("part near a wall", (row) => row.wallShare, formatPercent),
      {
        label: "centre [m]",
        value: (row) => row.worst?.centre[0] ?? null,
        text: (row) => placeText(row.worst?.centre),
      },
      growthColumn(),
      numberColumn("unseen modes", (row) => row.unseen),
      { label: "eigenvalues by", value: (row) => row.method },
      { label: "remark", value: (row) => row.remark },
    ],
    rows,
  );
  return sortableTable("Worst modes", columns, rows, (row) => (row.grows ? "failed" : null));
}

function growthOverRadius(row) {
  return row.worst && row.run.spectral_radius > 0 ? row.worst.growth / row.run.spectral_radius : null;
}

function placeText(position) {
  return position?.length ? position.map(formatNumber).join(", ") : "–";
}

function perturbationSection(view) {
  const entries = view.doc.perturbations.filter((entry) => view.series.includes(entry.series));
  if (entries.length === 0) return null;
  const quantities = [
    ["growth", "growth [1/s]"],
    ["frequency", "frequency [1/s]"],
  ];
  const place = element("div", {});
  const drawAll = (quantity) => {
    view.memory.perturbations = quantity;
    place.replaceChildren(perturbationPanels(view, entries, quantity, new Map(quantities).get(quantity)));
  };
  const chosen = view.memory.perturbations ?? "growth";
  drawAll(chosen);
  return section(
    view.doc,
    "perturbations",
    "Small perturbations about rest",
    element("div", { class: "choices" }, select("Quantity", quantities, chosen, drawAll)),
    element(
      "p",
      { class: "hint" },
      "Every mode in which particles move, over its wavenumber: at π the waves are 2 dx long. Of each ladder's " +
        "finest resolution the replicate that grows most. Crosses grow, by more than rounding alone can make of 0.",
    ),
    place,
  );
}

function perturbationPanels(view, entries, quantity, label) {
  const rowsOf = (series) =>
    entries
      .filter((entry) => series.includes(entry.series))
      .flatMap((entry) =>
        entry.growth.map((growth, k) => ({
          name: entry.series.name,
          growth,
          frequency: entry.frequency[k],
          // A mode that is the same everywhere has no wavelength.
          wavenumber: entry.wavelength[k] === null ? 0 : (2 * Math.PI) / entry.wavelength[k],
          grows: k < entry.growing,
        })),
      );
  return panelGrid(
    bySetting(view).filter(({ series }) => rowsOf(series).length),
    ({ title, series }) => {
      const rows = rowsOf(series);
      const growing = rows.filter((row) => row.grows);
      // Rounding must not fill the panel.
      const least = d3.max(entries, (entry) => 10 * Math.max(0, entry.growth[entry.growing] ?? 0));
      const values = rows.map((row) => row[quantity]);
      const y = paddedLinear(quantity === "growth" ? [...values, -least, least] : [0, ...values]);
      const plot = Plot.plot(
        plotOptions(`Small perturbations: ${label}, ${title}`, {
          marginLeft: 64,
          x: {
            domain: [-0.1, Math.PI + 0.1],
            ticks: [0, 1, 2, 3, Math.PI].filter((v) => v !== 3),
            tickFormat: (v) => (v === Math.PI ? "π" : String(v)),
            label: "wavenumber times dx →",
          },
          y: { domain: y, label: `↑ ${label}`, grid: true, ticks: 5, tickFormat: formatNumber },
          marks: [
            Plot.ruleY([0], { stroke: "var(--quiet)" }),
            ...dotMark(
              view,
              rows.filter((row) => !row.grows),
              "wavenumber",
              quantity,
              { r: 2.6, fillOpacity: 0.6, ariaDescription: "mode" },
            ),
            ...crossMark(view, growing, "wavenumber", quantity, "growing mode"),
            tips(
              rows,
              "wavenumber",
              quantity,
              (row) =>
                `${row.name}\nk dx = ${formatNumber(row.wavenumber)}: growth ${formatNumber(row.growth)}/s, ` +
                `frequency ${formatNumber(row.frequency)}/s`,
            ),
          ],
        }),
      );
      const words = d3
        .rollups(
          growing,
          (list) => d3.greatest(list, (row) => row.growth),
          (row) => row.name,
        )
        .map(
          ([name, row]) =>
            `${name} grows at up to ${formatNumber(row.growth)}/s, waves of ` +
            `${formatNumber((2 * Math.PI) / row.wavenumber)} dx`,
        );
      return figure(
        view,
        `Small perturbations, ${label}, ${title}`,
        plot,
        [...new Set(rows.map((row) => row.name))],
        [title, words.join(", ") || noGrowthText(entries)].join(" — "),
      );
    },
  );
}
