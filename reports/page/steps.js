// SPDX-License-Identifier: GPL-3.0-or-later
// The longest steps that explicit methods can take for ever: by theory, from the spectrum, and by experiment.

// The experiment tells steps apart that differ by 0.2% (of leapfrog by 0.5%), and what grows slowly shows itself
// only beyond its limit: within this part of theory the two agree.
const stepAgreement = 0.01;

function stepRows(view, series) {
  return view.doc.stabilities
    .filter((entry) => series.includes(entry.series))
    .flatMap((entry) =>
      entry.steps.map((step) => {
        const isTried = step.theory > 0 && step.measured !== null;
        const difference = isTried ? step.measured / step.theory - 1 : null;
        return {
          ...step,
          remark: step.remark ?? entry.remark,
          name: entry.series.name,
          series: entry.series,
          run: entry.run,
          growing: entry.growing,
          grows: entry.grows,
          isKnown: entry.growing !== null || entry.worst !== null,
          difference,
          agrees: isTried ? Math.abs(difference) <= stepAgreement : null,
        };
      }),
    );
}

function agreementText(row) {
  if (row.agrees === null) return "";
  // A mode may grow too slowly for the steps that were tried to show it.
  const words = row.grows
    ? ", but a mode grows"
    : row.isKnown
      ? ""
      : ", but whether a mode grows is not known";
  return (row.agrees ? "agree" : "differ") + words;
}

// No step at all is stable, whatever its length.
function hasNoStep(row) {
  return row.theory === null && (row.remark ?? "").startsWith("no step is stable");
}

function stepSection(view) {
  const rows = stepRows(view, view.series);
  if (rows.length === 0) return null;
  const sentences = [...d3.group(rows, (row) => row.name)].map(([name, own]) => {
    const tried = own.filter((row) => row.agrees !== null);
    const agreeing = tried.filter((row) => row.agrees);
    const widest = d3.greatest(tried, (row) => Math.abs(row.difference));
    const without = own.filter(hasNoStep).length;
    const parts = [];
    if (tried.length) {
      parts.push(
        `theory and experiment agree within ${formatPercent(stepAgreement)} on ${agreeing.length} of ` +
          `${plural(tried.length, "step")}, at most ${formatPercent(Math.abs(widest.difference))} apart`,
      );
    }
    const growing = tried.filter((row) => row.grows).length;
    const unknown = tried.filter((row) => !row.isKnown).length;
    if (growing) parts.push(`a mode grows on ${growing} of them all the same`);
    if (unknown) parts.push(`whether a mode grows is not known on ${unknown} of them`);
    if (without) parts.push(`no step is stable on ${without} of ${own.length}`);
    const isGood = agreeing.length === tried.length && growing + unknown + without === 0;
    return parts.length ? [isGood ? "good" : "care", `${name}: ${parts.join("; ")}.`] : null;
  });
  return section(
    view.doc,
    "steps",
    "Largest stable steps",
    element(
      "p",
      { class: "hint" },
      "Of each ladder's finest resolution, every replicate. Upright bar: by theory, from the spectrum and the " +
        "method's stability polynomial. Symbol: by experiment. Cross at the left edge: no step is stable.",
    ),
    sentenceList(sentences.filter(Boolean)),
    stepPanels(view, rows),
    stepTable(view, rows),
  );
}

// With its sign: +0.2%.
function formatDifference(value) {
  if (value === null) return "–";
  return `${value > 0 ? "+" : value < 0 ? "−" : ""}${formatPercent(Math.abs(value))}`;
}

function stepPanels(view, all) {
  const x = paddedLog(all.flatMap((row) => [row.theory, row.measured]));
  const rowsOf = (series) => all.filter((row) => series.includes(row.series));
  const methods = [...new Set(all.map((row) => row.method))];
  return panelGrid(
    bySetting(view).filter(({ series }) => rowsOf(series).length),
    ({ title, series }) => {
      const bands = bandsOf(methods, [...new Set(rowsOf(series).map((row) => row.name))]);
      const rows = rowsOf(series).map((row) => ({ ...row, y: bands.place(row.method, row.name) }));
      const text = (row) =>
        `${row.name}\n${row.method}\nby theory ${formatSeconds(row.theory)}, by experiment ` +
        `${formatSeconds(row.measured)}${row.remark ? `\n${row.remark}` : ""}`;
      const known = rows.filter((row) => row.theory !== null || row.measured !== null);
      const none = rows.filter(hasNoStep);
      const edge = () => x[0];
      const plot = Plot.plot(
        plotOptions(`Largest stable steps: ${title}`, {
          ...bands.options,
          x: { type: "log", domain: x, ...decades(x), grid: true, label: "step [s] →" },
          marks: [
            ...bands.marks,
            Plot.ruleX(
              rows.filter((row) => row.theory !== null),
              {
                x: "theory",
                y1: (row) => row.y - 0.45,
                y2: (row) => row.y + 0.45,
                stroke: (row) => view.styles.get(row.name).colour,
                strokeWidth: 2.5,
                ariaDescription: "by theory",
              },
            ),
            ...dotMark(
              view,
              rows.filter((row) => row.measured !== null),
              "measured",
              "y",
              { ariaDescription: "by experiment" },
            ),
            ...crossMark(view, none, edge, "y", "no step is stable"),
            tips(known, (row) => row.measured ?? row.theory, "y", text),
            tips(none, edge, "y", text),
          ],
        }),
      );
      return figure(
        view,
        `Largest stable steps, ${title}`,
        plot,
        [...new Set(rows.map((row) => row.name))],
        title,
      );
    },
  );
}

function stepTable(view, rows) {
  const columns = filled(
    [
      ...runColumns(view.series),
      { label: "method", value: (row) => row.method },
      numberColumn("by theory", (row) => row.theory, formatSeconds),
      numberColumn("by experiment", (row) => row.measured, formatSeconds),
      numberColumn("difference", (row) => row.difference, formatDifference),
      { label: "agreement", value: agreementText },
      growthColumn(),
      { label: "remark", value: (row) => row.remark },
    ],
    rows,
  );
  const isBad = (row) => row.agrees === false || hasNoStep(row);
  return sortableTable("Largest stable steps", columns, rows, (row) => (isBad(row) ? "failed" : null));
}
