// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_SILENT_MESSAGES_H
#define EQUIAFFINE_SRC_DELAUNAY_SILENT_MESSAGES_H

#include <CGAL/assertions_behaviour.h>

namespace equiaffine::internal {

/// Silences CGAL's messages during its lifetime: on the standard error stream the mesher warns of a triangulation that
/// does not meet the surface, and with some compilers it says there what it throws.
class Silent_messages {
public:
  Silent_messages()
      : warning_handler_(CGAL::set_warning_handler(ignore)), error_handler_(CGAL::set_error_handler(ignore)) {}
  ~Silent_messages() {
    CGAL::set_warning_handler(warning_handler_);
    CGAL::set_error_handler(error_handler_);
  }
  Silent_messages(const Silent_messages&) = delete;
  Silent_messages& operator=(const Silent_messages&) = delete;

private:
  static void ignore(const char*, const char*, const char*, int, const char*) {}

  CGAL::Failure_function warning_handler_, error_handler_;
};

} // namespace equiaffine::internal

#endif
