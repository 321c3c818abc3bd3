# SPDX-License-Identifier: Apache-2.0
# libsodium, which comes without a package for CMake: the target Sodium::Sodium.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
    pkg_check_modules(PC_Sodium QUIET libsodium)
endif()
find_path(Sodium_INCLUDE_DIR sodium.h HINTS ${PC_Sodium_INCLUDE_DIRS})
find_library(Sodium_LIBRARY NAMES sodium HINTS ${PC_Sodium_LIBRARY_DIRS})
if(Sodium_INCLUDE_DIR)
    file(STRINGS ${Sodium_INCLUDE_DIR}/sodium/version.h version_line REGEX "define SODIUM_VERSION_STRING")
    string(REGEX REPLACE ".*\"(.*)\".*" "\\1" Sodium_VERSION "${version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Sodium
    REQUIRED_VARS Sodium_LIBRARY Sodium_INCLUDE_DIR
    VERSION_VAR Sodium_VERSION
    REASON_FAILURE_MESSAGE
    "cyclic frames are sealed with it. Debian has it as libsodium-dev, and scripts/setup installs it")
mark_as_advanced(Sodium_INCLUDE_DIR Sodium_LIBRARY)
if(Sodium_FOUND AND NOT TARGET Sodium::Sodium)
    add_library(Sodium::Sodium UNKNOWN IMPORTED)
    set_target_properties(Sodium::Sodium PROPERTIES
        IMPORTED_LOCATION ${Sodium_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Sodium_INCLUDE_DIR})
endif()
