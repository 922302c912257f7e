// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict on each case: which formulation gives 1% soonest, what it costs at the walls and in energy, and which to
// avoid.

// Settings of a ladder that tell it from the others of its case.
function bestSettings(one, s) {
  return settingText(s, varyingSettings(one.series));
}

// The settings that the numbers of a row come from. Order and verdict are those of the first.
function settingLines(one, rank) {
  const numbers = [
    ["1%", rank.percent.best],
    ["0.1%", rank.permille.best],
    ["smallest error", rank.nearest],
  ].filter(([, series]) => series !== null);
  const groups = [...d3.group(numbers, ([, series]) => series)];
  if (groups.length < 2) return [bestSettings(one, rank.best)];
  const names = (list) => list.map(([name]) => name).join(", ");
  return groups.map(([series, list]) => `${names(list)}: ${bestSettings(one, series)}`);
}

function errorText(rank) {
  if (rank.error === null) return "not known";
  return rank.isRelative ? formatPercent(rank.error) : `${formatNumber(rank.error)} (absolute)`;
}

function ratioText(ratio) {
  if (ratio === null) return "–";
  if (ratio.isFastest) return "1";
  if (ratio.isAtMost && ratio.isAtLeast) return "unknown";
  const sign = ratio.isAtMost ? "≤ " : ratio.isAtLeast ? "≥ " : ratio.isAlike ? "≈ " : "";
  return sign + formatRatio(ratio.value) + (sign === "≤ " || sign === "≥ " ? "" : ratioInterval(ratio));
}

function ratioInterval({ low, high }) {
  return low === null ? "" : ` [${formatRatio(low)}, ${formatRatio(high)}]`;
}

// What was reached already on the coarsest level is an upper bound; what was not reached has perhaps an N by the law.
function targetText(rank, { time }, relative) {
  if (time.seconds !== null) return (time.isBound ? "≤ " : "") + formatSeconds(time.seconds);
  // Where the exact field is 0 there is no 1% of it, and a run that was not timed has no time.
  if (!rank.isRelative || rank.best.row.time.seconds === null) return "not known";
  const target = usualEntry(rank.best)?.targets.find((t) => t.relative === relative);
  if (!target || target.resolution === null)
    return target?.remark.startsWith("never") ? "never" : "not reached";
  return `N = ${formatResolution(target.resolution)} by the law`;
}

// The order of the error that the tables show.
function usualEntry(s) {
  return orderEntry(s, { field: s.row.field, region: "all", norm: s.row.norm });
}

// What an error of 0 by rounding is called, and what was not measured.
function driftText({ energy_drift: drift, energy_rounding: rounding }) {
  if (drift === null) return "not known";
  return rounding !== null && Math.abs(drift) <= rounding ? "rounding" : formatNumber(drift);
}

function percentOrUnknown(part) {
  return part === null ? "not known" : formatPercent(part);
}

function growthText({ growing_modes: growing }) {
  return growing === null ? "not known" : String(growing);
}

// What a ladder does beside its error, of what was measured: at the walls, to the energy, to small perturbations.
function besideText({ row }) {
  const parts = [];
  if (row.wall_flux_error !== null)
    parts.push(`wall flux off by ${formatPercent(row.wall_flux_error)} of the largest flux`);
  if (row.wall_impulse_defect !== null)
    parts.push(
      `impulse at walls off by ${formatPercent(Math.abs(row.wall_impulse_defect))} of the prescribed`,
    );
  if (row.energy_drift !== null) {
    const drift = driftText(row);
    parts.push(`energy kept ${drift === "rounding" ? "to rounding" : `but for ${drift} of it`}`);
  }
  if (row.is_linearised) {
    const { growing_modes: growing } = row;
    parts.push(
      growing === null
        ? "whether a mode grows is not known"
        : growing === 0
          ? "no mode grows"
          : `${plural(growing, "mode")} grow`,
    );
  }
  return parts.length ? `${parts.join("; ")}.` : "";
}

