// SPDX-License-Identifier: GPL-3.0-or-later
// The module equiaffine._core: the commands of the program on arrays. Keyword arguments are parsed by the program's
// table of options, so that both accept the same values and compute the same results.
#include "arrays.h"
#include "attributes/estimates.h"
#include "cli/parse_options.h"
#include "commands/commands.h"
#include "commands/find_maps.h"
#include "commands/make_surface.h"
#include "observed.h"
#include "options.h"
#include "output/displays.h"
#include "output/maps.h"
#include "source/read_mesh.h"
#include "source/source_function.h"
#include "source/warnings.h"
#include "system/front_end.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>

#include <CGAL/tags.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace equiaffine::python {

namespace {

using Mesh = Annotated_mesh_3<Kernel>;

/// A fit that can be evaluated repeatedly, with its data.
struct Fit {
  Fit_traits traits;
  Indexed_triangle_mesh_3<Kernel> data;
};

/// Input of a source: a formula, samples, or a fit.
using Given = std::variant<std::string, Volume_array, std::shared_ptr<const Fit>>;

/// Parses the options of a command, and calls `compute(request, progress)` by observed().
template <class Compute>
auto run(Command command, const py::dict& keywords, const py::object& progress_function, const Compute& compute) {
  Request request = read_options(command_line_of(command, keywords));
  return observed(progress_function, request.threads, [&](Progress& progress) { return compute(request, progress); });
}

Source make_given_source(Source_options& options, const Given& given, Progress& progress, double radius) {
  if (const auto* fit = std::get_if<std::shared_ptr<const Fit>>(&given))
    return source_of_fit((*fit)->traits, (*fit)->data, options, radius);
  if (const auto* formula = std::get_if<std::string>(&given)) options.text = *formula;
  if (const auto* volume = std::get_if<Volume_array>(&given)) options.volume = [volume] { return volume->view(); };
  return make_source(options, progress, radius);
}

py::object mesh(const py::dict& keywords, const Given& given, const py::object& progress_function) {
  return run(MESH, keywords, progress_function, [&](Request& options, Progress& progress) {
    check_memory(options);
    if (std::holds_alternative<Volume_array>(given))
      options.source.estimates_errors = has_affine_curvatures(options.attributes, options.estimates);
    const Source source =
        make_given_source(options.source, given, progress, options.delaunay.radius.value_or(0));
    auto surface = std::make_shared<Annotated_surface>(surface_of(source, options, progress));
    add_errors(surface->estimates, surface->attributes);
    if (const auto& fit = surface->estimates.fit) surface->attributes.comments = comments_of(*fit);
    warn_of(*surface, source, options, progress);
    return [surface, spline = source.spline, scale = source.fit ? source.fit->scale() : std::nullopt] {
      py::dict result = arrays_of(std::move(surface->mesh), std::move(surface->attributes), scale), report;
      report["max_distance"] = surface->max_distance;
      if (spline) {
        report["noise"] = spline->noise.deviation;
        report["smoothing"] = spline->smoothing;
      }
      result["report"] = report;
      return result;
    };
  });
}

py::object annotate(const py::dict& keywords, Mesh data, const py::object& progress_function) {
  return run(ANNOTATE, keywords, progress_function, [&](Request& options, Progress& progress) {
    check_vertices(data.mesh.points, options.input);
    const auto areas = selected_vertex_areas(options.attributes, data.mesh.points, data.mesh.triangles);
    const auto structures = fit_vertices(data, options.source.fit, options.orientation);
    const Estimates estimates = estimates_of(structures);
    data.attributes = attributes_of_fit(structures, options.attributes, areas);
    add_estimates(estimates, options.estimates, data.attributes);
    add_errors(estimates, data.attributes);
    data.attributes.comments = comments_of(*estimates.fit);
    warn_of_opposed_normals(data, progress);
    warn_of_doubt(*estimates.fit, options.source.fit, has_affine_curvatures(options.attributes, options.estimates), true,
                  progress);
    return [&data, scale = estimates.fit->scale] {
      return arrays_of(std::move(data.mesh), std::move(data.attributes), scale);
    };
  });
}

py::object evaluate(const py::dict& keywords, const Given& given, const Mesh& at, const py::object& progress_function) {
  return run(EVALUATE, keywords, progress_function, [&](Request& options, Progress& progress) {
    if (at.mesh.triangles.empty()) refuse_attributes_of_mesh(options.attributes);
    const Source source = make_given_source(options.source, given, progress, 0);
    const auto& points = at.mesh.points;
    std::vector<double> values(points.size());
    std::visit(
        [&](const auto& f) {
          parallel_for<CGAL::Parallel_if_available_tag>(
              0, points.size(), [&](std::size_t i) { values[i] = f.value(points[i]); }, 256);
        },
        source.function);
    auto attributes = std::make_shared<Vertex_attributes>(evaluate_points(options, source, at.mesh, progress));
    attributes->columns.push_back({"value", std::move(values)});
    return [attributes] { return columns_of(std::move(*attributes)); };
  });
}

std::shared_ptr<Fit> fit(const py::dict& keywords, Mesh data, const py::object& progress_function) {
  return run(ANNOTATE, keywords, progress_function, [&](Request& options, Progress& progress) {
    check_vertices(data.mesh.points, options.input);
    const auto traits = blend_vertices(data, options.source.fit);
    if (traits.bbox() == CGAL::Bbox_3())
      throw Input_error("no point has enough neighbors to fit a polynomial; give more points or a larger scale");
    warn_of_opposed_normals(data, progress);
    return [fit = std::make_shared<Fit>(Fit{traits, std::move(data.mesh)})] { return fit; };
  });
}

/// Sets the data of a source of a register or symmetries command if they are in memory.
void give(Source_options& source, const std::optional<Mesh>& data) {
  if (data) source.data = [&data] { return *data; };
}

py::tuple register_(const py::dict& keywords, const std::optional<Mesh>& source, const py::dict& keywords_of_target,
                    const std::optional<Mesh>& target, const py::object& progress_function) {
  Request request = read_options(command_line_of(REGISTER, keywords), command_line_of(REGISTER, keywords_of_target));
  give(request.source, source);
  give(request.target, target);
  return observed(progress_function, request.threads, [&](Progress& progress) {
    return [report = report_of(request, find_map(request, progress))] {
      return py::make_tuple(to_JSON(report), summary(report));
    };
  });
}

py::tuple symmetries(const py::dict& keywords, const std::optional<Mesh>& surface,
                     const py::object& progress_function) {
  return run(SYMMETRIES, keywords, progress_function, [&](Request& options, Progress& progress) {
    give(options.source, surface);
    return [report = report_of(options, find_symmetries(options, progress))] {
      return py::make_tuple(to_JSON(report), summary(report));
    };
  });
}

py::object read_surface(const std::string& path) {
  return observed(py::none(), std::nullopt, [&](Progress&) {
    return [table = std::make_shared<Point_table_3<Kernel>>(read_vertices(path))] {
      return arrays_of(std::move(table->mesh), std::move(table->attributes), std::nullopt);
    };
  });
}

py::object read_samples(const std::string& path) {
  return observed(py::none(), std::nullopt, [&](Progress&) {
    return [volume = std::make_shared<Volume_3<Kernel>>(read_volume(path, Samples_in::MEMORY).to_volume())] {
      return arrays_of(std::move(*volume));
    };
  });
}

void write(const std::string& path, const Mesh& surface) {
  observed(py::none(), std::nullopt, [&](Progress&) {
    check_surface_output(path);
    Output_file file(path);
    write_surface(file, surface.mesh, surface.attributes);
    file.commit();
    return [] { return py::none(); };
  });
}

void write_samples(const std::string& path, const Volume_array& samples) {
  observed(py::none(), std::nullopt, [&](Progress&) {
    write_volume(path, samples.view().to_volume(), samples.is_float());
    return [] { return py::none(); };
  });
}

void show_surface(const py::dict& keywords, const Mesh& surface) {
  run(VIEW, keywords, py::none(), [&](Request& options, Progress&) {
    show(surface, "the surface", options);
    return [] { return py::none(); };
  });
}

} // namespace

