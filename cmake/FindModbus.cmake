# SPDX-License-Identifier: Apache-2.0
# libmodbus, which comes without a package for CMake: the target Modbus::Modbus.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
    pkg_check_modules(PC_Modbus QUIET libmodbus)
endif()
find_path(Modbus_INCLUDE_DIR modbus/modbus.h HINTS ${PC_Modbus_INCLUDE_DIRS})
find_library(Modbus_LIBRARY NAMES modbus HINTS ${PC_Modbus_LIBRARY_DIRS})
if(Modbus_INCLUDE_DIR)
    file(STRINGS ${Modbus_INCLUDE_DIR}/modbus/modbus-version.h version_line REGEX "define LIBMODBUS_VERSION_STRING")
    string(REGEX REPLACE ".*\"(.*)\".*" "\\1" Modbus_VERSION "${version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Modbus
    REQUIRED_VARS Modbus_LIBRARY Modbus_INCLUDE_DIR
    VERSION_VAR Modbus_VERSION)
mark_as_advanced(Modbus_INCLUDE_DIR Modbus_LIBRARY)
if(Modbus_FOUND AND NOT TARGET Modbus::Modbus)
    add_library(Modbus::Modbus UNKNOWN IMPORTED GLOBAL)
    set_target_properties(Modbus::Modbus PROPERTIES
        IMPORTED_LOCATION ${Modbus_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Modbus_INCLUDE_DIR})
endif()
