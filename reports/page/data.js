// SPDX-License-Identifier: GPL-3.0-or-later
// The embedded documents, with words and columns put back in their places.

function readDocuments() {
  return JSON.parse(document.getElementById("results").textContent).map(readDocument);
}

function readDocument(raw, number) {
  const word = (index) => (index === null || index === undefined ? null : raw.words[index]);
  const series = raw.series.map((entry, index) => readSeries(entry, index, word));
  const doc = {
    ...raw,
    id: `document-${number + 1}`,
    series,
    runs: readRuns(raw.runs, series, word),
    stabilities: raw.stabilities.map((entry) => readStability(entry, word)),
    secondLaws: raw.second_laws.map((entry) => readSecondLaw(entry, word)),
    envelopes: raw.envelopes.map((entry) => readEnvelope(entry, word)),
    surfaces: raw.surfaces.map((entry) => readSurface(entry, word)),
  };
  doc.cases = casesOf(doc);
  markVerdicts(doc);
  nameFormulations([...series, ...doc.envelopes, ...doc.surfaces]);
  for (const list of [
    doc.profiles,
    doc.histories,
    doc.spectra,
    doc.stabilities,
    doc.perturbations,
    doc.secondLaws,
  ]) {
    for (const entry of list) {
      entry.run = doc.runs[entry.run];
      entry.series = entry.run.series;
    }
  }
  return doc;
}

// Ladders at the setting with which the verdict across cases judges their formulation, and how it stands there: 0 is
// first.
function markVerdicts(doc) {
  for (const s of doc.series) s.verdictPlace = Infinity;
  for (const { rows } of doc.summary) {
    rows
      .filter((row) => !row.is_control)
      .forEach((row, place) => {
        for (const index of row.series) doc.series[index].verdictPlace = place;
      });
  }
}

function readSettings(raw, word) {
  return Object.fromEntries(Object.entries(raw).map(([key, value]) => [key, word(value)]));
}

function readSeries(raw, index, word) {
  const levels = raw.levels.map(([resolution, spacing, replicates, failed, status, time]) => ({
    resolution,
    spacing,
    replicates,
    failed,
    status: word(status),
    time: readTime(time),
  }));
  const { time, to_percent, to_permille, ...row } = raw.row;
  const orders = raw.orders.map((entry) => readOrder(entry, word));
  return {
    ...raw,
    index,
    isControl: raw.is_control,
    row: {
      ...row,
      time: readTime(time),
      toPercent: readTarget(to_percent),
      toPermille: readTarget(to_permille),
    },
    levels,
    orders,
    case: word(raw.case),
    parameters: word(raw.parameters),
    label: word(raw.label),
    formulation: word(raw.formulation),
    work: word(raw.work),
    conduction: word(raw.conduction),
    settings: readSettings(raw.settings, word),
  };
}

// What was observed of one field, region and norm; `law`, `floor` and numbers are null where the data cannot say.
function readOrder(raw, word) {
  const [field, region, norm] = raw.of.map(word);
  const [order, lower, upper] = raw.order;
  const [floor, coefficient, exponent, nextCoefficient, nextExponent] = raw.law ?? [];
  const none = raw.errors.map(() => null);
  return {
    field,
    region,
    norm,
    allowed: raw.allowed,
    scale: raw.scale,
    order,
    lower,
    upper,
    verdict: word(raw.verdict),
    reason: word(raw.reason),
    errors: raw.errors,
    spreads: raw.spreads ?? none,
    means: raw.means ?? none,
    model: word(raw.model),
    law: raw.law ? { floor, coefficient, exponent, nextCoefficient, nextExponent } : null,
    floor: raw.floor ? { value: raw.floor[0], lower: raw.floor[1], upper: raw.floor[2] } : null,
    targets: (raw.targets ?? []).map(([relative, error, resolution, remark]) => ({
      relative,
      error,
      resolution,
      remark: word(remark),
    })),
  };
}

