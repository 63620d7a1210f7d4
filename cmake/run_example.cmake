# SPDX-License-Identifier: GPL-3.0-or-later
# Runs PROGRAM with the argument NAME, the name of an example. Fails unless the program succeeds and prints the content
# of the file EXPECTED.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${PROGRAM} ${NAME} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
file(READ ${EXPECTED} expected)
if(NOT printed STREQUAL expected)
  message("printed:\n${printed}\nexpected:\n${expected}")
  message(FATAL_ERROR "The output differs from ${EXPECTED}; correct the example or update this file")
endif()