function soonestSentences(one, [first, ...others]) {
  // An upper bound may hide less than the first one's time, or the first one's less than theirs.
  const times = [first, ...others].map((r) => r.percent.time);
  const unsure = others.filter((r) => hidesBehindBound(r.percent.time, times));
  const alike = others.filter((r) => r.percent.ratio?.isAlike);
  const { time } = first.percent;
  const lines = [
    [
      "good",
      `Soonest to 1%${unsure.length + alike.length ? ", as far as can be told" : ""}: ${first.name}, ` +
        `${time.isBound ? "at most " : ""}${formatSeconds(time.seconds)} (${bestSettings(one, first.best)}).`,
    ],
  ];
  if (alike.length) {
    const names = alike.map((r) => `${r.name} (${formatRatio(r.percent.ratio.value)} times as long)`);
    lines.push(["", `Run times do not tell it from ${names.join(", ")}.`]);
  }
  if (unsure.length) {
    const names = unsure.map((r) => `${r.name} (${targetText(r, r.percent, 0.01)})`).join(", ");
    lines.push(["", `Perhaps as soon or sooner: ${names}; ≤: below 1% on the coarsest level already.`]);
  }
  const next = others.find((r) => r.percent.ratio && !unsure.includes(r) && !r.percent.ratio.isAlike);
  if (next) {
    const later = `Later: ${next.name}, ${formatSeconds(next.percent.time.seconds)}.`;
    const least = next.percent.ratio.isAtLeast ? "at least " : "";
    const ratio = `Next: ${next.name}, ${least}${formatRatio(next.percent.ratio.value)} times as long.`;
    lines.push(["", unsure.length ? later : ratio]);
  }
  return lines;
}

// Where the verdict across cases takes another formulation or setting than the card: it asks another question.
function verdictSentence(one, formulations) {
  const [first] = formulations;
  const taken = formulations.find((r) => r.place === 0);
  if (!taken || (taken === first && first.best.verdictPlace === 0)) return [];
  const ladders = one.series.filter((s) => s.name === taken.name && s.verdictPlace === 0 && errorOf(s) !== null);
  const ladder = d3.least(ladders, errorOf);
  if (!ladder) return [];
  const error = ladder.row.relative_error === null ? formatNumber(errorOf(ladder)) : formatPercent(errorOf(ladder));
  return [
    [
      "",
      "The verdict goes by failures, then by error over all cases, and takes " +
        `${taken.name} (${bestSettings(one, ladder)}): error ${error} here.`,
    ],
  ];
}

function nearestSentences(one, [first, ...others]) {
  if (first.error === null) return [["bad", "No formulation gave a number."]];
  const isHopeless = first.broken === first.ladders;
  // No better than an answer of 0 everywhere.
  const isUseless = first.isRelative && first.error >= 1;
  const what = isHopeless ? "None converges; smallest" : isUseless ? "None comes near; smallest" : "Smallest";
  const setting = bestSettings(one, first.best);
  const near = others.filter((r) => r.error !== null && r.error < 1.1 * first.error);
  // A tenth is no reason to take one before the other.
  const asFar = near.length ? ", but for a tenth" : "";
  const lines = [
    [
      isHopeless || isUseless ? "bad" : near.length ? "" : "good",
      `${what} error${asFar}: ${first.name}, ${errorText(first)} (${setting}).`,
    ],
  ];
  if (near.length) lines.push(["", `As near, within a tenth: ${near.map((r) => r.name).join(", ")}.`]);
  if (first.isRelative && first.error > 0.01) lines.push(["bad", "None reaches 1%."]);
  return lines;
}