PYBIND11_MODULE(_core, module) {
  using namespace py::literals;
  module.attr("version") = EQUIAFFINE_VERSION;
  front_end = Front_end::PYTHON;
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const Input_error& input_error) {
      const std::string& excerpt = input_error.excerpt();
      PyErr_SetString(PyExc_ValueError, (input_error.what() + (excerpt.empty() ? "" : "\n" + excerpt)).c_str());
    }
  });
  module.def("interpreter_ends", [] { is_interpreter_ending = true; });
  py::class_<Volume_array>(module, "Volume_array")
      .def(py::init<py::array, const py::array_t<double>&, const py::array_t<double>&>(), "samples"_a, "origin"_a,
           "steps"_a);
  py::class_<Mesh>(module, "Mesh")
      .def(py::init(&mesh_of), "points"_a, "faces"_a, "columns"_a, "status"_a, "comments"_a);
  py::class_<Fit, std::shared_ptr<Fit>>(module, "Fit").def_property_readonly("scale", [](const Fit& self) {
    return self.traits.scale();
  });
  module.def("mesh", &mesh, "options"_a, "given"_a, "progress"_a);
  module.def("annotate", &annotate, "options"_a, "data"_a, "progress"_a);
  module.def("evaluate", &evaluate, "options"_a, "given"_a, "points"_a, "progress"_a);
  module.def("fit", &fit, "options"_a, "data"_a, "progress"_a);
  module.def("register", &register_, "options"_a, "source"_a, "options_of_target"_a, "target"_a, "progress"_a);
  module.def("symmetries", &symmetries, "options"_a, "surface"_a, "progress"_a);
  module.def("read_surface", &read_surface, "path"_a);
  module.def("read_volume", &read_samples, "path"_a);
  module.def("write_surface", &write, "path"_a, "surface"_a);
  module.def("write_volume", &write_samples, "path"_a, "volume"_a);
  module.def("show", &show_surface, "options"_a, "surface"_a);
}

} // namespace equiaffine::python
