// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"

#include "cli/help_texts.h"
#include "cli/suggestions.h"
#include "system/front_end.h"
#include <equiaffine/base/Input_error.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace equiaffine {

std::string Option_row::name() const {
  const std::size_t dashes = names.find("--");
  if (dashes == std::string::npos) return names;
  std::string name = names.substr(dashes + 2, names.find(',', dashes) - dashes - 2);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<const Option_row*> options_of(Command command) {
  std::vector<const Option_row*> rows;
  for (const auto& part : {source_options(), surface_options(), map_options(), output_options()})
    for (const Option_row& row : part)
      if (row.commands & command) rows.push_back(&row);
  return rows;
}

namespace {

/// Writes the usage lines, which are part of the descriptions, and keeps the line breaks of all texts. The formatters
/// of CLI11 change line breaks, and differ between versions.
class Help_formatter : public CLI::FormatterBase {
public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    std::string help = app->get_description();
    add_section(help, "Positionals", app->get_options([](const CLI::Option* o) { return o->get_positional(); }));
    for (const std::string& group : app->get_groups())
      add_section(help, group, app->get_options([&](const CLI::Option* o) {
        return o->nonpositional() && o->get_group() == group;
      }));
    if (const auto commands = app->get_subcommands({}); !commands.empty()) {
      help += "\nCommands:\n";
      for (const CLI::App* command : commands) {
        const std::string description = command->get_description();
        help += padded("  " + command->get_name(), 14) + description.substr(0, description.find('\n')) + '\n';
      }
    }
    return help + '\n' + app->get_footer() + '\n';
  }

private:
  static void add_section(std::string& help, const std::string& title, const std::vector<const CLI::Option*>& options) {
    if (!options.empty()) help += '\n' + title + ":\n";
    for (const CLI::Option* option : options) {
      const std::string type = option->get_type_name();
      std::string line = "  ";
      for (const std::string& name : option->get_snames()) line += '-' + name + ',';
      line += option->get_positional() ? option->get_name(true) : "--" + option->get_lnames().front();
      line += type.empty() ? "" : ' ' + type;
      if (line.size() >= text_column) line += '\n' + std::string(text_column, ' ');
      help += padded(line, text_column);
      for (const char c : option->get_description())
        help += c == '\n' ? '\n' + std::string(text_column, ' ') : std::string(1, c);
      help += '\n';
    }
  }

  static std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
  }

  static constexpr std::size_t text_column = 30;
};

struct Command_text {
  Command command;
  const char *name, *description, *footer;
};

constexpr std::array<Command_text, 7> command_texts = {
    {{MESH, "mesh", mesh_description, mesh_footer},
     {EVALUATE, "evaluate", evaluate_description, evaluate_footer},
     {SAMPLE, "sample", sample_description, sample_footer},
     {VIEW, "view", view_description, view_footer},
     {ANNOTATE, "annotate", annotate_description, annotate_footer},
     {REGISTER, "register", register_description, register_footer},
     {SYMMETRIES, "symmetries", symmetries_description, symmetries_footer}}};

/// The title of the section in the help of a command.
std::string title_of(Option_group group, Command command) {
  switch (group) {
  case Option_group::INPUT: return "Input";
  case Option_group::SOURCE:
    return command == SAMPLE       ? "Source (one of --function, --distance-to, --fit)"
           : command == REGISTER   ? "Source, before and after the word \"to\" (one of FILE, --function, --volume, "
                                     "--distance-to, --fit)"
           : command == SYMMETRIES ? "Source (one of FILE, --function, --volume, --distance-to, --fit)"
                                   : "Source (one of --function, --volume, --distance-to, --fit)";
  case Option_group::BOX: return command == SAMPLE ? "Sampling" : title_of(Option_group::SOURCE, command);
  case Option_group::FIT: return command == ANNOTATE ? "Fit" : "Fit (with --fit)";
  case Option_group::SURFACE: return "Surface";
  case Option_group::SAMPLING: return command == EVALUATE || command == ANNOTATE ? "Surface" : "Sampling";
  case Option_group::MARCHING_CUBES: return "Sampling with --method marching-cubes";
  case Option_group::DELAUNAY: return "Sampling with --method delaunay";
  case Option_group::REMESH: return "Sampling with --method remesh";
  case Option_group::MAPS: return "Maps";
  default: return "Output";
  }
}

/// The table of options as a CLI::App, and the options found on the command line.
class Grammar {
public:
  Grammar() : app_(program_description, "equiaffine") {
    app_.formatter(std::make_shared<Help_formatter>());
    add_help_flag(app_);
    app_.set_version_flag("--version", "equiaffine " EQUIAFFINE_VERSION, "show the version")->group(title_of_flags);
    app_.footer(program_footer);
    app_.require_subcommand(0, 1);
    app_.allow_extras();
    for (const Command_text& text : command_texts) {
      CLI::App& command = add_command(text);
      for (const Option_row* row : options_of(text.command)) add(command, *row, title_of(row->group, text.command));
    }
  }