// Whether a formulation is one to avoid or to take with care, and why; null for neither.
function warning(one, rank, first, isTimed) {
  const isShort = isTimed && rank.percent.reached === 0;
  const isFar = !isTimed && rank.error !== null && rank.error > farBehind * first.error;
  if (rank.broken === 0 && !isShort && !isFar) return null;
  const parts = brokenParts(rank);
  if (isShort)
    parts.push(
      rank.error === null ? "no ladder reaches 1%" : `no ladder reaches 1%, ${errorText(rank)} at best`,
    );
  if (isFar)
    parts.push(`${errorText(rank)} at best, ${formatRatio(rank.error / first.error)} times the smallest`);
  const where = [...rank.failing, ...rank.diverging];
  const common = where.length > 1 && where.length < rank.ladders ? commonSettings(where, one.series) : "";
  const isAvoided = isShort || isFar || rank.broken === rank.ladders;
  return [
    isAvoided ? "bad" : "care",
    `${isAvoided ? "Avoid" : "With care"}: ${rank.name}: ${parts.join("; ")}` +
      `${common ? ` (all that do with ${common})` : ""}.`,
  ];
}

function brokenParts(rank) {
  const parts = [];
  if (rank.failing.length) parts.push(`fails on ${rank.failing.length} of ${plural(rank.ladders, "ladder")}`);
  if (rank.diverging.length) parts.push(`diverges on ${rank.diverging.length} of ${rank.ladders}`);
  return parts;
}

// Controls say what the wall terms are worth: no verdict is on them.
function controlSentence(controls) {
  const words = controls.map((r) => {
    const parts = brokenParts(r);
    if (r.error !== null) parts.unshift(`${errorText(r)} at best`);
    return `${r.name}: ${parts.join("; ") || "no number"}`;
  });
  return ["", `For comparison only. ${words.join(". ")}.`];
}

function verdictSentences(one, { formulations, controls }) {
  const lines = [];
  if (formulations.length === 0) {
    lines.push(["", "Only controls ran: there is no verdict."]);
  } else {
    const isTimed = formulations.some((r) => r.percent.time.seconds !== null);
    const [first] = formulations;
    lines.push(...(isTimed ? soonestSentences(one, formulations) : nearestSentences(one, formulations)));
    const beside = besideText(first.best);
    if (beside) lines.splice(1, 0, ["", `${first.name} there: ${beside}`]);
    lines.push(...verdictSentence(one, formulations));
    lines.push(...formulations.map((r) => warning(one, r, first, isTimed)).filter(Boolean));
  }
  if (controls.length) lines.push(controlSentence(controls));
  return lines;
}

function verdictOf(doc, one) {
  const ranked = rankFormulations(one);
  const { field, norm, finest } = one.series.find((s) => s.row.field !== "")?.row ?? one.series[0].row;
  const caption =
    field === ""
      ? "No error was measured."
      : `Error of ${field}, ${norm}, all particles; N = ${finest} is finest. ` +
        "Times and error are the best over all settings, which the last column names; order, verdict, walls and " +
        "energy belong to the first named.";
  return element(
    "article",
    { class: "verdict" },
    element("h4", {}, one.name),
    element("p", { class: "parameters" }, one.parameters),
    sentenceList(verdictSentences(one, ranked)),
    rankTable(one, ranked, caption),
  );
}

// How many ladders reach 1% and how many break.
function ladderLines(rank, isTimed) {
  const lines = isTimed ? [`${rank.percent.reached} of ${rank.ladders} reach 1%`] : [];
  if (rank.failing.length) lines.push(`${rank.failing.length} of ${rank.ladders} fail`);
  if (rank.diverging.length) lines.push(`${rank.diverging.length} of ${rank.ladders} diverge`);
  return lines.length ? lines : [`${rank.ladders}, all end`];
}

