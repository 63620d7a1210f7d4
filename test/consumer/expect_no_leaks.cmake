# SPDX-License-Identifier: GPL-3.0-or-later
# Expects that BUILD, a project with equiaffine as a subdirectory, built and installs only what is its own.
file(GLOB_RECURSE libraries ${BUILD}/*libequiaffine.*)
if(libraries)
  message(FATAL_ERROR "nothing links to the library, and yet it was built: ${libraries}")
endif()
file(REMOVE_RECURSE ${BUILD}/prefix)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${BUILD}/prefix COMMAND_ERROR_IS_FATAL ANY)
if(EXISTS ${BUILD}/prefix)
  message(FATAL_ERROR "the rules of equiaffine install into the prefix of a project that contains it")
endif()
