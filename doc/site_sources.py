# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what Doxygen reads, in the root of the repository: python3 doc/site_sources.py FOLDER.

A header gets the group of the classified reference that doc/reference.dox puts it into. A Markdown page, written for a
site that hosts code, gets identifiers for its headings, and its relative links become references. Names of classes and
functions in code spans become links. Signatures show `NamedParameters` where the header has a name of `internal`. Lines
keep their numbers, and files their paths below FOLDER."""
import functools
import html
import pathlib
import posixpath
import re
import sys

LIBRARY = "include/equiaffine/"
# Internal headers that a public header passes on, with what they define; users do not include them.
PASSED_ON = {"number/internal/jet.h": "number/Jet_3.h", "mesh/internal/Face_graph.h": "attributes/annotate.h"}
PAGE_FOLDERS = ("doc", "doc/manual", "doc/concepts")
DECLARATION = re.compile(r"^(?:class|struct|concept|enum class) (\w+)(?![\w;])", re.MULTILINE)
# What signatures show in the place of names that are internal.
SHOWN = (
    (r"\binternal::Parameter_chain(\.\.\.)? (?=\w)", r"class\1 "),
    (r"\binternal::Joined_parameters<Chains\.\.\.>", "NamedParameters"),
    (r"\binternal::Kernel_of_vertices<Mesh, internal::Joined_parameters<Parameters\.\.\.>>", "Kernel_of_mesh"),
    (r"\binternal::No_parameters(?= default_values)", "auto"),
    (r"\binternal::No_parameters\b", "decltype(parameters::default_values())"),
    (r"\bParameters\b", "NamedParameters"),
    (r"\binternal::(?:expression::Ordered|Mesh_or_points|Property_map) (?=\w)", "class "),
    (r"\binternal::Output_allocator<(?:[^<>]|<[^<>]*>)*>", "Unspecified"),
    (r"\binternal::default_order\b", "4"),
    (r"\binternal::Cgal_optional\b", "std::optional"),
    (r" requires internal::own_functions::Has\w+<T>", ""),
    (r"\binternal::scales_to_try\.back\(\)", "8"),
    (r"\binternal::(?=(?:all_monomials|contains)\()", ""),
)
FUNCTION = re.compile(r"^(?!using|return|static_assert|friend)(?:[\w:][\w:<>,.&* ]* )?[&*]?([a-z]\w*)\((?!.*;$)", re.MULTILINE)


@functools.cache
def groups():
    """Group -> its headers and folders of headers, from the paragraphs `Headers:` of doc/reference.dox."""
    found = re.findall(r"\\defgroup (\w+)(?:(?!\\defgroup).)*?^Headers:(.*?)^$", pathlib.Path("doc/reference.dox").read_text(),
                       re.MULTILINE | re.DOTALL)
    return {group: re.findall(r"`([^`]+)`", headers) for group, headers in found}


def group_of(header):
    for group, patterns in groups().items():
        if any(header == pattern or pattern.endswith("/") and header.startswith(pattern) for pattern in patterns):
            return group
    sys.exit(f"{header} belongs to no group of doc/reference.dox")


@functools.cache
def concept_pages():
    """A pattern of the names of concepts that have a page."""
    names = sorted((path.stem for path in pathlib.Path("doc/concepts").glob("[A-Z]*.md")), key=lambda each: (-len(each), each))
    return re.compile(rf"(?<![\w`:#])(?:{'|'.join(names)})(?![\w`.])")


def with_references(line):
    """A line of text in which names of concepts and paths of pages are references."""
    line = re.sub(r"(?<![\w`(/])doc/[\w/]+\.md", lambda match: f'@ref {page_of(match[0])} "{match[0]}"', line)
    return concept_pages().sub(lambda match: f'@ref concept_{match[0]} "{match[0]}"', line)


def with_names_for_users(text):
    """A header whose code, apart from the comments, shows no internal names where Doxygen reads it."""
    def line(match):
        code = match[0]
        for pattern, shown in SHOWN:
            code = re.sub(pattern, shown, code)
        return code

    return re.sub(r"^(?! *//|#).+", line, text, flags=re.MULTILINE)


def in_group(text, group):
    """The header with references to concepts, and with all in its outer namespaces in the group by an alias of doc/Doxyfile."""
    text = re.sub(r"^ *///.*", lambda match: with_references(match[0]), text, flags=re.MULTILINE)
    text = re.sub(r"^(namespace equiaffine(?:::(?:parameters|IO|vectorized))? \{)$", rf"\1 /** \\begin{{{group}}} */", text, flags=re.MULTILINE)
    return re.sub(r"^\n(\} // namespace equiaffine(?:::(?:parameters|IO|vectorized))?)$", r"/** @} */\n\1", text, flags=re.MULTILINE)


@functools.cache
def public_headers():
    """(path below include/equiaffine, text without what is internal) of each header, by names."""
    root = pathlib.Path(LIBRARY)
    names = [path.relative_to(root).as_posix() for path in sorted(root.rglob("*.h"), key=lambda p: (p.name.lower(), p))]
    texts = {name: (root / name).read_text() for name in names if "/internal/" not in name or name in PASSED_ON}
    hidden = re.compile(r"^/// \\cond.*?^/// \\endcond$|^namespace ((?:equiaffine::)?internal) \{.*?^\} // namespace \1$", re.M | re.S)
    return [(name, hidden.sub("", text)) for name, text in texts.items()]


def names_in(text):
    """The classes, concepts and functions of a header as they are called in equiaffine, each once, in its order."""
    namespace = "".join(name + "::" for name in ("IO", "vectorized") if f"namespace equiaffine::{name}" in text)
    if "namespace analytic_functions" in text or "namespace equiaffine::parameters" in text:
        return []
    found = [(match.start(), match[1]) for match in DECLARATION.finditer(text)]
    found += [(match.start(), match[1]) for match in FUNCTION.finditer(text)]
    return list(dict.fromkeys(namespace + name for _, name in sorted(found) if name not in ("requires", "operator", "square", "std")))


def page_of(path):
    """The identifier of the page that a Markdown file becomes; None if it is no page."""
    folder, name = posixpath.split(path)
    if not pathlib.Path(path).is_file() or not name.endswith(".md"):
        return None
    if path == "doc/manual/index.md":
        return "index"
    if path == "CHANGELOG.md" or folder in PAGE_FOLDERS:
        prefix = {"doc/manual": "manual_", "doc/concepts": "concept_"}.get(folder, "")
        return prefix + (name[:-3] if folder == "doc/concepts" else name[:-3].lower())
    return None


def slug(heading):
    """The anchor that sites which host code give a heading."""
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


class Page:
    def __init__(self, path):
        self.path, self.id, self.used = path, page_of(path), {}
        # Functions of numbers have names such as `max` and `select`, which mean others, too.
        self.names = {name for header, text in public_headers() for name in names_in(text)
                      if not header.startswith("number/") or name[0].isupper()}

    def anchor(self, page, fragment):
        return f"{page}_{fragment}" if fragment else page

    def heading(self, match):
        level, text = match[1], match[2].strip()
        if level == "#":
            return f"# {text}" if self.id == "index" else f"# {text} {{#{self.id}}}"
        fragment = slug(text)
        count = self.used[fragment] = self.used.get(fragment, -1) + 1
        return f"{level} {text} {{#{self.anchor(self.id, fragment + (f'-{count}' if count else ''))}}}"

    def link(self, match):
        mark, text, target = match[1], match[2], match[3]
        if re.match(r"[a-z]+:", target):
            return match[0]
        path, _, fragment = target.partition("#")
        path = posixpath.normpath(posixpath.join(posixpath.dirname(self.path), path)) if path else self.path
        if mark:
            return f"![{text}]({posixpath.basename(path)})"
        plain = text.replace("`", "")
        if page := page_of(path):
            return f"[{plain}](@ref {self.anchor(page, fragment)})"
        if path.startswith("examples/") and path.endswith(".cpp"):
            return f"[{posixpath.basename(path) if plain == path else plain}](@ref {posixpath.basename(path)})"
        if path == "doc/concepts":
            return f"[{plain}](@ref concepts)"
        if posixpath.basename(path) == plain or path == plain:
            return f"`{path}`"
        return f"{text} (`{path}`)"

    def code(self, match):
        """A code span that begins with the name of a class, a concept or a function links to its page."""
        span = match[1]
        if "\\|" in span:  # between backticks Doxygen 1.9.4 shows the backslash, which keeps the line from ending a cell
            return f"<code>{html.escape(span).replace('--', chr(92) + '--')}</code>"
        if span.endswith(".h") and pathlib.Path(LIBRARY, span).is_file() and self.id == "headers":
            stem = posixpath.basename(span)[:-2]
            return f"[{span}](@ref equiaffine::{stem})" if stem in self.names else match[0]
        name = re.match(r"(?:equiaffine::)?(\w+)(?=$|[<(])", span)
        if not name or name[1] not in self.names or (name[1].islower() and self.id in ("program", "conventions")):
            return match[0]  # commands and attributes have names of functions
        target = page_of(f"doc/concepts/{name[1]}.md") or f"equiaffine::{name[1]}"
        return f'<code>@ref {target} "{name[1]}"{html.escape(span[name.end():])}</code>'

    def line(self, line):
        if match := re.match(r"(#{1,6}) (.*)", line):
            return self.heading(match)
        parts = re.split(r"(!?\[[^]]*\]\([^)\s]*\))", line)  # links and images are the odd ones
        for n, part in enumerate(parts):
            if n % 2:
                parts[n] = re.sub(r"^(!?)\[([^]]*)\]\(([^)]*)\)$", self.link, part)
            else:
                spans = re.split(r"((?<!`)`[^`]+`(?!`))", part)
                spans = [re.sub("^`(.*)`$", self.code, span) if m % 2 else with_references(span) for m, span in enumerate(spans)]
                parts[n] = "".join(spans)
        return "".join(parts)

    def text(self):
        lines, is_code = [], False
        text = re.sub(r"\[([^]]*)\n([^]]*\]\([^)]*\))", r"[\1 \2\n", pathlib.Path(self.path).read_text())
        for line in text.splitlines():
            if line.lstrip().startswith("```"):
                is_code = not is_code
                line = line.replace("```console", "```sh")
            lines.append(line if is_code or line.startswith("    ") else self.line(line))
        return "\n".join(lines) + "\n"


def reference(text):
    """doc/reference.dox with the list of all names of a group in the place of each \\classified."""
    lists = {group: set() for group in groups()}
    for header, code in public_headers():
        lists[group_of(header)].update(names_in(code))

    def names(match):
        links = [f'\\ref equiaffine::{name} "{name}"' for name in sorted(lists[match[1]], key=lambda each: (each.lower(), each))]
        return f"<b>\\ref {match[1]}</b>: " + ", ".join(links) + "."

    return re.sub(r"\\classified (\w+)", names, text)


def main(target):
    def write(path, text):
        (target / path).parent.mkdir(parents=True, exist_ok=True)
        (target / path).write_text(text)

    for header, _ in public_headers():
        text = with_names_for_users(pathlib.Path(LIBRARY, header).read_text())
        write(LIBRARY + header, in_group(text, group_of(header)))
    for path in ["CHANGELOG.md"] + [str(path) for folder in PAGE_FOLDERS for path in pathlib.Path(folder).glob("*.md")]:
        write(path, Page(path).text())
    write("doc/reference.dox", reference(pathlib.Path("doc/reference.dox").read_text()))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
