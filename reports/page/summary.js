// The verdict on each case: which formulation gives 1% soonest, and which to avoid. All from the rows that
// `sphverify compare` shows too: l1 where the solution jumps, l2 elsewhere, all particles.

// A formulation whose smallest error is as many times the best one's is one to avoid, if none is timed to 1%.
const farBehind = 10;

const isBroken = (s) => s.row.failures !== "" || s.row.verdict === "diverging";

function rankFormulations(one) {
  const ranks = [...d3.group(one.series, (s) => s.name)].map(([name, series]) => rankOf(name, series));
  for (const target of ["percent", "permille"]) {
    const times = ranks.map((r) => r[target].time).filter((time) => time.seconds !== null);
    const fastest = d3.least(times, (time) => time.seconds);
    for (const r of ranks) r[target].ratio = ratioOf(r[target].time, fastest);
  }
  // Those that reach 1% by time, then the others by error, then those that only fail.
  const none = (value) => value ?? Infinity;
  ranks.sort(
    (a, b) =>
      none(a.percent.time.seconds) - none(b.percent.time.seconds) ||
      none(a.error) - none(b.error) ||
      a.broken / a.ladders - b.broken / b.ladders ||
      0,
  );
  return ranks;
}

function rankOf(name, series) {
  // A ladder that diverges may pass below 1% on its way up: that is no merit.
  const sound = series.filter((s) => !isBroken(s));
  const held = sound.length ? sound : series.filter((s) => s.row.failures === "");
  const percent = soonestOf(sound, "toPercent");
  const nearest = d3.least(
    held.filter((s) => errorOf(s) !== null),
    errorOf,
  );
  return {
    name,
    best: percent.best ?? nearest ?? series[0],
    nearest: nearest ?? null,
    percent,
    permille: soonestOf(sound, "toPermille"),
    error: nearest ? errorOf(nearest) : null,
    isRelative: nearest ? nearest.row.relative_error !== null : false,
    ladders: series.length,
    failing: series.filter((s) => s.row.failures !== ""),
    diverging: series.filter((s) => s.row.failures === "" && s.row.verdict === "diverging"),
    broken: series.filter(isBroken).length,
  };
}

// The ladder that gets below an error first, its time, and how many get there.
function soonestOf(series, target) {
  const reaching = series.filter((s) => s.row[target].seconds !== null);
  const best = d3.least(reaching, (s) => s.row[target].seconds) ?? null;
  const never = { seconds: null, low: null, high: null, isBound: false };
  return { best, reached: reaching.length, time: best ? best.row[target] : never };
}

// A time over the fastest. The ends of the two intervals, divided crosswise, hold the ratio where each interval
// holds its median; a ratio that may be 1 does not tell the two apart.
function ratioOf(time, fastest) {
  if (time.seconds === null) return null;
  const isFastest = time === fastest;
  const isKnown = [time.low, time.high, fastest.low, fastest.high].every((end) => end > 0);
  const [low, high] = isKnown ? [time.low / fastest.high, time.high / fastest.low] : [null, null];
  const isBound = time.isBound || fastest.isBound;
  return {
    value: time.seconds / fastest.seconds,
    low,
    high,
    isFastest,
    isAlike: isKnown && !isFastest && !isBound && low <= 1 && high >= 1,
    // What that leaves of the ratio where a time is an upper bound.
    isAtMost: time.isBound,
    isAtLeast: fastest.isBound,
  };
}

function errorOf(s) {
  return s.row.relative_error ?? s.row.error;
}

// What all of some series have in common and not all others: "density summation".
function commonSettings(some, all) {
  const keys = varyingSettings(all).filter((key) => new Set(some.map((s) => s.settings[key])).size === 1);
  return keys.length ? settingText(some[0], keys) : "";
}

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
  if (rank.error === null) return "–";
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

// Never or not known, and what was reached already on the coarsest level.
function targetText(rank, { time }) {
  if (time.seconds === null) return noTimeText(rank);
  return (time.isBound ? "≤ " : "") + formatSeconds(time.seconds);
}

