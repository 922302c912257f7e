// SPDX-License-Identifier: GPL-3.0-or-later
// The answer: one verdict across the cases, as `sphverify compare` gives it, then each case.

// What of a row's numbers are shown: [heading, whether a row has it, text of a row].
function summaryColumns(rows) {
  const has = (key) => rows.some((row) => row[key] !== null);
  const isWide = rows.some((row) => row.scenes > 1);
  const orUnknown = (format) => (value) => (value === null ? "not known" : format(value));
  const percent = orUnknown(formatPercent);
  const count = (n, row) => (n === 0 || row.scenes === 1 ? String(n) : `${n} of ${row.scenes}`);
  return [
    ["formulation", true, (row) => row.name],
    [isWide ? "mean error" : "error", true, (row) => summaryError(row, row.error)],
    ["largest error", isWide, (row) => [summaryError(row, row.worst_error), row.worst_scene].filter(Boolean)],
    ["order [95%]", true, ({ order }) => (order[0] === null ? "not known" : formatOrder(...order))],
    ["floor [95%]", rows.some((row) => row.floor[0] !== null), summaryFloor],
    ["1% after", rows.some((row) => row.is_timed || row.percent_resolution !== null), percentText],
    ["wall flux error", has("wall_flux"), (row) => percent(row.wall_flux)],
    ["wall impulse defect", has("wall_impulse"), (row) => percent(row.wall_impulse)],
    [
      "energy made by pairs",
      has("energy_drift"),
      (row) => (row.energy_drift === 0 ? "rounding" : percent(row.energy_drift)),
    ],
    ["growing modes", has("growing_modes"), (row) => orUnknown(String)(row.growing_modes)],
    ["fail", true, (row) => count(row.failed + row.missing, row)],
    ["diverge", true, (row) => count(row.diverging, row)],
    ["setting", true, (row) => row.setting],
  ].filter(([, isFilled]) => isFilled);
}

function summaryError(row, error) {
  if (error === null) return row.failed + row.missing === row.scenes ? "fails" : "not known";
  return row.is_relative ? formatPercent(error) : formatNumber(error);
}

// A floor that may be none is known from above alone.
function summaryFloor({ floor: [value, low, high], is_relative: isRelative }) {
  const format = isRelative ? formatPercent : formatNumber;
  if (value === null) return "not known";
  if (!(low > 0)) return high === null ? "not known" : `< ${format(high)}`;
  return `${format(value)} [${format(low)}, ${format(high)}]`;
}

function percentText(row) {
  if (row.to_percent !== null) return (row.is_bound ? "≤ " : "") + formatSeconds(row.to_percent);
  if (row.percent_resolution !== null) return `N = ${formatResolution(row.percent_resolution)} by the law`;
  return row.is_timed ? "not reached" : "not known";
}

function summaryTitle({ cases, layouts, finest: [coarsest, finest], norm }) {
  const levels = coarsest === finest ? `N = ${finest}` : `N = ${coarsest} to ${finest}`;
  const error = norm === "" ? "no error" : norm === "mixed" ? "l1 error at jumps, else l2" : `${norm} error`;
  const where =
    cases.length + layouts.length === 2
      ? `On ${cases[0]}, ${layouts[0]}`
      : `Across ${plural(cases.length, "case")} on ${plural(layouts.length, "layout")}`;
  return `${where}: ${error}, ${levels}`;
}

function summaryTable(group, title) {
  const columns = summaryColumns(group.rows);
  const line = (row) =>
    verdictLine(
      columns.map(([, , text]) => text(row)),
      row.failed + row.missing === row.scenes,
    );
  const lines = (isControl) => group.rows.filter((row) => row.is_control === isControl).map(line);
  const bodies = [element("tbody", {}, ...lines(false))];
  if (lines(true).length) bodies.push(controlBody(columns.length, lines(true)));
  return verdictTable(
    title,
    columns.map(([heading]) => heading),
    bodies,
  );
}

// Sentences of the group's formulations, in their order; controls have none.
function summarySentences({ sentences, rows }) {
  const ranked = rows.filter((row) => !row.is_control);
  return sentences.map((text, k) => {
    const row = ranked[k];
    if (!row) return ["", text];
    if (row.failed + row.missing + row.diverging > 0) return ["care", text];
    if (k > 0) return ["", text];
    // No better than an answer of 0 everywhere.
    return row.is_relative && row.error >= 1 ? ["bad", `None comes near. ${text}`] : ["good", text];
  });
}

function summaryArticle(group, isFirst) {
  const title = summaryTitle(group);
  const parts = [
    element("p", { class: "parameters" }, `${group.cases.join(", ")}; ${group.layouts.join(", ")}`),
    sentenceList(summarySentences(group)),
    summaryTable(group, title),
    element(
      "p",
      { class: "parameters" },
      "Each formulation stands at one setting for all of these: the one with which it fails on the fewest, then " +
        "diverges on the fewest, then has the smallest mean error (geometric, at the finest level, relative to the " +
        "exact field where that is not 0). Order: the lowest. Floor, wall flux and energy: the worst.",
    ),
  ];
  if (isFirst) {
    return element("article", { class: "verdict across" }, element("h4", {}, title), ...parts);
  }
  return element(
    "details",
    { class: "verdict across" },
    element("summary", {}, title, ...group.sentences.slice(0, 1).map((text) => element("div", {}, text))),
    ...parts,
  );
}

// What `sphverify compare` says too of runs that the processor did not work on all the time.
function disturbanceNote(doc) {
  return doc.disturbance ? element("p", { class: "note disturbed" }, doc.disturbance) : null;
}

function summarySection(doc) {
  if (doc.cases.length === 0) {
    const words =
      doc.envelopes.length > 0
        ? "An envelope study has no ladders: see Stability envelope."
        : "The study ran nothing.";
    return section(doc, "summary", "Verdict", element("p", {}, words));
  }
  return section(
    doc,
    "summary",
    "Verdict",
    ...doc.summary.map((group, k) => summaryArticle(group, k === 0)),
    disturbanceNote(doc),
    ...doc.cases.map((one) => verdictOf(doc, one)),
  );
}
