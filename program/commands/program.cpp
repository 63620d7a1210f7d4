// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/parse_options.h"
#include "commands/commands.h"
#include "request/Request.h"
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
/// Limits the number of threads during the lifetime of the result.
auto limit_threads(std::size_t threads) {
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}
#else
std::unique_ptr<int> limit_threads(std::size_t) { return nullptr; } // without TBB there is one thread
#endif

/// The folder of the output, or of temporary files for standard output.
std::filesystem::path folder_of_output(const Request& request) {
  if (request.output == "-") return std::filesystem::temp_directory_path();
  const auto folder = std::filesystem::path(request.output).parent_path();
  return folder.empty() ? "." : folder;
}

void run_command(const Request& request, const Streams& streams) {
  if (request.information) {
    streams.out << *request.information << std::flush;
    if (!streams.out)
      throw Input_error("cannot write standard output: it does not accept all data; check the receiving program or "
                        "device");
    return;
  }
  if (request.memory) limit_resident_memory(*request.memory, folder_of_output(request));
  const auto limit = request.threads ? limit_threads(*request.threads) : nullptr;
  Progress progress(streams.error, streams.error_is_terminal);
  switch (request.command) {
  case MESH: return run_mesh(request, streams.out, progress);
  case EVALUATE: return run_evaluate(request, streams.out, progress);
  case SAMPLE: return run_sample(request, streams.out, progress);
  case VIEW: return run_view(request, streams.out);
  case ANNOTATE: return run_annotate(request, streams.out, progress);
  case REGISTER: return run_register(request, streams.out, progress);
  case SYMMETRIES: return run_symmetries(request, streams.out, progress);
  }
}

/// What to do if a command needs too much memory.
std::string advice_on_memory(const std::optional<Request>& request) {
  if (!request) return "close other programs";
  switch (request->command) {
  case MESH: return "use a smaller --resolution, input or --size, or a larger --radius";
  case SAMPLE: return "use a smaller --resolution";
  case VIEW: return "use a smaller --size, or a mesh with fewer triangles";
  case ANNOTATE: return "use a smaller --size, or fewer vertices";
  default: return "use a smaller --resolution or input";
  }
}

/// Reports the text in one line, even if it has line breaks.
void report(std::ostream& stream, const std::string& kind, const std::string& text) {
  stream << "equiaffine: " << kind << ": " << printable(text) << '\n';
}

} // namespace

int run(const std::vector<std::string>& arguments, const Streams& streams) {
  constexpr int success = 0, defect = 1, error_of_user = 2;
  std::optional<Request> request;
  try {
    request = parse_options(arguments);
    run_command(*request, streams);
    streams.out.flush();
    return success;
  } catch (const Input_error& error) {
    report(streams.error, "error", error.what());
    if (!error.excerpt().empty()) streams.error << error.excerpt() << (error.excerpt().ends_with('\n') ? "" : "\n");
    return error_of_user;
  } catch (const No_room_for_scratch_memory&) {
    report(streams.error, "error",
           lack_of_room_for_scratch_memory() + ", or " + advice_on_memory(request));
    return error_of_user;
  } catch (const std::bad_alloc&) {
    report(streams.error, "error", "not enough memory; " + advice_on_memory(request));
    return error_of_user;
  } catch (const std::length_error& error) {
    report(streams.error, "error", error.what() + ("; " + advice_on_memory(request)));
    return error_of_user;
  } catch (const std::exception& error) {
    report(streams.error, "internal error", error.what());
    return defect;
  }
}

} // namespace equiaffine
