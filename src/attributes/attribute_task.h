// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_ATTRIBUTES_ATTRIBUTE_TASK_H
#define EQUIAFFINE_SRC_ATTRIBUTES_ATTRIBUTE_TASK_H

#include "source/source_function.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/Estimator.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <span>
#include <tuple>
#include <variant>
#include <vector>

namespace equiaffine {

/// The arguments of compute_attributes(). Attributes at a point are those of the level set through it, whatever the
/// value of f there.
template <class Traits>
struct Attribute_task {
  const Traits& function; ///< one of the models of Source_function
  Orientation_of_level_set orientation;
  std::span<const Kernel::Point_3> points;
  const Attribute_selection& selection;
  Estimator estimator = Estimator::COMPACT;
  std::span<const Point_status> sampled_status = {}; ///< empty, or one per point
};

template <class Traits>
using Attribute_function = Vertex_attributes (*)(const Attribute_task<Traits>&);

template <class Source>
struct Attribute_functions_of;

template <class... Traits>
struct Attribute_functions_of<std::variant<Traits...>> {
  using type = std::tuple<Attribute_function<Traits>...>;
};

/// The models of Source_function whose attributes are computed with vector instructions. Fits are not among them: their
/// linear algebra sums in another order for each instruction set.
using Vectorized_function = std::variant<Formula_traits, Spline_traits, Transformed_function_traits_3<Formula_traits>,
                                         Transformed_function_traits_3<Spline_traits>>;

/// compute_attributes of the library for each model of Vectorized_function, compiled for one instruction set.
using Attribute_functions = Attribute_functions_of<Vectorized_function>::type;

/// The vector instructions that can be used. All of them give the same results, bit for bit.
enum class Instruction_set { BASELINE, AVX2, AVX512 };

/// The instruction sets that this program was compiled for and this processor has, the narrowest first.
std::vector<Instruction_set> instruction_sets();

const Attribute_functions& attribute_functions(Instruction_set set);

Vertex_attributes compute_attributes_of_fit(const Attribute_task<Fit_traits>& task);
Vertex_attributes compute_attributes_of_fit(const Attribute_task<Transformed_function_traits_3<Fit_traits>>& task);

/// Does what compute_attributes of the library does, with all threads.
template <class Traits>
Vertex_attributes compute_attributes(const Attribute_task<Traits>& task,
                                     [[maybe_unused]] Instruction_set set = instruction_sets().back()) {
  if constexpr (is_fit<Traits>) return compute_attributes_of_fit(task);
  else return std::get<Attribute_function<Traits>>(attribute_functions(set))(task);
}

} // namespace equiaffine

#endif
