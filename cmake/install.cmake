# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the library so that find_package(equiaffine) finds it.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Without this check, an installation could fail halfway, and leave an incomplete package that find_package accepts.
set(built_files)
if(EQUIAFFINE_BUILD_LIBRARY)
  list(APPEND built_files $<TARGET_FILE:equiaffine>)
endif()
if(EQUIAFFINE_BUILD_PROGRAM)
  list(APPEND built_files $<TARGET_FILE:equiaffine_executable>)
endif()
install(
  CODE "foreach(file IN ITEMS ${built_files})
  if(NOT EXISTS \"\${file}\")
    message(FATAL_ERROR \"\${file} is not built; run cmake --build first, or install only the headers with \"
                        \"-DEQUIAFFINE_BUILD_LIBRARY=OFF -DEQUIAFFINE_BUILD_PROGRAM=OFF\")
  endif()
endforeach()" COMPONENT development)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/equiaffine)
install(TARGETS equiaffine_headers EXPORT equiaffineTargets
        FILE_SET public COMPONENT development FILE_SET internal COMPONENT development)
install(EXPORT equiaffineTargets NAMESPACE equiaffine:: DESTINATION ${package_dir} COMPONENT development)

configure_package_config_file(cmake/equiaffineConfig.cmake.in equiaffineConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(equiaffineConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/equiaffineConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/equiaffineConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT development)

# For builds without CMake.
file(RELATIVE_PATH EQUIAFFINE_PREFIX_OF_PKGCONFIG /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" EQUIAFFINE_PREFIX_OF_PKGCONFIG "${EQUIAFFINE_PREFIX_OF_PKGCONFIG}")
if(EQUIAFFINE_WITH_TBB)
  set(EQUIAFFINE_TBB_FOR_PKGCONFIG ", tbb")
  set(EQUIAFFINE_LIBS_FOR_PKGCONFIG " -ltbbmalloc") # used by CGAL 6; it has no pkg-config file
  set(EQUIAFFINE_FLAGS_FOR_PKGCONFIG " -DCGAL_LINKED_WITH_TBB")
endif()
if(BUILD_SHARED_LIBS)
  string(APPEND EQUIAFFINE_FLAGS_FOR_PKGCONFIG " -DEQUIAFFINE_SHARED")
endif()
foreach(name IN ITEMS equiaffine-headers equiaffine)
  if(name STREQUAL equiaffine-headers OR EQUIAFFINE_BUILD_LIBRARY)
    configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
  endif()
endforeach()
