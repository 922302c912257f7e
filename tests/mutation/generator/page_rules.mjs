// SPDX-License-Identifier: GPL-3.0-or-later
// The mutants of the page's scripts, as JSON on the standard output: node page_rules.mjs FOLDER_OF_NPM FILE...
// What each field means is said in pieces.py; the rules are those of cpp_rules.py as far as JavaScript has them.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [folder, ...files] = process.argv.slice(2);
const acorn = createRequire(`${folder}/`)("acorn");

const ON = "\0";
const comparisons = {
  "<": ["<=", ">"],
  "<=": ["<", ">="],
  ">": [">=", "<"],
  ">=": [">", "<="],
  "===": ["!=="],
  "!==": ["==="],
};
const otherOperator = { "+": "-", "-": "+", "*": "/", "/": "*" };
const otherAssignment = { "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=" };

function mutantsOf(source) {
  const mutants = [];
  const leftOut = {};
  const span = (node) => [node.start, node.end];
  const text = (node) => source.slice(node.start, node.end);
  const leave = (reason) => (leftOut[reason] = (leftOut[reason] ?? 0) + 1);

  function add(rule, [start, end], mutated, pieces) {
    const says = mutated.map((p) => (typeof p === "string" ? p : source.slice(...p))).join("");
    if (says === source.slice(start, end)) return leave("same text");
    const line = source.slice(0, start).split("\n").length;
    pieces ??= ["(", ON, " ? (", ...mutated, ") : (", [start, end], "))"];
    mutants.push({ start, end, rule, says, pieces, mutated, line });
  }

  function binary(node) {
    const [a, b] = [span(node.left), span(node.right)];
    const { operator } = node;
    if (comparisons[operator]) {
      for (const other of comparisons[operator]) add("comparison", span(node), [a, ` ${other} `, b]);
    } else if (otherOperator[operator]) {
      if (/["'`]/.test(text(node))) return; // words
      add("operator", span(node), [a, ` ${otherOperator[operator]} `, b]);
      const neutral = operator === "+" || operator === "-" ? "0" : "1";
      if (text(node.right) === neutral) leave("neutral");
      else add("dropped", span(node), [a]);
      if (operator === "/") return;
      if (text(node.left) === neutral) leave("neutral");
      else add("dropped", span(node), operator === "-" ? ["-(", b, ")"] : [b]);
    } else if (operator === "%" || operator === "**") {
      add("dropped", span(node), [a]);
    }
  }

  function logical(node) {
    const [a, b] = [span(node.left), span(node.right)];
    if (node.operator !== "??") add("operator", span(node), ["(", a, node.operator === "&&" ? ") || (" : ") && (", b, ")"]);
    add("dropped", span(node), [a]);
    add("dropped", span(node), [b]);
  }

  function literal(node) {
    if (typeof node.value === "boolean") add("constant", span(node), [String(!node.value)]);
    if (typeof node.value !== "number") return;
    if (Number.isInteger(node.value) && !/[.e]/.test(node.raw)) {
      add("off by one", span(node), [node.raw, " + 1"]);
      if (node.value !== 0) add("off by one", span(node), [node.raw, " - 1"]);
    } else {
      add("constant", span(node), ["2 * ", node.raw]);
      add("constant", span(node), ["1.1 * ", node.raw]);
    }
  }

  function swapped(args) {
    for (let k = 0; k + 1 < args.length; ++k) {
      const [one, other] = [args[k], args[k + 1]];
      // Types are not known: of one kind of expression, and neither a function nor words.
      if (one.type !== other.type || /Function|Object|Spread|Template/.test(one.type)) continue;
      if (typeof one.value === "string" || typeof one.value !== typeof other.value) continue;
      const [a, b] = [span(one), span(other)];
      const between = [a[1], b[0]];
      add("swapped", [a[0], b[1]], [b, between, a],
        ["(", ON, " ? (", b, ") : (", a, "))", between, "(", ON, " ? (", a, ") : (", b, "))"]);
    }
  }

  const visitors = {
    BinaryExpression: binary,
    LogicalExpression: logical,
    Literal: literal,
    UnaryExpression(node) {
      if (node.operator === "!") add("lost !", span(node), ["Boolean(", span(node.argument), ")"]);
      if (node.operator === "-") add("sign", span(node), [span(node.argument)]);
    },
    ConditionalExpression(node) {
      if (node.test.operator !== "!") add("condition", span(node.test), ["!(", span(node.test), ")"]);
    },
    IfStatement(node) {
      if (node.test.operator !== "!") add("condition", span(node.test), ["!(", span(node.test), ")"]);
    },
    AssignmentExpression(node) {
      const other = otherAssignment[node.operator];
      if (other && !/["'`]/.test(text(node.right)))
        add("operator", span(node), [span(node.left), ` ${other} `, span(node.right)]);
    },
    CallExpression(node) {
      const callee = text(node.callee);
      const other = { "Math.min": "Math.max", "Math.max": "Math.min", "d3.min": "d3.max", "d3.max": "d3.min" }[callee];
      if (other) add("operator", span(node), [other, [node.callee.end, node.end]]);
      if (/\.(min|max|hypot)$/.test(callee)) leave("commutes");
      else swapped(node.arguments);
    },
    ArrayExpression: (node) => swapped(node.elements.filter((e) => e)),
    MemberExpression(node) {
      if (!node.computed || node.optional || typeof node.property.value === "string") return;
      if (!/^(\d+|[a-z]|[kij]\w*|\w+ [-+] \d)$/.test(text(node.property))) return; // what looks like an index
      const at = span(node.property);
      add("index", at, [at, " - 1, or 1 for 0"], ["(", ON, " ? ((", at, ") === 0 ? 1 : (", at, ") - 1) : (", at, "))"]);
    },
    ExpressionStatement(node) {
      if (node.directive) return;
      add("left out", span(node), [";"], ["{ if (!", ON, ") ", span(node), " }"]);
    },
  };

  function functionBody(node) {
    if (node.body?.type !== "BlockStatement" || node.body.body.length === 0) return;
    const first = node.body.body[0].start;
    add("early return", [first - 1, first], [[first - 1, first], "return; "],
      [[first - 1, first], "if (", ON, ") return; "]);
  }

  function walk(node, key) {
    if (!node || typeof node.type !== "string") return;
    if (/Function/.test(node.type)) functionBody(node);
    visitors[node.type]?.(node);
    for (const [name, child] of Object.entries(node)) {
      if (node.type === "Property" && name === "key" && !node.computed) continue;
      // The index rule stays within bounds.
      if (node.type === "MemberExpression" && name === "property" && child.type === "Literal") continue;
      if (Array.isArray(child)) child.forEach((c) => walk(c, name));
      else if (child && typeof child === "object") walk(child, name);
    }
  }
  walk(acorn.parse(source, { ecmaVersion: "latest", sourceType: "script", preserveParens: true }));
  return { mutants, leftOut };
}

console.log(JSON.stringify(files.map((file) => mutantsOf(readFileSync(file, "utf8")))));
