# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages. Run `cpack` in the build folder to make those whose components are built; scripts/packages builds and
# checks all of them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME equiaffine)
set(CPACK_PACKAGE_VENDOR "the authors of equiaffine")
set(EQUIAFFINE_PACKAGER "The equiaffine authors <equiaffine@packages.invalid>" CACHE STRING "Maintainer of the packages")
set(CPACK_PACKAGE_CONTACT ${EQUIAFFINE_PACKAGER})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Versions of packages contain the Debian release, such as 1.0.0-1~debian12, except for unstable, which sorts last.
cmake_host_system_information(RESULT system QUERY DISTRIB_INFO)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
if(system_VERSION_ID)
  string(APPEND CPACK_DEBIAN_PACKAGE_RELEASE ~${system_ID}${system_VERSION_ID})
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)

set(EQUIAFFINE_IN_SHORT "Equi-affine curvatures do not change under affine maps of determinant 1.
equiaffine meshes level sets of formulas, volumes, distances to meshes and fits
to scans, and computes their Euclidean and equi-affine curvatures.")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME equiaffine)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "curvatures of implicit surfaces, meshes and volumes, program\n${EQUIAFFINE_IN_SHORT}
.
This package contains the program.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libequiaffine-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The library contains code of the CGAL version with which it was compiled.
math(EXPR next_minor "${CGAL_MINOR_VERSION} + 1")
string(CONCAT CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libcgal-dev (>= ${CGAL_MAJOR_VERSION}.${CGAL_MINOR_VERSION}), libcgal-dev (<< ${CGAL_MAJOR_VERSION}.${next_minor}), "
    "libeigen3-dev (>= 3.4), libboost-dev, libtbb-dev, libgmp-dev, libmpfr-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "equiaffine-doc")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "curvatures of implicit surfaces, meshes and volumes, library\n${EQUIAFFINE_IN_SHORT}
.
This package contains the static C++ library, its headers, and files for CMake
and pkg-config.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-equiaffine)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "curvatures of implicit surfaces, meshes and volumes, Python module\n${EQUIAFFINE_IN_SHORT}
.
This package contains the Python module.")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME equiaffine-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "curvatures of implicit surfaces, meshes and volumes, manual\n${EQUIAFFINE_IN_SHORT}
.
This package contains the user manual and the reference of the C++ library in
HTML.")

set(CPACK_COMPONENTS_ALL development)
if(TARGET equiaffine_executable)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()
if(TARGET equiaffine_python)
  # Each minor version of Debian's Python needs modules compiled for it.
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/packaging/debian/python3/postinst
                                                ${CMAKE_CURRENT_SOURCE_DIR}/packaging/debian/python3/prerm)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(EQUIAFFINE_DOCUMENTATION "" CACHE PATH "Site built by scripts/documentation, for the package equiaffine-doc")
if(EQUIAFFINE_DOCUMENTATION)
  # Debian has a package of MathJax.
  set(html share/doc/equiaffine-doc/html)
  install(DIRECTORY ${EQUIAFFINE_DOCUMENTATION}/ DESTINATION ${html} COMPONENT documentation EXCLUDE_FROM_ALL
          PATTERN mathjax EXCLUDE)
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/links)
  file(CREATE_LINK ../../../javascript/mathjax ${CMAKE_CURRENT_BINARY_DIR}/links/mathjax SYMBOLIC)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/links/mathjax DESTINATION ${html} COMPONENT documentation EXCLUDE_FROM_ALL)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_DEPENDS libjs-mathjax)
  list(APPEND CPACK_COMPONENTS_ALL documentation)
endif()

# Each package contains its copyright, its changelog, and overrides of lintian warnings that do not apply.
find_program(EQUIAFFINE_GZIP gzip)
if(EQUIAFFINE_GZIP)
  set(debian ${CMAKE_CURRENT_BINARY_DIR}/debian)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # of SOURCE_DATE_EPOCH if it is set
  configure_file(packaging/debian/changelog.in ${debian}/changelog.Debian @ONLY)
  configure_file(CHANGELOG.md ${debian}/changelog COPYONLY)
  execute_process(COMMAND ${EQUIAFFINE_GZIP} -9 --no-name --force ${debian}/changelog.Debian ${debian}/changelog
                  COMMAND_ERROR_IS_FATAL ANY)
  foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER ${component} upper)
    set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
    install(FILES packaging/debian/copyright ${debian}/changelog.gz ${debian}/changelog.Debian.gz
            DESTINATION share/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/packaging/debian/${package}.lintian-overrides)
      install(FILES packaging/debian/${package}.lintian-overrides DESTINATION share/lintian/overrides RENAME ${package}
              COMPONENT ${component} EXCLUDE_FROM_ALL)
    endif()
  endforeach()
endif()
include(CPack)
