# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the library so that find_package(equiaffine) finds it.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Without this check an installation would fail half way and leave a prefix that find_package takes for a package.
set(built_files)
if(EQUIAFFINE_BUILD_MESHER)
  list(APPEND built_files $<TARGET_FILE:equiaffine_mesher>)
endif()
if(EQUIAFFINE_BUILD_PROGRAM)
  list(APPEND built_files $<TARGET_FILE:equiaffine_executable>)
endif()
install(
  CODE "foreach(file IN ITEMS ${built_files})
  if(NOT EXISTS \"\${file}\")
    message(FATAL_ERROR \"\${file} is not built: run cmake --build first, or install the headers alone with \"
                        \"-DEQUIAFFINE_BUILD_MESHER=OFF -DEQUIAFFINE_BUILD_PROGRAM=OFF\")
  endif()
endforeach()")

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/equiaffine)
install(TARGETS equiaffine EXPORT equiaffineTargets
        FILE_SET porch FILE_SET doors FILE_SET shared FILE_SET internal FILE_SET generated)
install(EXPORT equiaffineTargets NAMESPACE equiaffine:: DESTINATION ${package_dir})

configure_package_config_file(cmake/equiaffineConfig.cmake.in equiaffineConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(equiaffineConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/equiaffineConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/equiaffineConfigVersion.cmake
        DESTINATION ${package_dir})
