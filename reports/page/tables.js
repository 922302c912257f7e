// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that sort by any column and filter by words.

const rowsAtFirst = 100;

// `columns` are {label, value(row), text(row)}; without `text` the value is shown as it is.
function sortableTable(title, columns, rows, rowClass = () => null) {
  const state = { column: -1, isDescending: false, words: "", isWhole: false };
  const textOf = (column, row) => (column.text ? column.text(row) : String(column.value(row) ?? "–"));
  const count = element("output", { class: "count" });
  const body = element("tbody", {});
  const heads = columns.map((column, k) =>
    element(
      "th",
      { scope: "col", "aria-sort": "none" },
      element("button", { type: "button", onclick: () => sortBy(k) }, column.label),
    ),
  );
  const more = element("button", {
    type: "button",
    class: "more",
    onclick: () => {
      state.isWhole = true;
      fill();
    },
  });

  function sortBy(k) {
    state.isDescending = state.column === k && !state.isDescending;
    state.column = k;
    heads.forEach((head, other) =>
      head.setAttribute("aria-sort", other !== k ? "none" : state.isDescending ? "descending" : "ascending"),
    );
    fill();
  }

  function chosenRows() {
    const words = state.words.toLowerCase().split(/\s+/).filter(Boolean);
    const kept = rows.filter((row) => {
      if (words.length === 0) return true;
      const text = columns
        .map((column) => textOf(column, row))
        .join(" ")
        .toLowerCase();
      return words.every((word) => text.includes(word));
    });
    if (state.column < 0) return kept;
    const { value } = columns[state.column];
    const order = (a, b) => (typeof a === "string" ? a.localeCompare(b) : a - b);
    // What has no value comes last either way.
    const isNone = (v) => v === null || v === undefined || v === "";
    return kept.sort((a, b) => {
      const [p, q] = [value(a), value(b)];
      if (isNone(p) || isNone(q)) return isNone(p) - isNone(q);
      return state.isDescending ? order(q, p) : order(p, q);
    });
  }

  function fill() {
    const kept = chosenRows();
    const shown = state.isWhole ? kept : kept.slice(0, rowsAtFirst);
    body.replaceChildren(
      ...shown.map((row) =>
        element(
          "tr",
          { class: rowClass(row) },
          ...columns.map((column, k) =>
            element(
              k === 0 ? "th" : "td",
              { scope: k === 0 ? "row" : null, class: column.text ? "number" : null },
              textOf(column, row),
            ),
          ),
        ),
      ),
    );
    count.value =
      kept.length === rows.length
        ? plural(rows.length, "row")
        : `${kept.length} of ${plural(rows.length, "row")}`;
    more.hidden = shown.length === kept.length;
    more.textContent = `Show all ${kept.length} rows`;
  }

  fill();
  const search = element("input", {
    type: "search",
    placeholder: "words, all must occur",
    oninput: (event) => {
      state.words = event.target.value;
      fill();
    },
  });
  return element(
    "div",
    { class: "table" },
    element(
      "div",
      { class: "choices" },
      element("label", { class: "choice" }, element("span", {}, "Filter"), search),
      count,
    ),
    element(
      "div",
      { class: "scroll", tabindex: "0", role: "region", "aria-label": title },
      element(
        "table",
        {},
        element("caption", { class: "hidden" }, title),
        element("thead", {}, element("tr", {}, ...heads)),
        body,
      ),
    ),
    more,
  );
}

// Columns that no row fills are left out; a column may say itself what fills it.
function filled(columns, rows) {
  return columns.filter((column) =>
    rows.some((row) => {
      if (column.isFilled) return column.isFilled(row);
      const value = column.value(row);
      return value !== null && value !== undefined && value !== "";
    }),
  );
}

function settingColumns(series, seriesOf) {
  return varyingSettings(series).map((key) => ({
    label: key,
    value: (row) => seriesOf(row)?.settings[key] ?? null,
  }));
}

