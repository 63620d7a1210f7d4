// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESHER_SILENT_WARNINGS_H
#define EQUIAFFINE_MESHER_SILENT_WARNINGS_H

#include <CGAL/assertions_behaviour.h>

namespace equiaffine::internal {

/// Silences CGAL's warnings during its lifetime: the mesher warns on the standard error stream of a triangulation that
/// does not meet the surface.
class Silent_warnings {
public:
  Silent_warnings()
      : handler_(CGAL::set_warning_handler([](const char*, const char*, const char*, int, const char*) {})) {}
  ~Silent_warnings() { CGAL::set_warning_handler(handler_); }
  Silent_warnings(const Silent_warnings&) = delete;
  Silent_warnings& operator=(const Silent_warnings&) = delete;

private:
  CGAL::Failure_function handler_;
};

} // namespace equiaffine::internal

#endif
