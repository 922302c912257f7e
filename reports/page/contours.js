// SPDX-License-Identifier: GPL-3.0-or-later
// The fitted law of an error over N and h/dx, and its lines of equal error.

// e = F + sqrt(S^2 + Q^2 + 2 c S Q), S = A (r d)^p, Q = B r^-s d^t, d = N_finest/N, r = h/dx. Where the sampling error
// is no power of r, B is known at the ratios of the grid, and drawn in between as if it were a power from one to the
// next.
function surfaceLaw({ law, cells }) {
  if (!law) return null;
  const finest = d3.max(cells, (cell) => cell.resolution);
  const known = law.sampling.filter(([, coefficient]) => coefficient > 0);
  const between =
    known.length > 1
      ? d3.scaleLog(
          known.map(([ratio]) => ratio),
          known.map(([, coefficient]) => Math.log(coefficient)),
        )
      : null;
  const amplitude = (ratio) =>
    between ? Math.exp(between(ratio)) : law.sampling_coefficient * ratio ** -law.sampling_exponent;
  return (resolution, ratio) => {
    const d = finest / resolution;
    const smoothing = law.smoothing_coefficient * (ratio * d) ** law.smoothing_exponent;
    const sampling = amplitude(ratio) * d ** law.spacing_exponent;
    const square = smoothing ** 2 + sampling ** 2 + 2 * law.correlation * smoothing * sampling;
    return law.floor + Math.sqrt(Math.max(0, square));
  };
}

// Errors between the cells of a grid, straight in the logarithms; null where a cell is missing.
function betweenCells(cells, columns, rows) {
  const [ns, ratios] = [[...columns.keys()], [...rows.keys()]];
  const logs = new Map(cells.map((c) => [`${c.resolution} ${c.ratio}`, Math.log(c.relative)]));
  if (ns.length < 2 || ratios.length < 2 || logs.size < ns.length * ratios.length) return null;
  const place = (list, value) => {
    const k = Math.min(Math.max(d3.bisectRight(list, value) - 1, 0), list.length - 2);
    return [k, Math.log(value / list[k]) / Math.log(list[k + 1] / list[k])];
  };
  return (resolution, ratio) => {
    const [i, a] = place(ns, resolution);
    const [j, b] = place(ratios, ratio);
    const row = (m) => {
      const at = (k) => logs.get(`${ns[k]} ${ratios[m]}`);
      return at(i) + a * (at(i + 1) - at(i));
    };
    return Math.exp(row(j) + b * (row(j + 1) - row(j)));
  };
}

// 1, 2 and 5 times the powers of ten within a range.
function contourLevels(low, high) {
  const levels = d3
    .range(Math.floor(Math.log10(low)), Math.ceil(Math.log10(high)) + 1)
    .flatMap((k) => [1, 2, 5].map((m) => Number(`${m}e${k}`)))
    .filter((level) => level > low && level < high);
  return levels.length > 9 ? levels.filter((level) => /^1(e|$|0*$)|^0\.0*1$/.test(String(level))) : levels;
}

// Lines on which a positive function of two positive numbers has a value, within a rectangle of logarithmic axes: a
// list of lists of {x, y}.
function contourLines(value, level, [left, right], [bottom, top]) {
  const steps = 90;
  const x = (k) => left * (right / left) ** (k / (steps - 1));
  const y = (k) => bottom * (top / bottom) ** (k / (steps - 1));
  const values = d3
    .range(steps)
    .flatMap((j) => d3.range(steps).map((i) => Math.log(value(x(i), y(j)) / level)));
  const { coordinates } = d3.contours().size([steps, steps]).contour(values, 0);
  // Rings close along the border, where there is no line. Values belong to the middle of the cells of that grid.
  const isBorder = ([i, j]) => i <= 0.5 || j <= 0.5 || i >= steps - 0.5 || j >= steps - 0.5;
  const lines = [];
  for (const ring of coordinates.flat()) {
    let line = [];
    ring.forEach((point, k) => {
      const previous = ring[k - 1];
      if (previous && isBorder(previous) && isBorder(point)) {
        lines.push(line);
        line = [];
      }
      line.push({ x: x(point[0] - 0.5), y: y(point[1] - 0.5) });
    });
    lines.push(line);
  }
  return lines.filter((line) => line.length > 1);
}
