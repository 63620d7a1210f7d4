// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/parse_options.h"
#include "commands/commands.h"
#include "request/options.h"
#include "system/file_memory.h"
#include "system/memory_limit.h"
#include "system/progress.h"
#include <equiaffine/base/Input_error.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <variant>

namespace equiaffine {

namespace {

#ifdef CGAL_LINKED_WITH_TBB
/// No more threads than these compute while what it returns lives.
auto limit_threads(std::size_t threads) {
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}
#else
std::unique_ptr<int> limit_threads(std::size_t) { return nullptr; } // without TBB there is one thread
#endif

/// The folder of the first output, or that for temporary files.
std::filesystem::path folder_of_output(const Options& options) {
  const std::string output = std::visit(
      [](const auto& command) -> std::string {
        if constexpr (requires { command.output; }) return command.output;
        else return "-";
      },
      options.command);
  if (output == "-") return std::filesystem::temp_directory_path();
  const auto folder = std::filesystem::path(output).parent_path();
  return folder.empty() ? "." : folder;
}

void run_command(const Options& options, const Streams& streams) {
  if (options.memory) limit_resident_memory(*options.memory, folder_of_output(options));
  const auto limit = options.threads ? limit_threads(*options.threads) : nullptr;
  Progress progress(streams.error, streams.error_is_terminal);
  struct Runner {
    std::ostream& out;
    Progress& progress;
    void operator()(const Information& information) const {
      out << information.text << std::flush;
      if (!out)
        throw Input_error("cannot write standard output: not everything was accepted; make sure that the receiver is "
                          "ready");
    }
    void operator()(const Mesh_options& o) const { run_mesh(o, out, progress); }
    void operator()(const Evaluate_options& o) const { run_evaluate(o, out, progress); }
    void operator()(const Sample_options& o) const { run_sample(o, out, progress); }
    void operator()(const View_options& o) const { run_view(o, out); }
    void operator()(const Annotate_options& o) const { run_annotate(o, out, progress); }
    void operator()(const Register_options& o) const { run_register(o, out, progress); }
    void operator()(const Symmetries_options& o) const { run_symmetries(o, out, progress); }
  };
  std::visit(Runner{streams.out, progress}, options.command);
}

/// Says what to do where a command needs too much memory.
std::string advice_on_memory(const Options& options) {
  struct Advice {
    std::string operator()(const Information&) const { return "end other programs"; }
    std::string operator()(const Mesh_options&) const {
      return "use a smaller --resolution, input or --size, or a larger --radius";
    }
    std::string operator()(const Evaluate_options&) const { return "use a smaller --resolution or input"; }
    std::string operator()(const Sample_options&) const { return "use a smaller --resolution"; }
    std::string operator()(const View_options&) const { return "use a smaller --size, or a mesh with fewer triangles"; }
    std::string operator()(const Annotate_options&) const { return "use a smaller --size, or fewer vertices"; }
    std::string operator()(const Register_options&) const { return "use a smaller --resolution or input"; }
    std::string operator()(const Symmetries_options&) const { return "use a smaller --resolution or input"; }
  };
  return std::visit(Advice(), options.command);
}

/// Reports the text in one line, even if it has several.
void report(std::ostream& stream, const std::string& kind, const std::string& text) {
  stream << "equiaffine: " << kind << ": " << printable(text) << '\n';
}

} // namespace

int run(const std::vector<std::string>& arguments, const Streams& streams) {
  constexpr int success = 0, defect = 1, error_of_user = 2;
  std::optional<Options> options;
  try {
    options = parse_options(arguments);
    run_command(*options, streams);
    streams.out.flush();
    return success;
  } catch (const Input_error& error) {
    report(streams.error, "error", error.what());
    if (!error.excerpt().empty()) streams.error << error.excerpt() << (error.excerpt().ends_with('\n') ? "" : "\n");
    return error_of_user;
  } catch (const No_room_for_scratch_memory&) {
    report(streams.error, "error",
           lack_of_room_for_scratch_memory() + ", or " + advice_on_memory(options.value_or(Options())));
    return error_of_user;
  } catch (const std::bad_alloc&) {
    report(streams.error, "error",
           "the memory of this computer is not enough; " + advice_on_memory(options.value_or(Options())));
    return error_of_user;
  } catch (const std::length_error& error) {
    report(streams.error, "error", error.what() + ("; " + advice_on_memory(options.value_or(Options()))));
    return error_of_user;
  } catch (const std::exception& error) {
    report(streams.error, "internal error", error.what());
    return defect;
  }
}

} // namespace equiaffine
