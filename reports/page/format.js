// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as text.

const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function powerOfTen(exponent) {
  const digits = [...String(Math.abs(exponent))].map((d) => superscripts[d]).join("");
  return `10${exponent < 0 ? "⁻" : ""}${digits}`;
}

function formatDecade(value) {
  const exponent = Math.log10(value);
  const nearest = Math.round(exponent);
  if (Math.abs(exponent - nearest) > 1e-9) return "";
  return nearest >= -2 && nearest <= 2 ? String(Number(value.toPrecision(3))) : powerOfTen(nearest);
}

function formatNumber(value) {
  if (value === null || value === undefined) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e-4 && size < 1e5
    ? String(Number(value.toPrecision(3)))
    : value.toExponential(1).replace(".0e", "e");
}

function formatPercent(value) {
  if (value === null || value === undefined) return "–";
  const hundredths = 100 * value;
  if (Math.abs(hundredths) < 1e-9) return "0%";
  if (Math.abs(hundredths) >= 1e4) return `${hundredths.toExponential(1)}%`;
  return `${Number(hundredths.toPrecision(2))}%`;
}

function formatSeconds(value) {
  if (value === null || value === undefined) return "–";
  const [scale, unit] = value >= 1 ? [1, "s"] : value >= 1e-3 ? [1e3, "ms"] : [1e6, "µs"];
  return `${Number((value * scale).toPrecision(3))} ${unit}`;
}

// With the 95% interval of the median, where there is one.
function formatTime({ seconds, low, high }) {
  if (low === null || high === null) return formatSeconds(seconds);
  return `${formatSeconds(seconds)} [${formatSeconds(low)}, ${formatSeconds(high)}]`;
}

function formatOrder(order, lower, upper) {
  if (order === null || order === undefined) return "–";
  // Nothing below 0 is left of -0.001.
  const text = (value) => value.toFixed(2).replace(/^-0\.00$/, "0.00");
  return lower === null || upper === null ? text(order) : `${text(order)} [${text(lower)}, ${text(upper)}]`;
}

function formatRatio(value) {
  return value < 9.95 ? value.toFixed(2) : String(Number(value.toPrecision(3)));
}

function plural(count, one, many = `${one}s`) {
  return `${count} ${count === 1 ? one : many}`;
}