function numberColumn(label, value, text = formatNumber) {
  return { label, value, text: (row) => text(value(row)) };
}

// How many modes grow. Of a large operator that may not be known though one is known to.
function growthColumn() {
  return {
    label: "growing modes",
    value: (row) => row.growing,
    isFilled: () => true,
    text: (row) => (row.growing !== null ? String(row.growing) : row.grows ? "at least 1" : "not known"),
  };
}

// The time that a level reached already where it is coarsest is an upper bound.
function timeColumn(label, time) {
  return {
    label,
    value: (row) => time(row).seconds,
    text: (row) => (time(row).isBound ? "≤ " : "") + formatTime(time(row)),
  };
}

// What tells the runs of one case apart, for rows that hold their name, series and run.
function runColumns(series) {
  return [
    { label: "formulation", value: (row) => row.name },
    ...settingColumns(series, (row) => row.series),
    numberColumn("N", (row) => row.run.resolution, String),
    numberColumn(
      "seed",
      (row) => row.run.seed,
      (seed) => (seed === null ? "–" : String(seed)),
    ),
  ];
}

// Relative where the exact field is not 0, as the errors beside it.
function floorColumn(entry) {
  const scale = (e) => (e.scale > 0 ? e.scale : 1);
  return {
    label: "floor [95%]",
    value: (s) => (entry(s)?.floor ? entry(s).floor.value / scale(entry(s)) : null),
    text: (s) => {
      const e = entry(s);
      if (!e?.floor) return "not known";
      const format = e.scale > 0 ? formatPercent : formatNumber;
      return floorText(e.floor, (value) => format(value / scale(e)));
    },
  };
}

// Where the fitted law comes down to a part of the exact field.
function resolutionColumn(label, entry, relative) {
  const target = (s) => entry(s)?.targets.find((t) => t.relative === relative);
  return {
    label,
    value: (s) => target(s)?.resolution ?? null,
    isFilled: (s) => target(s) !== undefined,
    text: (s) => targetResolutionText(entry(s), relative),
  };
}

function ladderTable(view) {
  const rows = view.tableSeries;
  const entry = (s) =>
    orderEntry(s, view.choice) ?? orderEntry(s, { field: s.row.field, region: "all", norm: s.row.norm });
  const last = (s) => entry(s)?.errors.at(-1) ?? null;
  const relative = (s) => (last(s) !== null && entry(s).scale > 0 ? last(s) / entry(s).scale : null);
  const columns = filled(
    [
      { label: "formulation", value: (s) => s.name },
      { label: "case", value: (s) => s.caseName },
      ...settingColumns(rows, (s) => s),
      { label: "finest N", value: (s) => s.row.finest, text: (s) => String(s.row.finest) },
      { label: "failures", value: (s) => s.row.failures },
      { label: "field", value: (s) => entry(s)?.field },
      { label: "region", value: (s) => entry(s)?.region },
      numberColumn("error", last),
      numberColumn("relative error", relative, formatPercent),
      {
        label: "order [95%]",
        value: (s) => entry(s)?.order ?? null,
        text: (s) => formatOrder(entry(s)?.order, entry(s)?.lower, entry(s)?.upper),
      },
      { label: "verdict", value: (s) => entry(s)?.verdict },
      { label: "because", value: (s) => entry(s)?.reason },
      { label: "model", value: (s) => entry(s)?.model },
      floorColumn(entry),
      resolutionColumn("N to 1%", entry, 0.01),
      resolutionColumn("N to 0.1%", entry, 0.001),
      timeColumn("run time", (s) => s.row.time),
      timeColumn("time to 1% (all)", (s) => s.row.toPercent),
      timeColumn("time to 0.1% (all)", (s) => s.row.toPermille),
      numberColumn("wall flux error", (s) => s.row.wall_flux_error, formatPercent),
      numberColumn("energy drift / energy", (s) => s.row.energy_drift),
      numberColumn("wall budget defect / energy", (s) => s.row.wall_budget_defect),
      numberColumn("error of the plateau pressure", (s) => s.row.plateau_pressure, formatPercent),
      numberColumn("wall heating", (s) => s.row.wall_heating, formatPercent),
      numberColumn("wall impulse defect", (s) => s.row.wall_impulse_defect, formatPercent),
      numberColumn("momentum drift", (s) => s.row.momentum_drift),
      numberColumn("time error share", (s) => s.row.time_error_share),
    ],
    rows,
  );
  return sortableTable("Ladders", columns, rows, (s) => (s.row.failures ? "failed" : null));
}

