# SPDX-License-Identifier: Apache-2.0
# Qwt 6.1 for Qt 5, which comes without a package for CMake: the target Qwt::Qwt.
find_path(Qwt_INCLUDE_DIR qwt_global.h PATH_SUFFIXES qwt qwt-qt5 qt5/qwt)
find_library(Qwt_LIBRARY NAMES qwt-qt5 qwt)
if(Qwt_INCLUDE_DIR)
    file(STRINGS ${Qwt_INCLUDE_DIR}/qwt_global.h version_line REGEX "define QWT_VERSION_STR")
    string(REGEX REPLACE ".*\"(.*)\".*" "\\1" Qwt_VERSION "${version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Qwt REQUIRED_VARS Qwt_LIBRARY Qwt_INCLUDE_DIR VERSION_VAR Qwt_VERSION)
mark_as_advanced(Qwt_INCLUDE_DIR Qwt_LIBRARY)
if(Qwt_FOUND AND NOT TARGET Qwt::Qwt)
    add_library(Qwt::Qwt UNKNOWN IMPORTED)
    set_target_properties(Qwt::Qwt PROPERTIES IMPORTED_LOCATION ${Qwt_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${Qwt_INCLUDE_DIR})
    # Its headers use what Qt 5.15 deprecates, a zero as flags.
    set_target_properties(Qwt::Qwt PROPERTIES INTERFACE_COMPILE_OPTIONS
        "-UQT_DISABLE_DEPRECATED_BEFORE;-DQT_DISABLE_DEPRECATED_BEFORE=0x050E00")
endif()
