# SPDX-License-Identifier: Apache-2.0
# A node, or the master of a plant, for the programs of others: qtplc_add_fmu(), qtplc_add_discon(),
# qtplc_add_master_fmu() and qtplc_add_master_discon(). find_package(QtPlc COMPONENTS Export) offers
# them.
#
#   qtplc_add_fmu(NAME NODE class HEADER file SIGNALS file PERIOD time
#       [SOURCES file ...] [LIBRARIES target ...] [VERSIONS 2 3] [DESCRIPTION text] [FOLDER folder])
#
# makes FOLDER/NAME.fmu (FMI 2.0) and FOLDER/NAME_fmi3.fmu (FMI 3.0), for co-simulation, by the
# target NAME_fmu. FOLDER is ${CMAKE_BINARY_DIR}/fmu by default.
#
#   qtplc_add_discon(NAME NODE class HEADER file SIGNALS file [PERIOD time]
#       [SOURCES file ...] [LIBRARIES target ...] [FOLDER folder])
#
# makes FOLDER/libNAME.so with the function DISCON of Bladed and OpenFAST, by the target
# NAME_discon. FOLDER is ${CMAKE_BINARY_DIR}/discon by default. Without PERIOD the host gives it.
#
#   qtplc_add_master_fmu(NAME CONFIGURATION file SIGNALS file PERIOD time
#       [VERSIONS 2 3] [DESCRIPTION text] [FOLDER folder])
#   qtplc_add_master_discon(NAME CONFIGURATION file SIGNALS file [PERIOD time] [FOLDER folder])
#
# make the same files with a master in them: the host turns the clock of a plant whose nodes are on
# the network. CONFIGURATION says which nodes these are, where the master listens, and which signals
# the host writes and reads (docs/howto/master-in-a-host.md).
#
# NODE is a class with a default constructor, which HEADER declares. PERIOD is a number with a unit:
# 10ms, 500us. The libraries contain QtPLC and export nothing but the functions of their interface.
# Static LIBRARIES have to be compiled with POSITION_INDEPENDENT_CODE.
set(QTPLC_EXPORT_SOURCES ${CMAKE_CURRENT_LIST_DIR}/export)
if(NOT EXISTS ${QTPLC_EXPORT_SOURCES})
    set(QTPLC_EXPORT_SOURCES ${CMAKE_CURRENT_LIST_DIR}/../src/export) # of QtPLC itself
endif()

