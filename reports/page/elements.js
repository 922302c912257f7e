// SPDX-License-Identifier: GPL-3.0-or-later
// Small helpers that make elements. Text from the documents enters the page as text alone, never as HTML.

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (typeof value === "boolean") node.toggleAttribute(name, value);
    else if (value !== null && value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child !== null));
  return node;
}

function select(label, options, chosen, onchange) {
  const list = element("select", { onchange: (event) => onchange(event.target.value) });
  for (const [value, text] of options) {
    list.append(element("option", { value, selected: value === chosen }, text));
  }
  return element("label", { class: "choice" }, element("span", {}, label), list);
}

// What the numbers come to, in words: `lines` are [kind, text], kind "good", "care", "bad" or nothing.
function sentenceList(lines) {
  return element(
    "ul",
    { class: "sentences" },
    ...lines.map(([kind, text]) => element("li", { class: kind }, text)),
  );
}

// A heading that can be linked to.
function section(doc, name, title, ...children) {
  const id = `${doc.id}-${name}`;
  return element(
    "section",
    { class: `part ${name}`, id, "aria-labelledby": `${id}-title` },
    element("h3", { id: `${id}-title` }, title),
    ...children,
  );
}