// Run time with the 95% interval of its median, where repeats give one.
function readTime([seconds, low, high]) {
  return { seconds, low, high };
}

function readTarget({ time, is_bound }) {
  return { ...readTime(time), isBound: is_bound };
}

function readRuns({ columns, rows }, series, word) {
  return rows.map((row) => {
    const run = Object.fromEntries(columns.map((column, k) => [column, row[k]]));
    run.label = word(run.label);
    run.case = word(run.case);
    run.status = word(run.status);
    run.reason = word(run.reason);
    run.time = readTime(run.time ?? [null, null, null]);
    run.series = run.series === null ? null : series[run.series];
    return run;
  });
}

function readStability(raw, word) {
  const readMode = ([growth, frequency, wavelength, wallShare, centre]) => ({
    growth,
    frequency,
    wavelength,
    wallShare,
    centre,
  });
  return {
    ...raw,
    method: word(raw.method),
    remark: word(raw.remark),
    worst: raw.worst && readMode(raw.worst),
    steps: raw.steps.map(([method, theory, measured, remark]) => ({
      method: word(method),
      theory,
      measured,
      remark: word(remark),
    })),
  };
}

function readSecondLaw(raw, word) {
  const readBreach = ([size, time, position]) => ({ size, time, position });
  return {
    run: raw.run,
    overshoot: readBreach(raw.overshoot),
    undershoot: readBreach(raw.undershoot),
    coldToHot: readBreach(raw.cold_to_hot),
    entropy: raw.entropy,
    remark: word(raw.remark),
  };
}

function readEnvelope(raw, word) {
  return {
    ...raw,
    case: word(raw.case),
    label: word(raw.label),
    formulation: word(raw.formulation),
    work: word(raw.work),
    conduction: word(raw.conduction),
    settings: readSettings(raw.settings, word),
    points: raw.points.map(([value, status]) => ({ value, status: word(status) })),
  };
}

// Numbers with their 95% intervals are [value, lower, upper].
function readSurface(raw, word) {
  const estimate = ([value, lower, upper]) => ({ value, lower, upper });
  const [field, region, norm] = raw.of.map(word);
  return {
    ...raw,
    field,
    region,
    norm,
    model: word(raw.model),
    reason: word(raw.reason),
    case: word(raw.case),
    parameters: word(raw.parameters),
    label: word(raw.label),
    formulation: word(raw.formulation),
    work: word(raw.work),
    conduction: word(raw.conduction),
    settings: readSettings(raw.settings, word),
    smoothingExponent: estimate(raw.exponents[0]),
    samplingExponent: estimate(raw.exponents[1]),
    spacingExponent: estimate(raw.exponents[2]),
    neighbourExponent: estimate(raw.exponents[3]),
    best: raw.best.map(([resolution, ratio, edge, error, gridRatio, gridError, advice]) => ({
      resolution,
      ratio: estimate(ratio),
      edge: word(edge),
      error,
      gridRatio,
      gridError,
      advice,
    })),
    cells: raw.cells.map(([resolution, ratio, replicates, error, spread, fitted, seconds]) => ({
      resolution,
      ratio,
      replicates,
      error,
      spread,
      fitted,
      seconds,
    })),
    paths: raw.paths.map((path) => ({
      unit: path.unit,
      gridExponent: path.grid_exponent,
      reason: word(path.reason),
      points: path.points.map(([error, resolution, ratio, cost]) => ({
        error,
        resolution,
        ratio: estimate(ratio),
        cost,
      })),
      rules: path.rules.map(([exponent, resolution, ratio, error, errorRatio, costRatio, remark]) => ({
        exponent,
        resolution,
        ratio,
        error,
        errorRatio: estimate(errorRatio),
        costRatio: estimate(costRatio),
        remark: word(remark),
      })),
    })),
  };
}

// On a case that compares rates alone, forms of different equations have different exact values: none is
// better than another. What such a form approximates; empty on other cases.
function operatorOf(series) {
  if (!series.case.startsWith("operator/")) return "";
  const room = series.formulation.split("/")[0];
  return series.formulation === "work/total-energy" ? "work on total energy" : room;
}

