// SPDX-License-Identifier: GPL-3.0-or-later
// Converts keyword arguments of Python to words for the program's table of options, which checks them.
#ifndef EQUIAFFINE_BINDINGS_PYTHON_OPTIONS_H
#define EQUIAFFINE_BINDINGS_PYTHON_OPTIONS_H

#include "cli/command_line.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <pybind11/pybind11.h>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::python {

namespace py = pybind11;

inline bool is_text(const py::handle& value) {
  return py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value);
}

/// A number as the shortest text that represents it exactly, or a string or bytes that do not represent a number.
/// Nothing for any other value.
inline std::optional<std::string> word_of(const py::handle& value) {
  py::detail::make_caster<std::string> text; // UTF-8, or bytes
  py::detail::make_caster<bool> flag;
  if (is_text(value)) {
    if (text.load(value, false) && !is_number(text)) return std::string(text);
    PyErr_Clear();
    return std::nullopt;
  }
  if (flag.load(value, false) || PyComplex_Check(value.ptr())) return std::nullopt;
  if (PyObject* const whole = PyNumber_Index(value.ptr())) return py::str(py::reinterpret_steal<py::object>(whole));
  PyErr_Clear();
  const double number = PyFloat_AsDouble(value.ptr());
  if (!PyErr_Occurred()) return py::repr(py::float_(number));
  PyErr_Clear();
  return std::nullopt;
}

/// Adds the word of a number or a string, the words of a sequence of at most `most` items, or NAME=VALUE for each item
/// of a dictionary. Returns false if a value is neither a number nor a string, or if there are more items.
inline bool add_words(const py::handle& value, std::size_t most, Words& words) {
  if (py::hasattr(value, "items")) {
    for (const py::handle& item : value.attr("items")()) {
      const auto [name, number] = item.cast<std::pair<py::object, py::object>>();
      const std::optional<std::string> word = word_of(number);
      if (!word) return false;
      words.push_back(std::string(py::str(name)) + '=' + *word);
    }
    return true;
  }
  const auto add = [&](const py::handle& item) {
    const std::optional<std::string> word = word_of(item);
    if (word) words.push_back(*word);
    return word.has_value() && words.size() <= most;
  };
  if (most > 1 && !is_text(value)) {
    if (PyObject* const items = PyObject_GetIter(value.ptr()))
      return std::all_of(py::reinterpret_steal<py::iterator>(items), py::iterator::sentinel(), add);
    PyErr_Clear(); // an array with no dimensions is a number
  }
  return add(value);
}

/// Describes the valid values of an option.
inline std::string expected_values(const Option_row& row) {
  if (row.words.least == 0) return "True or False";
  if (row.words.most == unlimited) return "a dictionary of names and numbers";
  if (row.words.least > 1) return std::to_string(row.words.least) + " numbers";
  if (row.words.most > 1) return "a whole number, or three";
  if (row.type == "NAME") return "a string";
  if (row.type.find('|') == std::string::npos) return row.type == "N" ? "a whole number" : "a number";
  const std::string words = std::regex_replace(row.type, std::regex("^[A-Z](?=\\|)"), "a number");
  return std::regex_replace(words, std::regex("\\|"), " or ");
}

/// Adds an option to the command line. True becomes the flag `name`, and False the flag "no_" + name. Throws
/// `Input_error` if a value has the wrong type, or if the number of values is wrong.
inline void add_option(const std::string& name, const py::handle& value, Command_line& line) {
  const std::vector<const Option_row*> rows = options_of(line.command);
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Option_row* each) {
    return each->name() == name || each->name() == "no_" + name;
  });
  if (found == rows.end()) throw std::logic_error("the command has no option " + name);
  const Option_row& row = **found;
  const auto [least, most] = row.words;
  const bool is_list = row.type.ends_with("|LIST");
  constexpr std::size_t longest_list = 1000;
  const bool is_flag = least == 0, takes_dictionary = !is_flag && most == unlimited;
  py::detail::make_caster<bool> flag;
  Words words;
  bool is_valid =
      is_flag ? flag.load(value, false) : py::hasattr(value, "items") == takes_dictionary &&
                         add_words(value, is_list ? longest_list : std::size_t(most), words);
  if (is_valid && is_flag && bool(flag) == (row.name() == name)) words = {"true"};
  if (is_list && is_valid) {
    std::string list;
    for (const std::string& word : words) list += (list.empty() ? "" : ",") + word;
    words = {list};
  }
  if (!is_flag && !takes_dictionary)
    is_valid = is_valid && words.size() >= std::size_t(least) && words.size() <= std::size_t(most);
  if (!is_valid)
    throw Input_error(name + ": give " + expected_values(row) + ", not " + std::string(py::repr(value)));
  if (!words.empty()) line.options[row.name()] = words;
}

/// The command line of a command that returns its results and writes no files. Options and sources are given by name.
inline Command_line command_line_of(Command command, const py::dict& options) {
  Command_line line{.command = command, .options = {}, .information = {}, .writes_files = false};
  for (const auto& [name, value] : options) add_option(name.cast<std::string>(), value, line);
  return line;
}

} // namespace equiaffine::python

#endif
