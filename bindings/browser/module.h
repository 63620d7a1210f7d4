// SPDX-License-Identifier: GPL-3.0-or-later
// The surface shared by the functions of the module, and error handling.
#ifndef EQUIAFFINE_BINDINGS_BROWSER_MODULE_H
#define EQUIAFFINE_BINDINGS_BROWSER_MODULE_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Simple_cartesian.h>

#include <chrono>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef __EMSCRIPTEN__
#include <emscripten.h>
#endif

#define EXPORTED extern "C" __attribute__((used, visibility("default")))

using Kernel = CGAL::Simple_cartesian<double>;

/// The result of the last call.
struct Surface {
  equiaffine::Isosurface_3<Kernel> mesh;
  equiaffine::Vertex_attributes attributes;
  std::vector<float> floats;       // for a page: positions relative to the center, then the columns
  std::vector<std::uint8_t> parts; // Parabolic_part of each vertex, or empty
  std::string facts;               // for a page, as JSON
};
inline Surface surface;
struct Failure {
  std::string message, excerpt, unknown_name;
};
inline Failure failure;

enum Outcome { DONE, MISTAKE, NO_MEMORY, FAILED };

/// Reports progress to JavaScript. Does nothing in native code, which the benchmark compiles.
inline void report([[maybe_unused]] const equiaffine::Progress_observer::Stage& stage) {
#ifdef __EMSCRIPTEN__
  EM_ASM(
      {
        if (Module.onProgress) Module.onProgress($0, $1, $2);
      },
      int(stage.number), int(stage.done), int(stage.total));
#endif
}

/// Calls `compute()`, reports its progress, and converts exceptions to an outcome and a message.
template <class Compute>
Outcome outcome_of(const Compute& compute) {
  const equiaffine::Progress_observer observer(report, std::chrono::milliseconds(200));
  failure = {};
  const auto fail = [](Outcome outcome, const std::string& message) {
    surface = {};
    failure.message = message;
    return outcome;
  };
  try {
    compute();
    return DONE;
  } catch (const equiaffine::Unknown_name_error& error) {
    failure = {{}, error.excerpt(), error.name()};
    return fail(MISTAKE, error.what());
  } catch (const equiaffine::Input_error& error) {
    failure = {{}, error.excerpt(), {}};
    return fail(MISTAKE, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(MISTAKE, error.what());
  } catch (const std::bad_alloc&) {
    return fail(NO_MEMORY, "not enough memory: choose a lower resolution, or use the program");
  } catch (const std::exception& error) {
    return fail(FAILED, error.what());
  }
}

#endif