function runTable(view) {
  const rows = view.doc.runs.filter((run) => run.series === null || view.tableSeries.includes(run.series));
  const columns = filled(
    [
      { label: "formulation", value: (r) => r.series?.name ?? r.label },
      { label: "case", value: (r) => r.series?.caseName ?? r.case },
      ...settingColumns(view.tableSeries, (r) => r.series),
      { label: "N", value: (r) => r.resolution, text: (r) => String(r.resolution) },
      { label: "particles", value: (r) => r.particles, text: (r) => String(r.particles) },
      { label: "seed", value: (r) => r.seed, text: (r) => (r.seed === null ? "–" : String(r.seed)) },
      { label: "status", value: (r) => r.status },
      { label: "reason", value: (r) => r.reason },
      numberColumn("h [m]", (r) => r.smoothing_length),
      timeColumn("run time", (r) => r.time),
      numberColumn("steps", (r) => r.steps),
      numberColumn("rate evaluations", (r) => r.rate_evaluations),
      numberColumn("pair interactions", (r) => r.pair_interactions),
      numberColumn("memory [bytes]", (r) => r.peak_bytes),
      numberColumn("energy drift / energy", (r) => r.energy_drift),
      numberColumn("wall budget defect / energy", (r) => r.wall_budget_defect),
      numberColumn("wall flux error", (r) => r.wall_flux_error, formatPercent),
      numberColumn("time error share", (r) => r.time_error_share),
      numberColumn("spectral abscissa [1/s]", (r) => r.spectral_abscissa),
      numberColumn("spectral radius [1/s]", (r) => r.spectral_radius),
      numberColumn("longest stable Euler step", (r) => r.largest_stable_step, formatSeconds),
    ],
    rows,
  );
  return sortableTable("Runs", columns, rows, (r) => (r.status === "ok" ? null : "failed"));
}

function failureSection(doc) {
  const rows = doc.runs.filter((run) => run.status !== "ok");
  if (rows.length === 0) return null;
  const columns = filled(
    [
      { label: "formulation", value: (r) => r.series?.name ?? r.label },
      { label: "case", value: (r) => r.series?.caseName ?? r.case },
      ...settingColumns(doc.series, (r) => r.series),
      { label: "N", value: (r) => r.resolution, text: (r) => String(r.resolution) },
      { label: "seed", value: (r) => r.seed, text: (r) => (r.seed === null ? "–" : String(r.seed)) },
      { label: "status", value: (r) => r.status },
      { label: "reason", value: (r) => r.reason },
    ],
    rows,
  );
  return section(
    doc,
    "failures",
    `Failures: ${rows.length} of ${plural(doc.runs.length, "run")}`,
    element("p", { class: "hint" }, "All cases and settings, whatever is chosen above."),
    sortableTable("Failures", columns, rows, () => "failed"),
  );
}

function skippedSection(doc) {
  if (doc.skipped.length === 0) return null;
  const columns = [
    { label: "formulation", value: (s) => s[1] },
    { label: "case", value: (s) => s[0] },
    { label: "reason", value: (s) => s[2] },
  ];
  return section(
    doc,
    "skipped",
    `Skipped: ${plural(doc.skipped.length, "combination")} that make no sense`,
    sortableTable("Skipped", columns, doc.skipped),
  );
}
