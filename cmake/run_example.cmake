# SPDX-License-Identifier: GPL-3.0-or-later
# Runs PROGRAM, with the NAME of an example that it may have among others, and fails unless it succeeds and prints what the
# file EXPECTED holds.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${PROGRAM} ${NAME} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
file(READ ${EXPECTED} expected)
if(NOT printed STREQUAL expected)
  message("printed:\n${printed}\nexpected:\n${expected}")
  message(FATAL_ERROR "The output differs from ${EXPECTED}")
endif()
