// SPDX-License-Identifier: GPL-3.0-or-later
// The module equiaffine._core: the commands of the program on arrays. Options come as words of its command line, so that
// both refuse the same and compute the same; equiaffine/__init__.py makes these words of keyword arguments.
#include "arrays.h"
#include "attributes/estimates.h"
#include "cli/parse_options.h"
#include "commands/evaluate_points.h"
#include "commands/find_map.h"
#include "commands/find_symmetries.h"
#include "commands/make_surface.h"
#include "observed.h"
#include "output/maps.h"
#include "output/surface_output.h"
#include "source/fit_vertices.h"
#include "source/read_vertices.h"
#include "source/warnings.h"
#include "volume/volume_io.h"
#include <equiaffine/Input_error.h>
#include <equiaffine/mesh_topology.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace equiaffine::python {

namespace {

using Words = std::vector<std::string>;

/// A fit that is used again and again, with the data it was made of.
struct Fit {
  Fit_traits traits;
  Indexed_triangle_mesh_3<Kernel> data;
};

/// What a source is made of, beside the words: nothing, a volume, or a fit.
using Given = std::variant<std::monostate, Volume_view, std::shared_ptr<const Fit>>;

/// The command in the words, which is of that type, and the number of threads that it may use.
template <class Command_options>
std::pair<Command_options, std::optional<std::size_t>> parsed(const Words& words) {
  Options options = parse_options(words);
  return {std::get<Command_options>(std::move(options.command)), options.threads};
}

Source make_given_source(Source_options& options, const Given& given, Progress& progress, double radius) {
  if (const auto* volume = std::get_if<Volume_view>(&given)) options.volume = [volume] { return volume->volume(); };
  if (const auto* fit = std::get_if<std::shared_ptr<const Fit>>(&given))
    return source_of_fit((*fit)->traits, (*fit)->data, options, radius);
  return make_source(options, progress, radius);
}

py::object mesh(const Words& words, const Given& given, const py::object& progress_function) {
  auto [options, threads] = parsed<Mesh_options>(words);
  return observed(progress_function, threads, [&, &options = options](Progress& progress) {
    const auto* const delaunay = std::get_if<Delaunay_options>(&options.method);
    const Source source = make_given_source(options.source, given, progress, delaunay ? delaunay->radius : 0);
    Annotated_surface surface = surface_of(source, options, progress);
    add_errors(surface.estimates, surface.attributes);
    if (surface.close_sheets) warn_of_close_sheets(*surface.close_sheets, progress);
    return [surface = std::make_shared<Annotated_surface>(std::move(surface))] {
      return arrays_of(std::move(surface->mesh), std::move(surface->attributes));
    };
  });
}

py::object annotate(const Words& words, const Points_view& points, const py::object& progress_function) {
  auto [options, threads] = parsed<Annotate_options>(words);
  return observed(progress_function, threads, [&, &options = options](Progress& progress) {
    Annotated_mesh_3<Kernel> data = points.mesh();
    check_vertices(data.mesh.points, options.mesh);
    const auto structures = fit_vertices(data, options.fit, options.orientation);
    const Estimates estimates = estimates_of(structures);
    auto attributes = std::make_shared<Vertex_attributes>(attributes_of(structures, options.attributes));
    add_estimates(estimates, options.estimates, *attributes);
    add_errors(estimates, *attributes);
    warn_of_opposed_normals(data, progress);
    warn_of_doubt(*estimates.fit, options.fit, has_affine_curvatures(options.attributes, options.estimates), progress);
    return [mesh = std::make_shared<Indexed_triangle_mesh_3<Kernel>>(std::move(data.mesh)), attributes,
            scale = estimates.fit->scale] {
      py::dict result = arrays_of(std::move(*mesh), std::move(*attributes));
      result["scale"] = scale;
      return result;
    };
  });
}

py::object evaluate(const Words& words, const Given& given, const Points_view& at,
                    const py::object& progress_function) {
  auto [options, threads] = parsed<Evaluate_options>(words);
  return observed(progress_function, threads, [&, &options = options](Progress& progress) {
    const Source source = make_given_source(options.source, given, progress, 0);
    auto points = at.mesh().mesh.points;
    auto values = std::make_shared<std::vector<double>>(points.size());
    std::visit(
        [&](const auto& f) {
          for (std::size_t i = 0; i < points.size(); ++i) (*values)[i] = f.value(points[i]);
        },
        source.function);
    auto attributes = std::make_shared<Vertex_attributes>(evaluate_points(options, source, points, progress));
    return [attributes, values] {
      py::dict result = columns_of(std::move(*attributes));
      py::dict columns = result["columns"];
      columns["value"] = array_of(std::move(*values));
      return result;
    };
  });
}

std::shared_ptr<Fit> fit(const Words& words, const Points_view& points, const py::object& progress_function) {
  auto [options, threads] = parsed<Annotate_options>(words);
  return observed(progress_function, threads, [&, &options = options](Progress& progress) {
    Annotated_mesh_3<Kernel> data = points.mesh();
    check_vertices(data.mesh.points, options.mesh);
    const auto traits = blend_vertices(data, options.fit);
    if (traits.bbox() == CGAL::Bbox_3())
      throw Input_error("cannot fit '" + options.mesh +
                        "': no point has enough others around it for a polynomial; give "
                        "more points or a larger scale");
    warn_of_opposed_normals(data, progress);
    return [fit = std::make_shared<Fit>(Fit{traits, std::move(data.mesh)})] { return fit; };
  });
}

/// Gives a surface of a register or symmetries command its data, if they are in memory.
void give(Surface_options& surface, const std::optional<Points_view>& points) {
  if (points) surface.source.data = [&points] { return points->mesh(); };
}

py::tuple register_(const Words& words, const std::optional<Points_view>& source,
                    const std::optional<Points_view>& target, const py::object& progress_function) {
  auto [options, threads] = parsed<Register_options>(words);
  give(options.source, source);
  give(options.target, target);
  return observed(progress_function, threads, [&, &options = options](Progress& progress) {
    return [report = report_of(options, find_map(options, progress))] {
      return py::make_tuple(to_JSON(report), summary(report));
    };
  });
}

py::tuple symmetries(const Words& words, const std::optional<Points_view>& surface,
                     const py::object& progress_function) {
  auto [options, threads] = parsed<Symmetries_options>(words);
  give(options.surface, surface);
  return observed(progress_function, threads, [&, &options = options](Progress& progress) {
    return [report = report_of(options, find_symmetries(options, progress))] {
      return py::make_tuple(to_JSON(report), summary(report));
    };
  });
}

py::object read_surface(const std::string& path) {
  return observed(py::none(), std::nullopt, [&](Progress&) {
    return [table = std::make_shared<Point_table_3<Kernel>>(read_vertices(path))] {
      return arrays_of(std::move(table->mesh), std::move(table->attributes));
    };
  });
}

py::object read_samples(const std::string& path) {
  return observed(py::none(), std::nullopt, [&](Progress&) {
    return [volume = std::make_shared<Volume_3<Kernel>>(read_volume(path))] { return arrays_of(std::move(*volume)); };
  });
}

void write(const std::string& path, const Points_view& points) {
  observed(py::none(), std::nullopt, [&](Progress&) {
    const Annotated_mesh_3<Kernel> surface = points.mesh();
    check_surface_output(path);
    Output_file file(path);
    write_surface(file, surface.mesh, surface.attributes);
    file.commit();
    return [] { return py::none(); };
  });
}

void write_samples(const std::string& path, const Volume_view& view) {
  observed(py::none(), std::nullopt, [&](Progress&) {
    write_volume(path, view.volume(), view.is_float());
    return [] { return py::none(); };
  });
}

void show(const Words& words, const std::string& title, const Points_view& points) {
  auto [options, threads] = parsed<View_options>(words);
  observed(py::none(), threads, [&, &options = options](Progress&) {
    const Annotated_mesh_3<Kernel> surface = points.mesh();
    check_display_outputs(options.display);
    Outputs outputs;
    outputs.add_displays(options.display);
    write_displays(outputs, surface.mesh, surface.attributes, options.display,
                   {title,
                    {{"Vertices", std::to_string(surface.mesh.points.size())},
                     {"Triangles", std::to_string(surface.mesh.triangles.size())}}});
    outputs.commit();
    return [] { return py::none(); };
  });
}

} // namespace