function verdictSentences(one, ranks) {
  const isTimed = ranks.some((r) => r.percent.time.seconds !== null);
  const lines = [];
  const [first, ...others] = ranks;
  if (isTimed) {
    // Below 1% on the coarsest level already: an upper bound, which may hide less than the first one's time.
    const unsure = others.filter((r) => r.percent.time.isBound);
    const alike = others.filter((r) => r.percent.ratio?.isAlike);
    const { time } = first.percent;
    lines.push([
      "good",
      `Soonest to 1%${unsure.length + alike.length ? ", as far as can be told" : ""}: ${first.name}, ` +
        `${time.isBound ? "at most " : ""}${formatSeconds(time.seconds)} (${bestSettings(one, first.best)}).`,
    ]);
    if (alike.length) {
      const names = alike.map((r) => `${r.name} (${formatRatio(r.percent.ratio.value)} times as long)`);
      lines.push(["", `Run times do not tell it from ${names.join(", ")}.`]);
    }
    if (unsure.length) {
      lines.push([
        "",
        `Perhaps as soon: ${unsure.map((r) => r.name).join(", ")}, below 1% on the coarsest level already.`,
      ]);
    }
    const next = others.find((r) => r.percent.ratio && !r.percent.ratio.isAtMost && !r.percent.ratio.isAlike);
    if (next) {
      lines.push([
        "",
        `${unsure.length ? "Later" : "Next"}: ${next.name}, ${time.isBound ? "at least " : ""}` +
          `${formatRatio(next.percent.ratio.value)} times as long.`,
      ]);
    }
  } else if (first.error !== null) {
    const isHopeless = first.broken === first.ladders;
    lines.push([
      isHopeless ? "bad" : "good",
      `${isHopeless ? "None converges; smallest" : "Smallest"} error: ${first.name}, ` +
        `${errorText(first)} (${bestSettings(one, first.best)}).`,
    ]);
    const near = others.filter((r) => r.error !== null && r.error < 1.1 * first.error);
    if (near.length) lines.push(["", `As near, within a tenth: ${near.map((r) => r.name).join(", ")}.`]);
    if (first.isRelative && first.error > 0.01) lines.push(["bad", "None reaches 1%."]);
  } else {
    lines.push(["bad", "No formulation gave a number."]);
  }
  for (const r of ranks) {
    const broken = r.broken;
    const never = isTimed && r.percent.reached === 0;
    const isFar = !isTimed && r.error !== null && r.error > farBehind * first.error;
    if (broken === 0 && !never && !isFar) continue;
    const where = [...r.failing, ...r.diverging];
    const common = where.length > 1 && where.length < r.ladders ? commonSettings(where, one.series) : "";
    const parts = [];
    if (r.failing.length) parts.push(`fails on ${r.failing.length} of ${plural(r.ladders, "ladder")}`);
    if (r.diverging.length) parts.push(`diverges on ${r.diverging.length} of ${r.ladders}`);
    if (never)
      parts.push(r.error === null ? "never reaches 1%" : `never reaches 1%, ${errorText(r)} at best`);
    if (isFar)
      parts.push(`${errorText(r)} at best, ${formatRatio(r.error / first.error)} times the smallest`);
    const isAvoided = never || isFar || broken === r.ladders;
    lines.push([
      isAvoided ? "bad" : "care",
      `${isAvoided ? "Avoid" : "With care"}: ${r.name}: ${parts.join("; ")}` +
        `${common ? ` (all that do with ${common})` : ""}.`,
    ]);
  }
  return lines;
}

function verdictOf(doc, one) {
  const ranks = rankFormulations(one);
  const { field, norm, finest } = one.series.find((s) => s.row.field !== "")?.row ?? one.series[0].row;
  const caption =
    field === ""
      ? "No error was measured."
      : `Error of ${field}, ${norm}, all particles; N = ${finest} is finest. ` +
        "Times and error are the best over all settings, which the last column names; order and verdict belong " +
        "to the first named.";
  return element(
    "article",
    { class: "verdict" },
    element("h4", {}, one.name),
    element("p", { class: "parameters" }, one.parameters),
    sentenceList(verdictSentences(one, ranks)),
    rankTable(one, ranks, caption),
  );
}

// Where the exact field is 0 there is no 1% of it, and a run that was not timed has no time.
function noTimeText(rank) {
  return rank.isRelative && rank.best.row.time.seconds !== null ? "never" : "–";
}

function rankTable(one, ranks, caption) {
  // Columns that no row fills, such as times of a study that measured none, are left out.
  const isTimed = one.series.some((s) => s.row.time.seconds !== null && s.row.relative_error !== null);
  const isFine = isTimed && ranks.some((r) => r.permille.time.seconds !== null);
  const head = [
    ["formulation", true],
    ["time to 1%", isTimed],
    ["ratio", isTimed],
    ["time to 0.1%", isFine],
    ["ratio at 0.1%", isFine],
    ["order [95%]", true],
    ["verdict", true],
    ["smallest error", true],
    ["reach 1%", isTimed],
    ["fail", true],
    ["diverge", true],
    ["setting", true],
  ];
  const body = ranks.map((r) => {
    const { row } = r.best;
    const entry = orderEntry(r.best, { field: row.field, region: "all", norm: row.norm });
    const onlyFails = r.failing.length === r.ladders;
    return [
      r.name,
      onlyFails ? "fails" : targetText(r, r.percent),
      ratioText(r.percent.ratio),
      onlyFails ? "fails" : targetText(r, r.permille),
      ratioText(r.permille.ratio),
      entry && !onlyFails ? formatOrder(entry.order, entry.lower, entry.upper) : "–",
      onlyFails ? row.failures : row.verdict || "–",
      onlyFails ? "fails" : errorText(r),
      `${r.percent.reached} of ${r.ladders}`,
      `${r.failing.length}`,
      `${r.diverging.length}`,
      settingLines(one, r),
    ];
  });
  const rows = body.map((cells, i) => {
    const isBad = ranks[i].failing.length === ranks[i].ladders;
    const line = element("tr", { class: isBad ? "failed" : null });
    cells.forEach((content, k) => {
      if (!head[k][1]) return;
      const lines = Array.isArray(content) ? content.map((text) => element("div", {}, text)) : [content];
      const isInterval = String(content).includes("[");
      line.append(
        k === 0
          ? element("th", { scope: "row" }, ...lines)
          : element("td", { class: isInterval ? "interval" : null }, ...lines),
      );
    });
    return line;
  });
  const table = element(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": `Verdict on ${one.name}` },
    element(
      "table",
      {},
      element("caption", { class: "hidden" }, `Verdict on ${one.name}`),
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          ...head.filter(([, isKept]) => isKept).map(([text]) => element("th", { scope: "col" }, text)),
        ),
      ),
      element("tbody", {}, ...rows),
    ),
  );
  const isMarked = ranks.some((r) => r.percent.ratio?.isAlike || r.permille.ratio?.isAlike);
  const remark = isMarked ? " ≈: run times do not tell it from the fastest." : "";
  return element("div", {}, element("p", { class: "parameters" }, caption + remark), table);
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
    disturbanceNote(doc),
    ...doc.cases.map((one) => verdictOf(doc, one)),
  );
}
