// SPDX-License-Identifier: GPL-3.0-or-later
// How the formulations of one case stand to each other. All from the rows that `sphverify compare` shows too: l1
// where the solution jumps, l2 elsewhere, all particles.

// A formulation whose smallest error is as many times the best one's is one to avoid, if none is timed to 1%.
const farBehind = 10;

const isBroken = (s) => s.row.failures !== "" || s.row.verdict === "diverging";

// The formulations, the best first, and apart from these the controls, which are shown beside them and never win.
function rankFormulations(one) {
  const all = [...d3.group(one.series, (s) => s.name)].map(([name, series]) => rankOf(name, series));
  const formulations = all.filter((r) => !r.isControl);
  for (const target of ["percent", "permille"]) {
    const times = formulations.map((r) => r[target].time).filter((time) => time.seconds !== null);
    const fastest = d3.least(times, (time) => time.seconds) ?? null;
    for (const r of all) r[target].ratio = ratioOf(r[target].time, fastest);
  }
  // Those that reach 1% by time, as far as times tell; then the others by error, then those that only fail.
  const none = (value) => value ?? Infinity;
  const times = formulations.map((r) => r.percent.time);
  const untold = formulations.filter((r) => hidesBehindBound(r.percent.time, times));
  // A bound far above another's is not where to look first, whatever the verdict says.
  const leastBound = d3.min(untold, (r) => r.percent.time.seconds);
  const isFar = (r) => r.percent.time.seconds > farBehind * leastBound;
  const before = (a, b) =>
    untold.includes(b) - untold.includes(a) ||
    (untold.includes(a) && isFar(a) - isFar(b)) ||
    (untold.includes(a) && compare(a.place, b.place)) ||
    compare(none(a.percent.time.seconds), none(b.percent.time.seconds)) ||
    none(a.error) - none(b.error) ||
    a.broken / a.ladders - b.broken / b.ladders ||
    0;
  return {
    formulations: formulations.sort(before),
    controls: all.filter((r) => r.isControl).sort(before),
  };
}

const compare = (a, b) => (a < b ? -1 : a > b ? 1 : 0);

// Whether an upper bound among the times leaves open which is the soonest, and this may be it. What was below an error
// on its coarsest level already may have needed any less time.
function hidesBehindBound(time, times) {
  const reached = times.filter(({ seconds }) => seconds !== null);
  const latest = d3.min(reached, ({ seconds, high }) => high ?? seconds);
  const mayBeSoonest = ({ seconds, low, isBound }) => isBound || (low ?? seconds) <= latest;
  return time.seconds !== null && mayBeSoonest(time) && reached.some((t) => t.isBound) && reached.length > 1;
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
    isControl: series[0].isControl,
    place: d3.min(series, (s) => s.verdictPlace),
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

// The ladder that gets below an error first, its time, and how many get there. Where a bound leaves open which it is,
// that of the verdict, else that of the smallest error.
function soonestOf(series, target) {
  const reaching = series.filter((s) => s.row[target].seconds !== null);
  const times = reaching.map((s) => s.row[target]);
  const untold = reaching.filter((s) => hidesBehindBound(s.row[target], times));
  const byVerdict = (a, b) => compare(a.verdictPlace, b.verdictPlace) || d3.ascending(errorOf(a), errorOf(b));
  const best = (untold.length ? d3.least(untold, byVerdict) : d3.least(reaching, (s) => s.row[target].seconds)) ?? null;
  const never = { seconds: null, low: null, high: null, isBound: false };
  return { best, reached: reaching.length, time: best ? best.row[target] : never };
}

// A time over the fastest. The ends of the two intervals, divided crosswise, hold the ratio where each interval
// holds its median; a ratio that may be 1 does not tell the two apart.
function ratioOf(time, fastest) {
  if (time.seconds === null || fastest === null) return null;
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