# Reads the arguments that all functions have, and writes down what the library is.
macro(qtplc_prepare_export function name)
    cmake_parse_arguments(arg "" "NODE;HEADER;CONFIGURATION;SIGNALS;PERIOD;DESCRIPTION;FOLDER"
        "SOURCES;LIBRARIES;VERSIONS" ${ARGN})
    if(NOT "${name}" MATCHES "^[A-Za-z_][A-Za-z0-9_]*$")
        message(FATAL_ERROR "${function}(${name}): use a name of letters, digits and underscores, as in C")
    endif()
    set(needed NODE HEADER SIGNALS)
    if("${function}" MATCHES "_master_")
        set(needed CONFIGURATION SIGNALS)
        if(arg_NODE OR arg_HEADER OR arg_SOURCES OR arg_LIBRARIES)
            message(FATAL_ERROR "${function}(${name}): the nodes of the plant are programs of their own; leave out "
                "NODE, HEADER, SOURCES and LIBRARIES")
        endif()
    endif()
    foreach(argument IN LISTS needed)
        if(NOT arg_${argument})
            message(FATAL_ERROR "${function}(${name}): ${argument} is missing")
        endif()
    endforeach()
    if(arg_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "${function}(${name}): unknown argument '${arg_UNPARSED_ARGUMENTS}'")
    endif()
    if(arg_PERIOD AND NOT arg_PERIOD MATCHES "^[0-9]+([.][0-9]+)?(ns|us|ms|s)$")
        message(FATAL_ERROR "${function}(${name}): PERIOD is '${arg_PERIOD}'; use a number with a unit, as in 10ms")
    endif()
    get_filename_component(signals ${arg_SIGNALS} ABSOLUTE)
    if(NOT EXISTS ${signals})
        message(FATAL_ERROR "${function}(${name}): the signal table ${signals} does not exist")
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${signals})
    file(READ ${signals} table)
    set(configuration)
    if(arg_CONFIGURATION)
        get_filename_component(configuration_file ${arg_CONFIGURATION} ABSOLUTE)
        if(NOT EXISTS ${configuration_file})
            message(FATAL_ERROR "${function}(${name}): the configuration ${configuration_file} does not exist")
        endif()
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${configuration_file})
        file(READ ${configuration_file} configuration)
        set(configuration "R\"QtPLC(${configuration})QtPLC\"")
        set(arg_NODE qplc_export::HeldPlantNode)
        set(arg_HEADER HeldPlantNode.h)
        list(APPEND arg_SOURCES ${QTPLC_EXPORT_SOURCES}/HeldPlantConfiguration.cpp
            ${QTPLC_EXPORT_SOURCES}/HeldPlantNode.cpp)
    endif()
    set(period 0)
    if(arg_PERIOD)
        set(period "std::chrono::round<std::chrono::nanoseconds>(${arg_PERIOD}).count()")
    endif()
    set(work ${CMAKE_CURRENT_BINARY_DIR}/${function}/${name})
    file(CONFIGURE OUTPUT ${work}/identity.cpp @ONLY CONTENT [[
// Made by QtPlcExport.cmake.
#include "@arg_HEADER@"

#include "ExportedNode.h"

namespace qplc_export {

using namespace std::chrono_literals;

static_assert(@period@ == 0 || (@period@ >= 10'000 && @period@ <= 10'000'000'000),
              "PERIOD is out of range; use 10us to 10s");

const Identity identity{"@name@", R"QtPLC(@arg_DESCRIPTION@)QtPLC", R"QtPLC(@table@)QtPLC", @period@,
                        []() -> std::unique_ptr<QPlcSlaveNode> {
                            return std::make_unique<@arg_NODE@>(@configuration@);
                        }};

}  // namespace qplc_export
]])
endmacro()

# The sources of \a target, and QtPLC inside of it. What a static library of the user links publicly
# must not bring a second QtPLC: all of the archive comes first, and the linker leaves out a shared
# library that it needs no more.
function(qtplc_complete_export target libraries)
    target_compile_features(${target} PRIVATE cxx_std_17)
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${QTPLC_EXPORT_SOURCES})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
        VISIBILITY_INLINES_HIDDEN ON QTPLC_INSIDE ON UNITY_BUILD OFF)
    target_link_options(${target} PRIVATE LINKER:--as-needed)
    if(TARGET QtPlc::CoreInside)
        if(libraries)
            target_link_options(${target} PRIVATE
                LINKER:--whole-archive,$<TARGET_FILE:QtPlc::CoreInside>,--no-whole-archive)
        endif()
        target_link_libraries(${target} PRIVATE QtPlc::CoreInside)
    endif()
    target_link_libraries(${target} PRIVATE ${libraries})
    if(NOT TARGET QtPlc::CoreInside)
        target_link_libraries(${target} PRIVATE QtPlc::Core)
    endif()
endfunction()

# The library that a host loads. It stays loaded until the end of the host: Qt remembers its types.
function(qtplc_add_export_library target functions)
    add_library(${target} MODULE ${ARGN})
    set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}.map)
    file(CONFIGURE OUTPUT ${script} CONTENT "{ global: ${functions} local: *; };\n" @ONLY)
    target_link_options(${target} PRIVATE LINKER:--version-script=${script} LINKER:-z,nodelete
        $<$<CONFIG:Release>:LINKER:-s>)
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${script})
endfunction()

