// SPDX-License-Identifier: GPL-3.0-or-later
// Whether conduction kept the second law: heat from cold to hot, new extrema, entropy that falls.

// What rounding leaves of an entropy production of zero, relative to all that is turned over.
const entropyRounding = 1e-10;

const lawKinds = [
  { key: "coldToHot", label: "heat from cold to hot" },
  { key: "overshoot", label: "hotter than ever before" },
  { key: "undershoot", label: "colder than ever before" },
  { key: "entropyFall", label: "entropy falls" },
];

// A remark says what was not watched: "entropy ..." leaves the rest, a wall that brings heat leaves no bounds.
function lawRow(entry) {
  const remark = entry.remark ?? "";
  const hasBounds = remark === "" || remark.startsWith("entropy");
  const isWatched = hasBounds || remark.startsWith("a wall brings heat");
  const breach = (it, isKnown) => (isKnown ? it : { size: null, time: null, position: [] });
  const row = {
    name: entry.series.name,
    series: entry.series,
    run: entry.run,
    remark: entry.remark,
    entropy: entry.entropy,
    coldToHot: breach(entry.coldToHot, isWatched),
    overshoot: breach(entry.overshoot, hasBounds),
    undershoot: breach(entry.undershoot, hasBounds),
  };
  const fall = entry.entropy === null ? null : entry.entropy < -entropyRounding ? -entry.entropy : 0;
  row.entropyFall = { size: fall, time: null, position: [] };
  row.broken = lawKinds.filter(({ key }) => row[key].size > 0);
  row.isWatched = lawKinds.some(({ key }) => row[key].size !== null);
  return row;
}

function secondLawSection(view) {
  const rows = view.doc.secondLaws.filter((entry) => view.series.includes(entry.series)).map(lawRow);
  if (rows.length === 0) return null;
  const sentences = [...d3.group(rows, (row) => row.name)].map(([name, own]) => {
    const watched = own.filter((row) => row.isWatched);
    if (watched.length === 0) return ["", `${name}: not watched, ${own[0].remark}.`];
    const broken = watched.filter((row) => row.broken.length);
    if (broken.length === 0) {
      const partly = watched.some((row) => row.remark) ? ", as far as was watched" : "";
      return ["good", `${name}: kept in ${plural(watched.length, "run")}${partly}.`];
    }
    const kinds = lawKinds
      .map(({ key, label }) => [label, broken.filter((row) => row[key].size > 0).length])
      .filter(([, count]) => count > 0)
      .map(([label, count]) => `${label} in ${count}`);
    return [
      "bad",
      `${name}: broken in ${broken.length} of ${plural(watched.length, "run")}: ${kinds.join(", ")}.`,
    ];
  });
  return section(
    view.doc,
    "second-law",
    "Second law",
    element(
      "p",
      { class: "hint" },
      "Of each ladder's finest resolution, every replicate; at 0 the law is kept. Heat from cold to hot: as a part " +
        "of the largest heating at the time. Hotter or colder than ever before: as a part of the range that the " +
        "initial state and the walls allow. Entropy falls: as a part of all entropy that is turned over.",
    ),
    sentenceList(sentences),
    lawPanels(view, rows),
    lawTable(view, rows),
  );
}

function lawPanels(view, all) {
  const sizes = all
    .flatMap((row) => lawKinds.map(({ key }) => row[key].size))
    .filter((size) => size !== null);
  if (sizes.length === 0) return null;
  const top = Math.max(1, d3.max(sizes));
  const ticks = [
    0,
    0.01,
    0.1,
    1,
    ...d3.range(1, Math.log10(top) + 1e-9, top > 100 ? 2 : 1).map((k) => 10 ** k),
  ];
  const rowsOf = (series) => all.filter((row) => series.includes(row.series));
  return panelGrid(
    bySetting(view).filter(({ series }) => rowsOf(series).length),
    ({ title, series }) => {
      const own = rowsOf(series);
      const bands = bandsOf(
        lawKinds.map((kind) => kind.label),
        [...new Set(own.map((row) => row.name))],
      );
      const rows = own.flatMap((row) =>
        lawKinds
          .map(({ key, label }) => ({ ...row, ...row[key], label, y: bands.place(label, row.name) }))
          .filter((dot) => dot.size !== null),
      );
      const plot = Plot.plot(
        plotOptions(`Second law: ${title}`, {
          ...bands.options,
          // Linear up to 1%, logarithmic beyond.
          x: {
            type: "symlog",
            constant: 0.01,
            domain: [0, 1.3 * top],
            ticks,
            tickFormat: formatPercent,
            grid: true,
            label: "how far the law was broken →",
          },
          marks: [
            ...bands.marks,
            Plot.ruleX([0], { stroke: "var(--ink)", strokeWidth: 1 }),
            ...dotMark(view, rows, "size", "y", { ariaDescription: "breach" }),
            tips(rows, "size", "y", (row) => `${row.name}\n${row.label}: ${breachText(row)}`),
          ],
        }),
      );
      return figure(view, `Second law, ${title}`, plot, [...new Set(own.map((row) => row.name))], title);
    },
  );
}

function breachText({ size, time, position }) {
  if (!(size > 0) || time === null) return formatPercent(size);
  return `${formatPercent(size)} at t = ${formatNumber(time)}, x = ${placeText(position)}`;
}

function lawTable(view, rows) {
  const columns = filled(
    [
      ...runColumns(view.series),
      ...lawKinds.slice(0, 3).map(({ key, label }) => ({
        label,
        value: (row) => row[key].size,
        text: (row) => breachText(row[key]),
      })),
      numberColumn("smallest entropy production", (row) => row.entropy, formatPercent),
      { label: "broken", value: (row) => row.broken.map((kind) => kind.label).join("; ") },
      { label: "remark", value: (row) => row.remark },
    ],
    rows,
  );
  return sortableTable("Second law", columns, rows, (row) => (row.broken.length ? "failed" : null));
}
