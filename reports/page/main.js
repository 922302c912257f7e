// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the page together: each document with its verdicts, its choices, and what follows from these.

function show() {
  const documents = readDocuments();
  const place = document.getElementById("documents");
  if (documents.length > 1) {
    place.append(
      element(
        "p",
        { class: "note" },
        `${documents.length} results documents, one after another. Run times of ` +
          "different documents are not compared: they may come from different machines.",
      ),
    );
  }
  place.append(...documents.map(documentPart));
  fillContents(documents);
  themeButton();
  document.documentElement.dataset.drawn = "true";
}

function documentPart(doc) {
  const node = element(
    "article",
    { class: "document", id: doc.id, "aria-labelledby": `${doc.id}-title` },
    element("h2", { id: `${doc.id}-title` }, doc.study.name ?? doc.name),
    runLine(doc),
  );
  node.append(summarySection(doc));
  const chosen = doc.series.length > 0 ? chosenPart(doc) : null;
  node.append(
    ...[envelopeSection(doc), chosen, failureSection(doc), skippedSection(doc), contextSection(doc)].filter(
      Boolean,
    ),
  );
  return node;
}

// In a line what was run; the rest stands at the end, under About the run.
function runLine(doc) {
  const failed = doc.runs.filter((run) => run.status !== "ok").length;
  return element(
    "p",
    { class: "parameters" },
    `${plural(doc.runs.length, "run")} in ${plural(doc.series.length, "ladder")}, ${failed} failed, ` +
      `${plural(doc.skipped.length, "combination")} skipped`,
  );
}

function contextSection(doc) {
  const { version, commit, compiler, flags, processor, cores, date, program, added } = doc.context;
  const parts = added.length ? `, with ${added.join(", ")} added` : "";
  const facts = [
    ["File", doc.name],
    ["Program", `${program} ${version} (${commit})${parts}`],
    ["Built with", `${compiler} ${flags}`],
    ["Machine", `${processor}, ${plural(cores, "core")}`],
    ["Date", date.replace("T", " ").replace("Z", " UTC")],
  ];
  return section(
    doc,
    "context",
    "About the run",
    element(
      "dl",
      {},
      ...facts.flatMap(([term, text]) => [
        element("div", {}, element("dt", {}, term), element("dd", {}, text)),
      ]),
    ),
    element(
      "details",
      {},
      element("summary", {}, "The study as it was run"),
      element("pre", {}, JSON.stringify(doc.study, null, 1)),
    ),
  );
}

// The choices and everything that is drawn anew when one of them changes.
function chosenPart(doc) {
  const state = { caseKey: doc.cases[0].key, settings: {}, hidden: new Set(), allCases: false, memory: {} };
  const drawn = element("div", { class: "drawn" });
  const form = element("form", {
    class: "filters",
    "aria-label": "What the plots and tables show",
    onsubmit: (event) => event.preventDefault(),
  });
  const redraw = () => drawn.replaceChildren(...partsOf(viewOf(doc, state, drawn)));
  const update = (changes) => {
    Object.assign(state, changes);
    fillForm(form, doc, state, update);
    redraw();
  };
  fillForm(form, doc, state, update);
  redraw();
  // Only another width of the plots draws them anew, and never one that printing makes.
  let width = plotWidth(null);
  new ResizeObserver(() => {
    if (plotWidth(drawn) === width || matchMedia("print").matches) return;
    width = plotWidth(drawn);
    redraw();
  }).observe(drawn);
  return element("div", { class: "chosen" }, form, drawn);
}

function fillForm(form, doc, state, update) {
  const one = doc.cases.find((c) => c.key === state.caseKey);
  const focused = form.contains(document.activeElement) ? document.activeElement.dataset.key : null;
  const choices = choicesOf(one);
  state.choice = nearestChoice(choices, state.choice, one);
  const options = (values) => values.map((v) => [v, v]);
  const chooser = (key, values) =>
    select(key, options(values), state.choice[key], (value) =>
      update({ choice: { ...state.choice, [key]: value } }),
    );
  const parts = [
    select(
      "case",
      doc.cases.map((c) => [c.key, c.name]),
      state.caseKey,
      (caseKey) => update({ caseKey, settings: {} }),
    ),
    ...["field", "region", "norm"].map((key) => chooser(key, [...new Set(choices.map((c) => c[key]))])),
    ...varyingSettings(one.series).map((key) =>
      select(
        key,
        [["", "all"], ...options([...new Set(one.series.map((s) => s.settings[key]))])],
        state.settings[key] ?? "",
        (value) => update({ settings: { ...state.settings, [key]: value } }),
      ),
    ),
  ];
  const styles = stylesOf(doc.series);
  const names = [...new Set(one.series.map((s) => s.name))];
  const boxes = names.map((name) =>
    element(
      "label",
      { class: "key" },
      element("input", {
        type: "checkbox",
        checked: !state.hidden.has(name),
        onchange: (event) => {
          const hidden = new Set(state.hidden);
          if (event.target.checked) hidden.delete(name);
          else hidden.add(name);
          update({ hidden });
        },
      }),
      keyImage(styles.get(name)),
      element("span", {}, name),
    ),
  );
  form.replaceChildren(
    element("h3", {}, "Plots and tables"),
    element("div", { class: "choices" }, ...parts),
    element("fieldset", { class: "legend" }, element("legend", {}, "Formulations"), ...boxes),
  );
  form.querySelectorAll("select, input").forEach((control) => {
    control.dataset.key = control.closest("label").textContent;
  });
  if (focused) [...form.querySelectorAll("select, input")].find((c) => c.dataset.key === focused)?.focus();
}

