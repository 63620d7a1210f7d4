# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a private header of the library that contains the files of viewer/ as strings, for single-file pages. The lines
# of a file up to its first blank line are left out.

set(EQUIAFFINE_GENERATED_DIR ${PROJECT_BINARY_DIR}/generated)

function(read_viewer_file variable name)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS viewer/${name})
  file(READ ${PROJECT_SOURCE_DIR}/viewer/${name} text)
  string(FIND "${text}" "\n\n" head)
  if(head EQUAL -1)
    message(FATAL_ERROR "viewer/${name} does not have a blank line after its header comment; add one")
  endif()
  math(EXPR begin "${head} + 2")
  string(SUBSTRING "${text}" ${begin} -1 text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# The parts of the script are separate strings, since compilers need not accept strings longer than 64 KB.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS viewer/parts.txt)
file(READ ${PROJECT_SOURCE_DIR}/viewer/parts.txt parts)
string(REGEX MATCHALL "[a-z]+" parts "${parts}")
set(script "")
foreach(part IN LISTS parts)
  read_viewer_file(text ${part}.js)
  string(REGEX MATCHALL "@[a-z.]+\\.glsl@" programs "${text}")
  foreach(program IN LISTS programs)
    string(REPLACE "@" "" name ${program})
    read_viewer_file(program_text ${name})
    string(REGEX REPLACE "\n$" "" program_text "${program_text}")
    string(REPLACE "${program}" "${program_text}" text "${text}")
  endforeach()
  string(APPEND script "\n    R\"viewer(\n${text})viewer\",")
endforeach()

read_viewer_file(style page.css)
read_viewer_file(stage stage.html)
read_viewer_file(controls controls.html)
set(header "// Generated from the files of viewer/ by cmake/embed_viewer.cmake.
#ifndef EQUIAFFINE_SRC_DISPLAY_VIEWER_FILES_H
#define EQUIAFFINE_SRC_DISPLAY_VIEWER_FILES_H

#include <string_view>

namespace equiaffine::internal {
")
foreach(part IN ITEMS style stage controls)
  string(APPEND header "\ninline constexpr std::string_view viewer_${part} = R\"viewer(\n${${part}})viewer\";\n")
endforeach()
string(APPEND header "
inline constexpr std::string_view viewer_script[] = {${script}
};

} // namespace equiaffine::internal

#endif
")
set(viewer_files ${EQUIAFFINE_GENERATED_DIR}/display/viewer_files.h)
file(CONFIGURE OUTPUT ${viewer_files} CONTENT "@header@" @ONLY)
