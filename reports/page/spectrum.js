// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenvalues of the linearised rate in the complex plane: right of the axis a mode grows.

function spectrumSection(view) {
  const entries = view.doc.spectra.filter((entry) => view.series.includes(entry.series));
  if (entries.length === 0) return null;
  const scales = [
    ["linear", "linear"],
    ["symlog", "logarithmic on both sides of 0"],
  ];
  const place = element("div", {});
  const drawAll = (scale) => {
    view.memory.spectrum = scale;
    place.replaceChildren(spectrumPanels(view, entries, scale));
  };
  const chosen = view.memory.spectrum ?? "symlog";
  drawAll(chosen);
  return section(
    view.doc,
    "spectrum",
    "Spectrum",
    element("div", { class: "choices" }, select("Axes", scales, chosen, drawAll)),
    element(
      "p",
      { class: "hint" },
      "Of each ladder's finest resolution the replicate that grows most. Right of the axis, shaded, a mode " +
        "grows; crosses mark those that do by more than rounding alone can make of 0.",
    ),
    place,
  );
}

function spectrumPanels(view, entries, scale) {
  const rowsOf = (series) =>
    entries
      .filter((entry) => series.includes(entry.series))
      .flatMap((entry) =>
        entry.real.map((real, k) => ({
          name: entry.series.name,
          real,
          imaginary: entry.imaginary[k],
          grows: k < entry.growing,
          entry,
        })),
      );
  return panelGrid(
    bySetting(view).filter(({ series }) => rowsOf(series).length),
    ({ title, series }) => {
      const rows = rowsOf(series);
      const x = paddedLinear([0, ...rows.map((row) => row.real)]);
      // Imaginary parts that are rounding must not fill the panel.
      const widest =
        Math.max(
          d3.max(rows, (row) => Math.abs(row.imaginary)),
          1e-6 * d3.max(rows, (row) => Math.abs(row.real)),
        ) || 1;
      const y = [-1.1 * widest, 1.1 * widest];
      const axis = (domain, label) => ({
        type: scale,
        domain,
        label,
        ...(scale === "symlog" ? symlogTicks(domain) : { ticks: 5, tickFormat: "~s" }),
      });
      const plot = Plot.plot(
        plotOptions(`Spectrum: ${title}`, {
          marginLeft: 64,
          x: axis(x, "real part [1/s] →"),
          y: axis(y, "↑ imaginary part [1/s]"),
          marks: [
            Plot.rect([0], { x1: 0, x2: x[1], y1: y[0], y2: y[1], fill: "var(--danger)", fillOpacity: 0.12 }),
            Plot.ruleX([0], { stroke: "var(--ink)", strokeWidth: 1 }),
            ...dotMark(
              view,
              rows.filter((row) => !row.grows),
              "real",
              "imaginary",
              { r: 2.6, fillOpacity: 0.6 },
            ),
            ...crossMark(
              view,
              rows.filter((row) => row.grows),
              "real",
              "imaginary",
              "growing mode",
            ),
            tips(
              rows,
              "real",
              "imaginary",
              (row) =>
                `${row.name}\n${formatNumber(row.real)} ${row.imaginary < 0 ? "−" : "+"} ` +
                `${formatNumber(Math.abs(row.imaginary))} i per second`,
            ),
          ],
        }),
      );
      const growing = d3.rollups(
        rows.filter((row) => row.grows),
        (list) => d3.max(list, (row) => row.real),
        (row) => row.name,
      );
      const words = growing.map(([name, most]) => `${name} grows at up to ${formatNumber(most)}/s`);
      return figure(
        view,
        `Spectrum, ${title}`,
        plot,
        [...new Set(rows.map((row) => row.name))],
        [title, words.join(", ") || noGrowthText(entries)].join(" — "),
      );
    },
  );
}

function symlogTicks([low, high]) {
  // Decades below the third from the top crowd around 0; an axis that ends below 1 is linear there.
  const side = (end) =>
    end > 1 ? d3.range(0, Math.floor(Math.log10(end)) + 1).slice(-3) : [Math.floor(Math.log10(end))];
  const ticks = [...side(-low).map((k) => -(10 ** k)), 0, ...side(high).map((k) => 10 ** k)];
  return { ticks, tickFormat: (v) => (v === 0 ? "0" : `${v < 0 ? "−" : ""}${formatDecade(Math.abs(v))}`) };
}
