# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints all sentences that users see, for a review: messages.py [ROOT [FOLDER...]].

Each line is `file:line<TAB>sentence`. Adjacent literals are joined, and inserted values appear as {}. A literal counts
as a sentence if it contains two words: errors and advice, help texts, report lines, and the text of pages."""
import ast
import pathlib
import re
import sys

FOLDERS = ["program", "src", "include", "bindings", "viewer"]
TOKEN = re.compile(r"""(?P<skip>//[^\n]*|/\*.*?\*/|^[ ]*\#[^\n]*|\s+|'(?:\\.|[^'\\\n])'|(?<=\w)'(?=\w))
                       |R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"|"(?P<quoted>(?:\\.|[^"\\\n])*)"
                       |(?P<template>`(?:\\.|[^`\\])*`)|(?P<open>[({\[])|(?P<close>[)}\]])
                       |(?P<end>->|[,;?]|(?<!:):(?!:)|(?<![=!<>])=(?!=)|\breturn\b)|(?P<plus>\+=?|<<)
                       |(?P<value>\w+|.)""",
                   re.DOTALL | re.MULTILINE | re.VERBOSE)
SENTENCE = re.compile(r"[a-z]\w*[,;:.'\"]* +(?:[\w'\"(<]*[a-z]|\{\})|\{\}[,;:.'\"]* [a-z]")
MARKUP = re.compile(r"<!--.*?-->|<(style|script).*?</\1>|<[^>]*>", re.DOTALL)


def code_sentences(text):
    """(line, sentence) of C++ or JavaScript: the literals between two brackets, commas or semicolons make one."""
    stack, parts, line = [], [], 0

    def flush():
        nonlocal parts
        if any(part != "{}" for part in parts):
            yield line, re.sub(r"(\{\})+", "{}", "".join(parts))
        parts = []

    for match in TOKEN.finditer(text):
        kind = match.lastgroup if match.lastgroup != "mark" else "raw"
        if kind in ("raw", "quoted", "template"):
            if all(part == "{}" for part in parts):
                line = text.count("\n", 0, match.start()) + 1
            literal = match[kind] if kind != "template" else re.sub(r"\$\{[^}]*\}", "{}", match[kind][1:-1])
            parts.append(literal if kind == "raw" else re.sub(r'\\(["`\\])', r"\1", literal.replace("\\n", " ")))
        elif kind == "open":
            stack.append((parts, line))
            parts = []
        elif kind in ("close", "end"):
            yield from flush()
            if kind == "close" and stack:
                parts, line = stack.pop()
                parts.append("{}")
        elif kind == "value":
            parts.append("{}")


def python_sentences(text):
    """(line, sentence) of Python: exceptions, and docstrings, which help() shows."""
    tree = ast.parse(text)
    inserted = {id(part) for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for part in node.values}
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            yield node.lineno, "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in inserted:
            yield node.lineno, node.value


def page_sentences(text):
    """(line, sentence) of HTML or XML: the text between tags, and titles."""
    text = MARKUP.sub(lambda match: "\0" + "\n" * match[0].count("\n"), text)
    for match in re.finditer(r"[^\0]+", text):
        yield text.count("\n", 0, match.start()) + 1, match[0]


READERS = {".cpp": code_sentences, ".cxx": code_sentences, ".h": code_sentences, ".js": code_sentences,
           ".mjs": code_sentences, ".py": python_sentences, ".html": page_sentences, ".xml": page_sentences}

if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
    for file in sorted(path for folder in sys.argv[2:] or FOLDERS for path in (root / folder).rglob("*.*")):
        for number, sentence in READERS.get(file.suffix, lambda text: [])(file.read_text("utf-8", "replace")):
            if SENTENCE.search(sentence):
                print(f"{file.relative_to(root)}:{number}\t{' '.join(sentence.split())}")