// Columns of the table on a case: [heading, whether any row fills it, text of a rank].
function rankColumns(one, ranks) {
  const rows = one.series.map((s) => s.row);
  const isTimed = rows.some((row) => row.time.seconds !== null && row.relative_error !== null);
  const isFine = isTimed && ranks.some((r) => r.permille.time.seconds !== null);
  const order = ({ best }) => {
    const entry = usualEntry(best);
    return entry && entry.order !== null ? formatOrder(entry.order, entry.lower, entry.upper) : "not known";
  };
  const has = (key) => rows.some((row) => row[key] !== null);
  // Of a ladder that only fails there is nothing else to say.
  const orFails = (text) => (r) => (r.failing.length === r.ladders ? "fails" : text(r));
  return [
    ["formulation", true, (r) => r.name],
    ["time to 1%", isTimed, orFails((r) => targetText(r, r.percent, 0.01))],
    ["times the soonest", isTimed, (r) => ratioText(r.percent.ratio)],
    ["time to 0.1%", isFine, orFails((r) => targetText(r, r.permille, 0.001))],
    ["times the soonest to 0.1%", isFine, (r) => ratioText(r.permille.ratio)],
    ["smallest error", true, orFails(errorText)],
    ["order [95%]", true, orFails(order)],
    [
      "verdict",
      true,
      (r) => (r.failing.length === r.ladders ? r.best.row.failures : r.best.row.verdict || "–"),
    ],
    ["wall flux error", has("wall_flux_error"), orFails((r) => percentOrUnknown(r.best.row.wall_flux_error))],
    [
      "wall impulse defect",
      has("wall_impulse_defect"),
      orFails((r) => percentOrUnknown(r.best.row.wall_impulse_defect)),
    ],
    ["energy drift", has("energy_drift"), orFails((r) => driftText(r.best.row))],
    ["growing modes", rows.some((row) => row.is_linearised), (r) => growthText(r.best.row)],
    ["ladders", true, (r) => ladderLines(r, isTimed)],
    ["setting", true, (r) => settingLines(one, r)],
  ].filter(([, isFilled]) => isFilled);
}

function rankTable(one, { formulations, controls }, caption) {
  const columns = rankColumns(one, [...formulations, ...controls]);
  const line = (rank) => {
    const isBad = rank.failing.length === rank.ladders;
    return verdictLine(
      columns.map(([, , text]) => text(rank)),
      isBad,
    );
  };
  const heads = columns.map(([heading]) => heading);
  const bodies = [element("tbody", {}, ...formulations.map(line))];
  if (controls.length) bodies.push(controlBody(heads.length, controls.map(line)));
  const isMarked = [...formulations, ...controls].some(
    (r) => r.percent.ratio?.isAlike || r.permille.ratio?.isAlike,
  );
  const remark = isMarked ? " ≈: run times do not tell it from the soonest." : "";
  return element(
    "div",
    {},
    element("p", { class: "parameters" }, caption + remark),
    verdictTable(`Verdict on ${one.name}`, heads, bodies),
  );
}

// A row of a verdict: the first cell is its heading, a list of texts takes a line for each.
function verdictLine(cells, isBad) {
  const line = element("tr", { class: isBad ? "failed" : null });
  cells.forEach((content, k) => {
    const texts = [content].flat();
    const lines = texts.length > 1 ? texts.map((text) => element("div", {}, text)) : texts;
    const mayWrap = texts.some((text) => text.length > 11);
    line.append(
      k === 0
        ? element("th", { scope: "row" }, ...lines)
        : element("td", { class: mayWrap ? "words" : null }, ...lines),
    );
  });
  return line;
}

// The rows of controls, under a heading of their own.
function controlBody(columns, lines) {
  return element(
    "tbody",
    { class: "controls" },
    element(
      "tr",
      { class: "group" },
      element("th", { colspan: columns, scope: "rowgroup" }, "Controls, for comparison: never ranked"),
    ),
    ...lines,
  );
}

function verdictTable(title, heads, bodies) {
  return element(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": title },
    element(
      "table",
      {},
      element("caption", { class: "hidden" }, title),
      element("thead", {}, element("tr", {}, ...heads.map((text) => element("th", { scope: "col" }, text)))),
      ...bodies,
    ),
  );
}
