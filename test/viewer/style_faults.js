// SPDX-License-Identifier: GPL-3.0-or-later
// Prints what is wrong with style sheets: style_faults.js FILE... . Errors of syntax, properties, values, pseudo-classes
// and media features that browsers do not know, and custom properties that not every theme can have.
"use strict";
const fs = require("fs");
const csstree = require("css-tree").fork({
  types: { "color-mix()": "color-mix( in <ident> , [ <color> && <percentage>? ]#{2} )", "color": "| <color-mix()>" },
});

// The lexer knows values of functions of mathematics as calc() alone; these are their fewest and most arguments.
const MATHEMATICS = new Map([["min", [1, Infinity]], ["max", [1, Infinity]], ["clamp", [3, 3]]]);
const PSEUDO_CLASSES = new Set(("active checked disabled empty enabled first-child first-of-type focus focus-visible " +
  "focus-within has hover in-range invalid is last-child last-of-type link not nth-child nth-of-type only-child " +
  "out-of-range placeholder-shown required root target valid visited where").split(" "));
const PSEUDO_ELEMENTS = new Set("after backdrop before first-letter first-line marker placeholder selection".split(" "));
const FEATURES = new Set(("any-hover any-pointer aspect-ratio color-gamut forced-colors height hover max-height max-width " +
  "min-height min-width orientation pointer prefers-color-scheme prefers-contrast prefers-reduced-motion width").split(" "));

/** Custom property -> the values that rules give it, in their order. */
function customProperties(tree) {
  const values = new Map();
  csstree.walk(tree, node => {
    if (node.type !== "Declaration" || !node.property.startsWith("--")) return;
    values.set(node.property, [...values.get(node.property) ?? [], csstree.generate(node.value)]);
  });
  return values;
}

function faultOfFunction(node) {
  const [fewest, most] = MATHEMATICS.get(node.name);
  const count = node.children.isEmpty ? 0 : 1 + node.children.toArray().filter(each => each.value === ",").length;
  return count < fewest || count > most ? `${node.name}() has ${count} arguments` : "";
}

function faultOfDeclaration(node) {
  if (node.property.startsWith("--")) return "";
  const { error } = csstree.lexer.matchDeclaration(node);
  return error ? `${node.property}: ${csstree.generate(node.value)}: ${error.rawMessage || error.message}` : "";
}

const faultOfFeature = node => FEATURES.has(node.name) ? "" : `there is no media feature ${node.name}`;

const CHECKS = {
  Declaration: faultOfDeclaration,
  PseudoClassSelector: node => PSEUDO_CLASSES.has(node.name) ? "" : `there is no pseudo-class ${node.name}`,
  PseudoElementSelector: node => PSEUDO_ELEMENTS.has(node.name) ? "" : `there is no pseudo-element ${node.name}`,
  MediaFeature: faultOfFeature,
  Feature: faultOfFeature, // its name in CSSTree 3
};

/** The faults of a style sheet in which custom properties have been replaced by values. */
function faults(path, text) {
  const found = [];
  const report = (node, fault) => fault && found.push(`${path}:${node.loc.start.line}: ${fault}`);
  const tree = csstree.parse(text, {
    positions: true,
    onParseError: error => found.push(`${path}:${error.line}: ${error.message}`),
  });
  csstree.walk(tree, node => {
    if (node.type !== "Function" || !MATHEMATICS.has(node.name)) return;
    report(node, faultOfFunction(node));
    node.name = "calc";
  });
  csstree.walk(tree, node => CHECKS[node.type] && report(node, CHECKS[node.type](node)));
  return found;
}

/** The first rule has all custom properties, and the rules of other themes change some of them. */
function faultsOfThemes(path, tree) {
  const found = [];
  let all = null;
  csstree.walk(tree, { visit: "Block", enter: block => {
    const names = block.children.toArray().filter(each => each.type === "Declaration" && each.property.startsWith("--"))
      .map(each => each.property);
    if (!all && names.length > 0) all = new Set(names);
    else found.push(...names.filter(name => !all.has(name)).map(name => `${path}: the first theme does not set ${name}`));
  } });
  return found;
}

function faultsOfFile(path) {
  const text = fs.readFileSync(path, "utf8"), tree = csstree.parse(text), values = customProperties(tree);
  const found = new Set(faultsOfThemes(path, tree));
  const themes = Math.max(1, ...[...values.values()].map(each => each.length));
  for (let theme = 0; theme < themes; ++theme) {
    const replaced = text.replace(/var\((--[\w-]+)\)/g, (whole, name) => {
      if (!values.has(name)) found.add(`${path}: no rule sets ${name}`);
      return values.get(name)?.[Math.min(theme, values.get(name).length - 1)] ?? whole;
    });
    for (const fault of faults(path, replaced)) found.add(fault);
  }
  return [...found];
}

const found = process.argv.slice(2).flatMap(faultsOfFile);
console.log(found.join("\n") || "no fault in style sheets");
process.exit(found.length > 0 ? 1 : 0);
