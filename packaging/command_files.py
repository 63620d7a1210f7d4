#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the manual page and the completions for bash, zsh and fish: command_files.py PROGRAM FOLDER

They are generated from the output of --help of the program and of its commands."""
import argparse
import dataclasses
import gzip
import pathlib
import re
import subprocess
import sys

HEADING = re.compile(r"^\S.*:$")
COLUMN = 30  # where the text of an option begins, on the line of its name if preceded by a space
OPTION = re.compile(r"^  (?P<names>-[^ ]+)(?: (?P<words>\S.*?))? *$")
EXAMPLE = re.compile(r"^(Examples?:) *(.*)$")
WORD = re.compile(r"^  (?P<name>[A-Za-z][\w.|]*) {2,}(?P<text>.*)$")  # a command, or a placeholder of a file
KEYWORD = re.compile(r"^[a-z0-9-]+$")


@dataclasses.dataclass
class Option:
    names: list
    words: str  # the values after the name
    text: str

    @property
    def choices(self):
        """The keywords among the alternatives, such as auto in S|auto."""
        alternatives = self.words.split("|")
        return [word for word in alternatives if KEYWORD.match(word)] if len(alternatives) > 1 else []

    @property
    def summary(self):
        """The first part of the help."""
        return re.split(r"[;:] |\. ", self.text)[0]


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout.splitlines()


def option_of(line):
    """The option that begins in a line, with the first line of its text; None if there is none."""
    head, text = line, ""
    if len(line) > COLUMN and line[COLUMN - 1] == " " and not line[COLUMN].isspace():
        head, text = line[:COLUMN], line[COLUMN:]
    found = OPTION.match(head)
    return Option(found["names"].split(","), found["words"] or "", text) if found else None


def options_of(lines):
    """The options of a help text. Continuation lines have the same indentation as the text of an option."""
    options = []
    for line in lines:
        if found := option_of(line):
            options.append(found)
        elif options and line.startswith(" " * COLUMN):
            options[-1].text = (options[-1].text + " " + line.strip()).strip()
        elif EXAMPLE.match(line):
            break
    return options


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text)


def manual_page(version, program_lines, commands):
    """The help texts of the program and of each command, with the options as tagged paragraphs."""
    usage, = (line for line in program_lines if line.startswith("Usage: "))
    page = [f'.TH EQUIAFFINE 1 "" "equiaffine {version}" "User Commands"', ".SH NAME", roff(program_lines[0]), ".SH SYNOPSIS"]
    for line in re.split(" {2,}", usage.removeprefix("Usage: ")):
        page += [roff(line), ".br"]
    page += [".SH DESCRIPTION", *body([line for line in program_lines[1:] if line != usage])]
    for name, lines in commands.items():
        page += [f'.SH "EQUIAFFINE {name.upper()}"', *body(lines)]
    return "\n".join(page) + "\n"


def body(lines):
    """A help text as roff: paragraphs, options and commands with their texts, and examples without filling."""
    page, is_example = [], False
    for line in lines:
        option, word = option_of(line), WORD.match(line)
        if is_example and line.startswith(" "):
            page.append(roff(line))
            continue
        if is_example:
            page.append(".fi")
            is_example = False
        if found := EXAMPLE.match(line):
            page += [".PP", found[1], ".PP", ".nf"] + ([roff(found[2])] if found[2] else [])
            is_example = True
        elif option:
            tag = ", ".join(rf"\fB{roff(name)}\fR" for name in option.names)
            page += [".TP", tag + (rf" \fI{roff(option.words)}\fR" if option.words else ""), roff(option.text)]
        elif word:
            page += [".TP", rf"\fB{roff(word['name'])}\fR", roff(word["text"])]
        elif HEADING.match(line) and not line.startswith("Usage"):
            page.append(f'.SS "{roff(line[:-1])}"')
        else:
            page.append(roff(line.strip()) if line else ".PP")
    if is_example:
        page.append(".fi")
    return [line for line in page if line]


def quoted(text):
    return "'" + text.replace("'", r"'\''") + "'"


def bash_completion(commands, own_options):
    first = [*commands, *(name for option in own_options for name in option.names)]
    cases = []
    for name, options in commands.items():
        names = " ".join(word for option in options for word in option.names)
        cases.append(f"    {name}) options={quoted(names)} ;;")
    choices = [f"    {quoted(f'{command} {name}')}) COMPREPLY=($(compgen -W {quoted(' '.join(option.choices))} -- \"$word\")); return ;;"
               for command, options in commands.items() for option in options if option.choices for name in option.names]
    return "\n".join(
        ["# Completion of equiaffine for bash.", "_equiaffine() {", "  local word=${COMP_WORDS[COMP_CWORD]} options=",
         "  if ((COMP_CWORD == 1)); then",
         f"    COMPREPLY=($(compgen -W {quoted(' '.join(first))} -- \"$word\"))", "    return", "  fi",
         "  case \"${COMP_WORDS[1]} ${COMP_WORDS[COMP_CWORD - 1]}\" in", *choices, "  esac", "  case ${COMP_WORDS[1]} in", *cases, "  esac",
         "  [[ $word != -* ]] || COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))", "}",
         "complete -o default -F _equiaffine equiaffine", ""])


def zsh_completion(commands, own_options, summaries):
    def argument(option):
        words = re.sub(r"[:\[\]]", " ", option.words)
        action = f"({' '.join(option.choices)})" if option.choices else "_files"
        value = f":{words}:{action}" if words else ""
        text = re.sub(r"[\[\]]", "", option.summary).replace(":", "\\:")
        return [quoted(f"*{name}[{text}]{value}") for name in option.names]

    listed = " ".join(quoted(f"{name}:{text}") for name, text in summaries.items())
    flags = " ".join(quoted(f"{name}:{option.text}") for option in own_options for name in option.names)
    lines = ["#compdef equiaffine", "", "_equiaffine() {", f"  local -a commands=({listed}) flags=({flags})",
             "  if ((CURRENT == 2)); then", "    _describe command commands -- flags", "    return", "  fi", "  case $words[2] in"]
    for name, options in commands.items():
        lines.append(f"    {name})")
        lines.append("      _arguments \\")
        lines += [f"        {entry} \\" for option in options for entry in argument(option)]
        lines += ["        '*:file:_files' ;;"]
    return "\n".join([*lines, "  esac", "}", "", '_equiaffine "$@"', ""])


def fish_completion(commands, own_options, summaries):
    def names_of(option):
        return " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names)

    lines = ["# Completion of equiaffine for fish."]
    for option in own_options:
        lines.append(f"complete -c equiaffine -n __fish_use_subcommand {names_of(option)} -d {quoted(option.summary)}")
    for name, text in summaries.items():
        lines.append(f"complete -c equiaffine -f -n __fish_use_subcommand -a {name} -d {quoted(text)}")
    for command, options in commands.items():
        for option in options:
            values = f" -x -a {quoted(' '.join(option.choices))}" if option.choices else " -r" if option.words else ""
            lines.append(f"complete -c equiaffine -n '__fish_seen_subcommand_from {command}' {names_of(option)}{values} "
                         f"-d {quoted(option.summary)}")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    options = parser.parse_args()
    program = options.program.resolve()
    lines = help_of(program)
    summaries = {found["name"]: found["text"] for line in lines if (found := WORD.match(line))}
    helps = {name: help_of(program, name) for name in summaries}
    commands = {name: options_of(text) for name, text in helps.items()}
    own_options = options_of(lines)
    if not own_options or not commands or not all(commands.values()):
        sys.exit(f"command_files: the help of {program} lacks commands, or options of a command; check its format")
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[-1]
    options.folder.mkdir(parents=True, exist_ok=True)
    (options.folder / "equiaffine.1.gz").write_bytes(gzip.compress(manual_page(version, lines, helps).encode(), mtime=0))
    (options.folder / "equiaffine.bash").write_text(bash_completion(commands, own_options))
    (options.folder / "_equiaffine").write_text(zsh_completion(commands, own_options, summaries))
    (options.folder / "equiaffine.fish").write_text(fish_completion(commands, own_options, summaries))


if __name__ == "__main__":
    main()