PYBIND11_MODULE(_core, module) {
  using namespace py::literals;
  module.attr("version") = EQUIAFFINE_VERSION;
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const Input_error& input_error) {
      const std::string& excerpt = input_error.excerpt();
      PyErr_SetString(PyExc_ValueError, (input_error.what() + (excerpt.empty() ? "" : "\n" + excerpt)).c_str());
    }
  });
  py::class_<Volume_view>(module, "Volume_view").def(py::init<py::array, py::array_t<double>, py::array_t<double>>());
  py::class_<Points_view>(module, "Points_view")
      .def(py::init<Points_array, Faces_array, py::dict, std::optional<Status_array>>());
  py::class_<Fit, std::shared_ptr<Fit>>(module, "Fit")
      .def_property_readonly("scale", [](const Fit& self) { return self.traits.scale(); })
      .def_property_readonly("box", [](const Fit& self) {
        const CGAL::Bbox_3 box = self.traits.bbox();
        return std::array{box.xmin(), box.xmax(), box.ymin(), box.ymax(), box.zmin(), box.zmax()};
      });
  module.def("mesh", &mesh, "words"_a, "given"_a, "progress"_a);
  module.def("annotate", &annotate, "words"_a, "points"_a, "progress"_a);
  module.def("evaluate", &evaluate, "words"_a, "given"_a, "points"_a, "progress"_a);
  module.def("fit", &fit, "words"_a, "points"_a, "progress"_a);
  module.def("register", &register_, "words"_a, "source"_a, "target"_a, "progress"_a);
  module.def("symmetries", &symmetries, "words"_a, "surface"_a, "progress"_a);
  module.def("read_surface", &read_surface, "path"_a);
  module.def("read_volume", &read_samples, "path"_a);
  module.def("write_surface", &write, "path"_a, "points"_a);
  module.def("write_volume", &write_samples, "path"_a, "volume"_a);
  module.def("show", &show, "words"_a, "title"_a, "points"_a);
}

} // namespace equiaffine::python
