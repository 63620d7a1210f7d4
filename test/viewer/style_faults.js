// SPDX-License-Identifier: GPL-3.0-or-later
// Prints what is wrong with style sheets: style_faults.js FILE... . Errors of syntax, properties and values that browsers
// do not know, and custom properties that no rule sets.
"use strict";
const fs = require("fs");
const csstree = require("css-tree").fork({
  types: { "color-mix()": "color-mix( in <ident> , [ <color> && <percentage>? ]#{2} )", "color": "| <color-mix()>" },
});

// The lexer knows values of functions of mathematics as calc() alone.
const MATHEMATICS = new Set(["min", "max", "clamp"]);

function customProperties(tree) {
  const values = new Map();
  csstree.walk(tree, node => {
    const isCustom = node.type === "Declaration" && node.property.startsWith("--");
    if (isCustom) values.set(node.property, csstree.generate(node.value));
  });
  return values;
}

/** The faults of a style sheet in which custom properties have been replaced by their values. */
function faults(path, text) {
  const found = [];
  const tree = csstree.parse(text, {
    positions: true,
    onParseError: error => found.push(`${path}:${error.line}: ${error.message}`),
  });
  csstree.walk(tree, node => {
    if (node.type === "Function" && MATHEMATICS.has(node.name)) node.name = "calc";
  });
  csstree.walk(tree, node => {
    if (node.type !== "Declaration" || node.property.startsWith("--")) return;
    const { error } = csstree.lexer.matchDeclaration(node);
    if (!error) return;
    const value = csstree.generate(node.value), reason = error.rawMessage || error.message;
    found.push(`${path}:${node.loc.start.line}: ${node.property}: ${value}: ${reason}`);
  });
  return found;
}

function faultsOfFile(path) {
  const text = fs.readFileSync(path, "utf8"), values = customProperties(csstree.parse(text)), unknown = [];
  const replaced = text.replace(/var\((--[\w-]+)\)/g, (whole, name) => {
    if (!values.has(name)) unknown.push(`${path}: no rule sets ${name}`);
    return values.get(name) ?? whole;
  });
  return [...unknown, ...faults(path, replaced)];
}

const found = process.argv.slice(2).flatMap(faultsOfFile);
console.log(found.join("\n") || "no fault in style sheets");
process.exit(found.length > 0 ? 1 : 0);
