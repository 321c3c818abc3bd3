# SPDX-License-Identifier: Apache-2.0
# libzip: the target Zip::Zip. Its own package for CMake needs its programs, too.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
    pkg_check_modules(PC_Zip QUIET libzip)
endif()
find_path(Zip_INCLUDE_DIR zip.h HINTS ${PC_Zip_INCLUDE_DIRS})
find_library(Zip_LIBRARY NAMES zip HINTS ${PC_Zip_LIBRARY_DIRS})
if(Zip_INCLUDE_DIR AND EXISTS ${Zip_INCLUDE_DIR}/zipconf.h)
    set(zip_config ${Zip_INCLUDE_DIR}/zipconf.h)
else()
    find_file(zip_config zipconf.h HINTS ${PC_Zip_INCLUDE_DIRS} NO_CACHE)
endif()
if(zip_config)
    file(STRINGS ${zip_config} version_line REGEX "define LIBZIP_VERSION ")
    string(REGEX REPLACE ".*\"(.*)\".*" "\\1" Zip_VERSION "${version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Zip
    REQUIRED_VARS Zip_LIBRARY Zip_INCLUDE_DIR
    VERSION_VAR Zip_VERSION
    REASON_FAILURE_MESSAGE
    "FMUs are zip archives. Debian has it as libzip-dev, and scripts/setup installs it")
mark_as_advanced(Zip_INCLUDE_DIR Zip_LIBRARY)
if(Zip_FOUND AND NOT TARGET Zip::Zip)
    add_library(Zip::Zip UNKNOWN IMPORTED)
    set_target_properties(Zip::Zip PROPERTIES
        IMPORTED_LOCATION ${Zip_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Zip_INCLUDE_DIR})
endif()
