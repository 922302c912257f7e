// SPDX-License-Identifier: GPL-3.0-or-later
// What the fitted law of an error says: e(d) = F + A d^p (1 + c d^q), d the spacing over the finest level's.

// How far beyond the finest level a law is drawn: one more doubling.
const lawReach = 2;

// The level that d counts in: the finest that has an error. Null without one.
function finestLevel(series, entry) {
  const k = entry.errors.findLastIndex((error) => error !== null);
  return k < 0 ? null : { resolution: series.levels[k].resolution, error: entry.errors[k] };
}

// The law at N particles, with another exponent in the place of its own where one is given.
function lawAt(law, finest, resolution, exponent = law.exponent) {
  const d = finest.resolution / resolution;
  return law.floor + law.coefficient * d ** exponent * (1 + law.nextCoefficient * d ** law.nextExponent);
}

// Points of the law from the coarsest level with an error to beyond the finest: {x, y}, errors over `scale`.
function lawCurve(series, entry, scale) {
  const finest = finestLevel(series, entry);
  if (!entry.law || !finest) return [];
  const first = series.levels[entry.errors.findIndex((error) => error !== null)].resolution;
  const steps = 48;
  const ratio = (lawReach * finest.resolution) / first;
  return d3
    .range(steps + 1)
    .map((k) => first * ratio ** (k / steps))
    .map((x) => ({ x, y: lawAt(entry.law, finest, x) / scale }))
    .filter(({ y }) => y > 0);
}

// Between the ends of the order's interval, from the finest level on: {x, low, high}. Where a law was fitted its
// other terms stay as they are.
function orderFan(series, entry, scale) {
  const finest = finestLevel(series, entry);
  if (entry.order === null || entry.lower === null || entry.upper === null || !finest) return [];
  if (!(finest.error > 0)) return [];
  const plain = {
    floor: 0,
    coefficient: finest.error,
    exponent: entry.order,
    nextCoefficient: 0,
    nextExponent: 1,
  };
  const law = entry.law ?? plain;
  const steps = 12;
  return d3
    .range(steps + 1)
    .map((k) => finest.resolution * lawReach ** (k / steps))
    .map((x) => ({
      x,
      low: lawAt(law, finest, x, entry.upper) / scale,
      high: lawAt(law, finest, x, entry.lower) / scale,
    }))
    .filter(({ low }) => low > 0);
}

function floorText(floor, format) {
  if (!floor) return "not known";
  return `${format(floor.value)} [${format(floor.lower)}, ${format(floor.upper)}]`;
}

// Where the law comes down to a part of the exact field's norm: "N = 120", or why there is no such N.
function targetResolutionText(entry, relative) {
  const target = entry?.targets.find((t) => t.relative === relative);
  if (!target) return "not known";
  if (target.resolution === null) return target.remark || "not known";
  const text = `N = ${formatResolution(target.resolution)}`;
  return target.remark ? `${text}, ${target.remark}` : text;
}

// Particles are counted: the next whole number that is enough.
function formatResolution(value) {
  return value < 1e5 ? String(Math.ceil(value - 1e-9)) : formatNumber(value);
}

// Lines of a hover text: model, floor and where 1% is reached. Documents of older versions have none of these.
function lawLines(entry, scale, format) {
  if (!entry.model && !entry.law && !entry.floor && entry.targets.length === 0) return [];
  const over = (value) => format(value / scale);
  const lines = [`model: ${entry.model ?? "none"}; floor ${floorText(entry.floor, over)}`];
  if (entry.targets.some((t) => t.relative === 0.01)) lines.push(`1%: ${targetResolutionText(entry, 0.01)}`);
  return lines;
}