# qtplc_pack_fmu(version file library program): the file of one version.
function(qtplc_pack_fmu version file library program)
    set(platform ${CMAKE_SYSTEM_PROCESSOR}-linux)
    if(version EQUAL 2 AND CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
        set(platform linux64)
    endif()
    get_filename_component(folder ${file} DIRECTORY)
    add_custom_command(OUTPUT ${file}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
        COMMAND ${program} ${version} ${platform} $<TARGET_FILE:${library}> ${file}
        DEPENDS ${library} ${program}
        COMMENT "Making ${file}"
        VERBATIM)
endfunction()

function(qtplc_make_fmu function name)
    qtplc_prepare_export(${function} ${name} ${ARGN})
    if(NOT arg_PERIOD)
        message(FATAL_ERROR "${function}(${name}): PERIOD is missing")
    endif()
    if(NOT arg_VERSIONS)
        set(arg_VERSIONS 2 3)
    endif()
    if(NOT arg_FOLDER)
        set(arg_FOLDER ${CMAKE_BINARY_DIR}/fmu)
    endif()
    set(objects ${name}_fmu_objects)
    set(library ${name}_fmu_library)
    set(program ${name}_fmu_packer)
    list(TRANSFORM arg_SOURCES REPLACE "^([^/].*)" "${CMAKE_CURRENT_SOURCE_DIR}/\\1")
    add_library(${objects} OBJECT ${work}/identity.cpp ${arg_SOURCES}
        ${QTPLC_EXPORT_SOURCES}/ExportedNode.cpp ${QTPLC_EXPORT_SOURCES}/FmuDescription.cpp
        ${QTPLC_EXPORT_SOURCES}/FmuVariables.cpp ${QTPLC_EXPORT_SOURCES}/IniText.cpp)
    qtplc_complete_export(${objects} "${arg_LIBRARIES}")
    qtplc_add_export_library(${library} "fmi2*; fmi3*;" $<TARGET_OBJECTS:${objects}>
        ${QTPLC_EXPORT_SOURCES}/FmuInstance.cpp ${QTPLC_EXPORT_SOURCES}/Fmi2.cpp ${QTPLC_EXPORT_SOURCES}/Fmi3.cpp)
    qtplc_complete_export(${library} "${arg_LIBRARIES}")
    set_target_properties(${library} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
        LIBRARY_OUTPUT_DIRECTORY ${work}/library)
    add_executable(${program} $<TARGET_OBJECTS:${objects}> ${QTPLC_EXPORT_SOURCES}/ZipFile.cpp
        ${QTPLC_EXPORT_SOURCES}/pack_fmu.cpp)
    qtplc_complete_export(${program} "${arg_LIBRARIES}")
    set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${work})
    set(files)
    foreach(version IN LISTS arg_VERSIONS)
        if(version EQUAL 2)
            list(APPEND files ${arg_FOLDER}/${name}.fmu)
        elseif(version EQUAL 3)
            list(APPEND files ${arg_FOLDER}/${name}_fmi3.fmu)
        else()
            message(FATAL_ERROR "${function}(${name}): there is no FMI version '${version}'; use 2 or 3")
        endif()
        list(GET files -1 file)
        qtplc_pack_fmu(${version} ${file} ${library} ${program})
    endforeach()
    add_custom_target(${name}_fmu ALL DEPENDS ${files})
endfunction()

function(qtplc_make_discon function name)
    qtplc_prepare_export(${function} ${name} ${ARGN})
    if(NOT arg_FOLDER)
        set(arg_FOLDER ${CMAKE_BINARY_DIR}/discon)
    endif()
    qtplc_add_export_library(${name}_discon "DISCON;" ${work}/identity.cpp ${arg_SOURCES}
        ${QTPLC_EXPORT_SOURCES}/ExportedNode.cpp ${QTPLC_EXPORT_SOURCES}/Discon.cpp
        ${QTPLC_EXPORT_SOURCES}/DisconMapping.cpp ${QTPLC_EXPORT_SOURCES}/IniText.cpp)
    qtplc_complete_export(${name}_discon "${arg_LIBRARIES}")
    set_target_properties(${name}_discon PROPERTIES OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${arg_FOLDER})
endfunction()

function(qtplc_add_fmu name)
    qtplc_make_fmu(qtplc_add_fmu ${name} ${ARGN})
endfunction()

function(qtplc_add_discon name)
    qtplc_make_discon(qtplc_add_discon ${name} ${ARGN})
endfunction()

function(qtplc_add_master_fmu name)
    qtplc_make_fmu(qtplc_add_master_fmu ${name} ${ARGN})
endfunction()

function(qtplc_add_master_discon name)
    qtplc_make_discon(qtplc_add_master_discon ${name} ${ARGN})
endfunction()