// A case is an identifier with its parameters; those that tell the cases of one identifier apart name it.
function casesOf(doc) {
  const cases = new Map();
  for (const s of doc.series) {
    const operator = operatorOf(s);
    const key = `${s.case} ${s.parameters} ${operator}`;
    if (!cases.has(key)) cases.set(key, { key, id: s.case, operator, parameters: s.parameters, series: [] });
    cases.get(key).series.push(s);
    s.caseKey = key;
  }
  for (const s of doc.surfaces) s.caseKey = `${s.case} ${s.parameters} ${operatorOf(s)}`;
  const list = [...cases.values()];
  for (const one of list) {
    const others = list.filter((other) => other !== one && other.id === one.id);
    const words = parametersOf(one.parameters);
    const own = words.filter((w) => others.some((other) => !parametersOf(other.parameters).includes(w)));
    one.name = [one.id, one.operator, ...own].filter((text) => text !== "").join(", ");
    for (const s of one.series) s.caseName = one.name;
  }
  return list;
}

// Lists in the text of the parameters hold blanks: a parameter begins where a name and "=" follow a blank.
function parametersOf(text) {
  return text === "" ? [] : text.split(/ (?=[a-z_]+=)/);
}

// "p-rho2 + total" for momentum/p-rho2 with work/total-energy, where p-rho2 has several partners.
function nameFormulations(series) {
  const bare = (id) => id.slice(id.indexOf("/") + 1).replace(/-energy$/, "");
  for (const s of series) {
    s.form = bare(s.formulation);
    for (const kind of ["work", "conduction"]) {
      const partners = new Set(
        series.filter((o) => o.formulation === s.formulation && o[kind]).map((o) => o[kind]),
      );
      if (s[kind] && partners.size > 1) s.form += ` + ${bare(s[kind])}`;
    }
  }
  // Forms of one bare name in different rooms keep their room.
  for (const s of series) {
    const rooms = new Set(
      series.filter((o) => bare(o.formulation) === bare(s.formulation)).map((o) => o.formulation),
    );
    s.longForm = rooms.size > 1 ? s.form.replace(bare(s.formulation), s.formulation) : s.form;
  }
  for (const s of series) {
    s.form = s.longForm;
    s.name = s.walls === "on" ? s.form : `${s.form} (walls ${s.walls})`;
  }
}

// Settings in which some series differ: they tell panels and rows apart.
function varyingSettings(series) {
  if (series.length === 0) return [];
  return Object.keys(series[0].settings).filter(
    (key) => new Set(series.map((s) => s.settings[key])).size > 1,
  );
}

// A layout speaks for itself; of the others the quantity is named: "h/dx 1.2".
function settingText(series, keys) {
  const text = (key) => (key === "layout" ? "" : `${key} `) + series.settings[key];
  return keys.map(text).join(" · ") || "one setting";
}

// Colour and symbol stand for the formulation, dashes and hollow symbols for the control without wall terms.
function stylesOf(series) {
  // Without wall terms it is the control of its form; images or dummies make it another one.
  const formOf = (s) => (s.walls === "off" ? s.form : s.name);
  const forms = [...new Set(series.map(formOf))];
  const symbols = ["circle", "square", "triangle", "diamond", "star", "wye", "triangle2", "hexagon"];
  return new Map(
    series.map((s) => {
      const k = forms.indexOf(formOf(s));
      return [
        s.name,
        {
          colour: `var(--series-${(k % 8) + 1})`,
          symbol: symbols[(k + Math.floor(k / 8)) % symbols.length],
          dash: s.walls === "off" ? "5 4" : "none",
          hollow: s.walls === "off",
        },
      ];
    }),
  );
}

function orderEntry(series, { field, region, norm }) {
  return series.orders.find((o) => o.field === field && o.region === region && o.norm === norm) ?? null;
}
