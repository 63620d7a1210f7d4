# SPDX-License-Identifier: GPL-3.0-or-later
# Configures SOURCE in BUILD and expects that nothing is installed of what is not built, but the headers if they are
# asked for alone.
set(prefix ${BUILD}/prefix)
file(REMOVE_RECURSE ${BUILD})

function(configure)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
                          -DBUILD_TESTING=OFF -DEQUIAFFINE_BUILD_PROGRAM=OFF ${ARGN}
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

configure()
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} RESULT_VARIABLE result OUTPUT_QUIET
                ERROR_VARIABLE error)
if(result EQUAL 0 OR EXISTS ${prefix} OR NOT error MATCHES "EQUIAFFINE_BUILD_LIBRARY=OFF")
  message(FATAL_ERROR "an unbuilt library: status ${result}, ${error}")
endif()

configure(-DEQUIAFFINE_BUILD_LIBRARY=OFF)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${BUILD}/use/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(use LANGUAGES CXX)
find_package(equiaffine 1.0 REQUIRED)
find_package(equiaffine 1.0 QUIET COMPONENTS library)
if(NOT TARGET equiaffine::headers OR equiaffine_FOUND)
  message(FATAL_ERROR \"the headers are there, and the library is not\")
endif()
")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${BUILD}/use -B ${BUILD}/use/build -G ${GENERATOR}
                        -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${prefix} OUTPUT_QUIET
                COMMAND_ERROR_IS_FATAL ANY)
