// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/Option_row.h"

namespace equiaffine {

namespace {

using enum Option_group;

void read_kind(const Option_words& option, Draft& draft) {
  draft.maps.kind = parse_choice<Map_kind>(option, {{"affine", Map_kind::AFFINE},
                                                    {"equiaffine", Map_kind::EQUIAFFINE},
                                                    {"similarity", Map_kind::SIMILARITY},
                                                    {"rigid", Map_kind::RIGID}});
}

void read_no_reflection(const Option_words& option, Draft& draft) {
  draft.maps.allows_reflections = parse_choice<bool>(option, {{"true", false}, {"false", true}});
}

void read_least_overlap(const Option_words& option, Draft& draft) {
  draft.least_overlap = parse_number(option);
  if (!(draft.least_overlap >= 0 && draft.least_overlap <= 1))
    fail_option(option.name, "'" + option.word() + "' is not a part of a surface",
                "give a number from 0 to 1, such as 0.05");
}

void read_tolerance(const Option_words& option, Draft& draft) {
  draft.tolerance = parse_number(option);
  if (!(*draft.tolerance > 0 && *draft.tolerance < 0.1))
    fail_option(option.name, "'" + option.word() + "' is not between 0 and 0.1",
                "give a part of the size of the surface, such as 1e-3, or leave it out");
}

const std::vector<Option_row> rows_of_maps = {
    {"--kind", registering, MAPS, 1, "affine|equiaffine|similarity|rigid",
     "the maps that are sought: all (affine, the default), those that keep volumes,\n"
     "those that keep angles, or those that keep lengths",
     read_kind},
    {"--no-reflection", registering, MAPS, 0, "", "no map that turns left into right", read_no_reflection},
    {"--all", REGISTER, MAPS, 1, "N", "all maps with evidence, up to N, as those of a symmetric target or of copies",
     [](const Option_words& option, Draft& draft) {
       draft.number_of_maps = parse_count(option.name, option.word(), 1);
     }},
    {"--min-overlap", REGISTER, MAPS, 1, "PART",
     "the part of one of the surfaces, at least, that is to lie on the other, by default 0.05", read_least_overlap},
    {"--tolerance", registering, MAPS, 1, "PART",
     "the largest rms distance to which a map may move points from the other surface, a part of\n"
     "the size; by default what noise and facets explain. A symmetry of a formula moves them by\n"
     "1e-8, and a mesh has the first group of symmetries within 0.01",
     read_tolerance},
    {"--complete", SYMMETRIES, MAPS, 0, "",
     "search all rotations and reflections, as for a mesh, where a formula's frames of\n"
     "curvature decide by themselves",
     [](const Option_words& option, Draft& draft) {
       draft.is_complete = parse_choice<bool>(option, {{"true", true}, {"false", false}});
     }},
};

} // namespace

std::span<const Option_row> map_options() { return rows_of_maps; }

} // namespace equiaffine