function keyImage(style) {
  const svg = svgElement("svg", { width: 30, height: 16, viewBox: "-1 0 30 16", "aria-hidden": "true" });
  svg.append(keySymbol(style));
  return svg;
}

function choicesOf(one) {
  const seen = new Map();
  for (const { field, region, norm } of one.series.flatMap((s) => s.orders)) {
    seen.set(`${field} ${region} ${norm}`, { field, region, norm });
  }
  return [...seen.values()];
}

// The choice itself where the case has it, else what the tables of `sphverify compare` show.
function nearestChoice(choices, choice, one) {
  const same = (a, b) => a && b && a.field === b.field && a.region === b.region && a.norm === b.norm;
  const found = choices.find((c) => same(c, choice));
  if (found) return found;
  const { row } = one.series.find((s) => s.row.field !== "") ?? one.series[0];
  const usual = { field: row.field, region: "all", norm: row.norm };
  return choices.find((c) => same(c, usual)) ?? choices[0] ?? usual;
}

// Of the plots that take the whole width; in steps, so that a scroll bar that comes or goes changes nothing.
function plotWidth(place) {
  const room = place?.clientWidth || document.documentElement.clientWidth - 20;
  return Math.max(300, Math.min(900, 20 * Math.floor(room / 20)));
}

// What is drawn under the present choices.
function viewOf(doc, state, place) {
  const one = doc.cases.find((c) => c.key === state.caseKey);
  const matches = (s) =>
    !state.hidden.has(s.name) &&
    Object.entries(state.settings).every(([key, value]) => value === "" || s.settings[key] === value);
  const series = one.series.filter(matches);
  // Relative only if every series can be: else numbers of two kinds would share an axis.
  const entries = series
    .map((s) => orderEntry(s, state.choice))
    .filter((entry) => entry?.errors.some((e) => e !== null));
  return {
    doc,
    one,
    series,
    choice: state.choice,
    memory: state.memory,
    state,
    varying: varyingSettings(one.series),
    styles: stylesOf(doc.series),
    isRelative: entries.length > 0 && entries.every((entry) => entry.scale > 0),
    width: plotWidth(place),
    tableSeries: state.allCases ? doc.series.filter(matches) : series,
  };
}

function partsOf(view) {
  if (view.series.length === 0) return [element("p", { class: "note" }, "Nothing matches these choices.")];
  const parts = [
    convergenceSection,
    surfaceSection,
    costSection,
    historySection,
    profileSection,
    spectrumSection,
    modeSection,
    perturbationSection,
    stepSection,
    secondLawSection,
  ]
    .map((draw) => draw(view))
    .filter(Boolean);
  return [...parts, tableSection(view)];
}

function tableSection(view) {
  const place = element("div", {});
  const drawAll = (allCases) => {
    view.state.allCases = allCases;
    const full = viewOf(view.doc, view.state, place);
    place.replaceChildren(
      element("h4", {}, "Ladders"),
      ladderTable(full),
      element("div", { class: "runs" }, element("h4", {}, "Runs"), runTable(full)),
    );
  };
  drawAll(view.state.allCases);
  return section(
    view.doc,
    "tables",
    "Tables",
    element(
      "label",
      { class: "key" },
      element("input", {
        type: "checkbox",
        checked: view.state.allCases,
        onchange: (e) => drawAll(e.target.checked),
      }),
      element("span", {}, "all cases, not only the one chosen"),
    ),
    place,
  );
}

function fillContents(documents) {
  const list = element("ul", {});
  for (const doc of documents) {
    if (documents.length > 1) list.append(element("li", {}, element("a", { href: `#${doc.id}` }, doc.name)));
    for (const part of document.querySelectorAll(`#${doc.id} section.part`)) {
      const title = part.querySelector("h3").textContent.replace(/:.*/, "");
      list.append(element("li", {}, element("a", { href: `#${part.id}` }, title)));
    }
  }
  document.getElementById("contents").append(list);
}

function themeButton() {
  const button = document.getElementById("theme");
  const themes = ["system", "light", "dark"];
  let chosen = 0;
  button.addEventListener("click", () => {
    chosen = (chosen + 1) % themes.length;
    const theme = themes[chosen];
    chooseTheme(theme);
    button.textContent = `Colours: ${theme}`;
    button.setAttribute("aria-label", `Colours: ${theme === "system" ? "as the system" : theme}`);
  });
}
