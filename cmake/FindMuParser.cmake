# SPDX-License-Identifier: Apache-2.0
# muParser 2.3: the target MuParser::MuParser.
find_path(MuParser_INCLUDE_DIR muParser.h)
find_library(MuParser_LIBRARY NAMES muparser)
if(MuParser_INCLUDE_DIR)
    file(STRINGS ${MuParser_INCLUDE_DIR}/muParserDef.h version_line REGEX "ParserVersion ?=")
    string(REGEX REPLACE ".*\"([0-9.]+).*" "\\1" MuParser_VERSION "${version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MuParser
    REQUIRED_VARS MuParser_LIBRARY MuParser_INCLUDE_DIR
    VERSION_VAR MuParser_VERSION
    REASON_FAILURE_MESSAGE
    "the Control Center calculates formulas with it. Debian has it as libmuparser-dev, and \
scripts/setup installs it. Without the window: -DQTPLC_BUILD_GUI=OFF")
mark_as_advanced(MuParser_INCLUDE_DIR MuParser_LIBRARY)
if(MuParser_FOUND AND NOT TARGET MuParser::MuParser)
    add_library(MuParser::MuParser UNKNOWN IMPORTED)
    set_target_properties(MuParser::MuParser PROPERTIES
        IMPORTED_LOCATION ${MuParser_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${MuParser_INCLUDE_DIR})
endif()
