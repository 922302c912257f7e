// SPDX-License-Identifier: GPL-3.0-or-later
// Saves a plot as a file of its own: with a title, a legend, and colours written out.

const drawn = [
  "fill",
  "stroke",
  "stroke-width",
  "stroke-dasharray",
  "stroke-opacity",
  "fill-opacity",
  "opacity",
  "font-size",
  "font-family",
  "font-weight",
  "text-anchor",
];
const svgSpace = "http://www.w3.org/2000/svg";

function svgElement(tag, attributes, text = "") {
  const node = document.createElementNS(svgSpace, tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.textContent = text;
  return node;
}

// A copy in which what style sheets and variables gave is written out.
function standAlone(plot) {
  const copy = plot.cloneNode(true);
  const theirs = [plot, ...plot.querySelectorAll("*")];
  const ours = [copy, ...copy.querySelectorAll("*")];
  theirs.forEach((node, k) => {
    const computed = getComputedStyle(node);
    for (const name of drawn) {
      const value = computed.getPropertyValue(name);
      if (value) ours[k].setAttribute(name, value);
    }
    ours[k].removeAttribute("style");
    ours[k].removeAttribute("class");
  });
  copy.querySelectorAll("style").forEach((node) => node.remove());
  copy.querySelectorAll("[aria-label=tip]").forEach((node) => node.remove());
  return copy;
}

function svgFile({ plot, title, legend }) {
  const width = Number(plot.getAttribute("width"));
  const height = Number(plot.getAttribute("height"));
  const page = getComputedStyle(document.documentElement);
  const ink = page.getPropertyValue("--ink").trim();
  const rowHeight = 18;
  const top = 28;
  const bottom = legend.length * rowHeight + 8;
  const svg = svgElement("svg", {
    xmlns: svgSpace,
    width,
    height: top + height + bottom,
    viewBox: `0 0 ${width} ${top + height + bottom}`,
    "font-family": "sans-serif",
    "font-size": 12,
  });
  svg.append(svgElement("title", {}, title));
  svg.append(
    svgElement("rect", { width: "100%", height: "100%", fill: page.getPropertyValue("--surface").trim() }),
  );
  svg.append(
    svgElement(
      "text",
      { x: 8, y: 18, fill: ink, "font-weight": "bold", "font-size": fitting(title, width) },
      title,
    ),
  );
  const inner = standAlone(plot);
  inner.setAttribute("y", top);
  svg.append(inner);
  legend.forEach(({ name, style }, k) => {
    const key = keySymbol(style, (colour) => page.getPropertyValue(colour.slice(4, -1)).trim());
    key.setAttribute("transform", `translate(10, ${top + height + 4 + k * rowHeight})`);
    svg.append(key, svgElement("text", { x: 44, y: top + height + 16 + k * rowHeight, fill: ink }, name));
  });
  return { text: new XMLSerializer().serializeToString(svg), width, height: top + height + bottom };
}

// A size at which a line of text has room.
function fitting(text, width) {
  return Math.max(6, Math.min(13, (1.75 * (width - 16)) / text.length));
}

// A line with a symbol on it, 28 by 14.
function keySymbol(style, colourOf = (colour) => colour) {
  const colour = colourOf(style.colour);
  const shape = d3[`symbol${style.symbol[0].toUpperCase()}${style.symbol.slice(1)}`] ?? hexagonShape;
  const group = svgElement("g", {});
  group.append(
    svgElement("line", {
      x1: 0,
      x2: 28,
      y1: 8,
      y2: 8,
      stroke: colour,
      "stroke-width": 1.6,
      "stroke-dasharray": style.dash,
    }),
  );
  group.append(
    svgElement("path", {
      d: d3.symbol(shape, 40)(),
      transform: "translate(14, 8)",
      stroke: colour,
      "stroke-width": 1.4,
      fill: style.hollow ? colourOf("var(--surface)") : colour,
    }),
  );
  return group;
}

const hexagonShape = {
  draw(context, size) {
    const r = Math.sqrt(size / 2.6);
    d3.range(6).forEach((k) => {
      const [x, y] = [r * Math.sin((k * Math.PI) / 3), r * Math.cos((k * Math.PI) / 3)];
      if (k === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    });
    context.closePath();
  },
};

function saveSvg(subject) {
  download(new Blob([svgFile(subject).text], { type: "image/svg+xml" }), `${fileName(subject.file)}.svg`);
}

function savePng(subject) {
  const sharpness = 3;
  const { text, width, height } = svgFile(subject);
  const source = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
  const image = new Image();
  image.onload = () => {
    const canvas = element("canvas", { width: sharpness * width, height: sharpness * height });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    URL.revokeObjectURL(source);
    canvas.toBlob((blob) => download(blob, `${fileName(subject.file)}.png`), "image/png");
  };
  image.src = source;
}

function fileName(text) {
  return text
    .toLowerCase()
    .replace(/[^a-z0-9.^-]+/g, "-")
    .replace(/^-+|-+$/g, "")
    .slice(0, 120);
}

function download(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  // The browser has taken the address by then.
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