  Command_line split(std::vector<std::string> arguments) {
    admit_longer_lists(arguments);
    std::reverse(arguments.begin(), arguments.end());
    try {
      app_.parse(arguments);
    } catch (const CLI::CallForHelp&) {
      result_.information = app_.help();
      return result_;
    } catch (const CLI::CallForVersion& version) {
      result_.information = std::string(version.what()) + '\n';
      return result_;
    } catch (const CLI::ArgumentMismatch& error) { // "--box: 6 required .. missing"
      const std::string text = error.what(), option = text.substr(0, text.find(':'));
      if (app_.get_subcommands().empty()) fail_before_command("--"); // CLI11 parses a command after --, and loses it
      throw Input_error(option + ": it needs " + app_.get_subcommands().front()->get_option(option)->get_type_name() +
                        "; " + see_help());
    } catch (const CLI::ParseError& error) {
      throw Input_error(std::string(error.what()) + "; " + see_help());
    }
    check_words();
    return result_;
  }

private:
  CLI::App& add_command(const Command_text& text) {
    CLI::App& command = *app_.add_subcommand(text.name, text.description);
    add_help_flag(command);
    command.footer(text.footer);
    command.allow_extras();
    return command;
  }

  static void add_help_flag(CLI::App& app) { app.set_help_flag("-h,--help", "show this help")->group(title_of_flags); }

  void add(CLI::App& command, const Option_row& row, const std::string& title) {
    const auto keep = [this, name = row.name()](const CLI::results_t& words) {
      result_.options[name] = words;
      return true;
    };
    CLI::Option& option = *command.add_option(row.names, keep, row.help);
    const auto [least, most] = row.words;
    option.type_name(row.type)->type_size(std::max(least, 1))->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (least == 0) option.expected(0);
    else if (most == unlimited) option.expected(least, CLI::detail::expected_max_vector_size)->allow_extra_args();
    else if (least == 1 && most > 1) option.expected(1, most);
    else if (most > least) number_lists_.push_back({&command, &option, &row});
    option.group(title);
  }

  /// Lets options take all numbers that follow them: beyond the least number of words, CLI11 would treat a number such
  /// as -.5 as an option. The option itself rejects too many numbers.
  void admit_longer_lists(const Words& arguments) {
    for (const auto& [command, option, row] : number_lists_)
      for (auto word = arguments.begin(); word != arguments.end(); ++word) {
        if (!row->has_name(*word) || command->get_name() != arguments.front()) continue;
        const auto count = std::find_if_not(word + 1, arguments.end(), is_number) - (word + 1);
        if (count > row->words.least) option->type_size(int(count));
      }
  }

  std::string see_help() const {
    const std::vector<CLI::App*> commands = app_.get_subcommands();
    return "see 'equiaffine" + (commands.empty() ? "" : " " + commands.front()->get_name()) + " --help'";
  }

  static Words names(const CLI::App& command) {
    Words names;
    for (const CLI::Option* option : command.get_options())
      if (option->nonpositional()) names.push_back("--" + option->get_lnames().front());
    return names;
  }

  void check_words() {
    if (const Words rest = app_.remaining(); !rest.empty()) fail_before_command(rest.front());
    if (app_.get_subcommands().empty())
      throw Input_error("the command is missing; use mesh, evaluate, sample, view, annotate, register or symmetries, " +
                        see_help());
    const CLI::App& command = *app_.get_subcommands().front();
    result_.command = std::find_if(command_texts.begin(), command_texts.end(), [&](const Command_text& text) {
                        return text.name == command.get_name();
                      })->command;
    for (const Option_row* row : options_of(result_.command))
      if (result_.has(row->name())) check_words_of(command, *row);
    if (const Words rest = command.remaining(); !rest.empty()) fail_after_command(command, rest.front());
  }

  [[noreturn]] void fail_before_command(const std::string& word) const {
    if (word.starts_with('-'))
      throw Input_error("option '" + word + "' stands before the command; write 'equiaffine COMMAND [options]', " +
                        see_help());
    Words names;
    for (const Command_text& text : command_texts) names.emplace_back(text.name);
    throw Input_error("unknown command '" + word + "'" + suggestion(word, names) + "; " +
                      advice_or_help(advice_on_command(word)));
  }

  [[noreturn]] void fail_after_command(const CLI::App& command, const std::string& word) const {
    if (word.size() > 1 && word.starts_with('-')) {
      const std::string name = word.substr(0, word.find('=')), advice = advice_on_option(result_.command, name);
      throw Input_error("unknown option '" + word + "'" + (advice.empty() ? suggestion(name, names(command)) : "") +
                        "; " + advice_or_help(advice));
    }
    throw Input_error("unexpected word '" + word + "'; " + advice_or_help(advice_on_word(result_, word)));
  }

  std::string advice_or_help(const std::string& advice) const { return advice.empty() ? see_help() : advice; }

  void check_words_of(const CLI::App& command, const Option_row& row) const {
    const std::string text = row.names.starts_with('-') ? option_text(row.name()) : row.names;
    const Words& words = result_.options.at(row.name());
    if (words.size() > std::max<std::size_t>(1, std::size_t(command.get_option(text)->get_items_expected_max())))
      throw Input_error(text + ": it is given more than once; give it once");
    for (const std::string& word : words) {
      if (word.starts_with('-') && command.get_option_no_throw(word))
        throw Input_error(text + ": a value is missing before " + word + "; " + see_help());
      if (word.empty()) throw Input_error(text + ": a value is empty; " + see_help());
    }
  }

  /// An option with a variable number of numbers.
  struct Number_list {
    const CLI::App* command;
    CLI::Option* option;
    const Option_row* row;
  };

  static constexpr const char* title_of_flags = "Options"; // CLI11's own name for it differs from version to version
  CLI::App app_;
  std::vector<Number_list> number_lists_;
  Command_line result_;
};

} // namespace

Command_line split_command_line(const std::vector<std::string>& arguments) { return Grammar().split(arguments); }

} // namespace equiaffine
