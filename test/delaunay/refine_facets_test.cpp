// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/Surface_complex.h"
#include "support/Scratch_file.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace refine_facets_test {

// CGAL's mesher calls this function before it throws.
TEST(Refine_facets, a_triangulation_is_not_written_to_files) {
  const equiaffine::test::Scratch_file scratch("dump-bug");
  const std::filesystem::path prefix = scratch.write("");
  CGAL::dump_c3t3(equiaffine::internal::Surface_complex(), prefix.string());
  for (const auto& file : std::filesystem::directory_iterator(prefix.parent_path())) EXPECT_EQ(file.path(), prefix);
}

} // namespace refine_facets_test
