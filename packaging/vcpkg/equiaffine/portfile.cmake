# SPDX-License-Identifier: GPL-3.0-or-later
# An overlay port of the library (not tested), which builds this clone of the repository:
#   vcpkg install equiaffine --overlay-ports=packaging/vcpkg
vcpkg_check_linkage(ONLY_STATIC_LIBRARY)
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DEQUIAFFINE_BUILD_PROGRAM=OFF -DEQUIAFFINE_BUILD_REPRODUCE=OFF -DEQUIAFFINE_WITH_TBB=ON -DBUILD_TESTING=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME equiaffine CONFIG_PATH share/cmake/equiaffine)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
