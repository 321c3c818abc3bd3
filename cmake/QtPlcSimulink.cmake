# SPDX-License-Identifier: Apache-2.0
# qtplc_add_simulink_node(target DIR folder PERIOD time [options]): a node program around code that
# Simulink Coder or Embedded Coder has exported, without a line of code by hand.
#
#   DIR folder          unpacked export
#   PERIOD 10ms         sample time of the model; with another period of the master the node fails
#   MODEL name          if the folder has several models
#   NODE_NAME name      under which the node registers (default: the name of the model)
#   PREFIX text         in front of the names of signals: lawe.
#   MAP file            INI: [signals] signal = field of the model, where names differ;
#                       "J = inertia[3x3]" for a matrix (MATLAB stores columns, QtPLC rows)
#   WORKLOAD signal     gets the workload of the node [s]
#   INCLUDE folder ...  of headers that are not in DIR
#   DEFINITIONS X=1 ... for the headers and sources of the export
#   INITIALIZE, STEP, TERMINATE function   if the entry points have names of their own
#
# Makes the program `target`, and the library `target_node` with the header "target.h" for programs
# and tests that make the node themselves: std::unique_ptr<QPlcSimulinkNode> make_target().
set(QTPLC_SIMULINK_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/simulink)

function(qtplc_read_simulink_export target output)
    cmake_parse_arguments(PARSE_ARGV 2 arg ""
        "DIR;PERIOD;MODEL;NODE_NAME;PREFIX;MAP;WORKLOAD;INITIALIZE;STEP;TERMINATE" "INCLUDE;DEFINITIONS")
    find_package(Python3 COMPONENTS Interpreter QUIET)
    set(problem)
    if(NOT Python3_Interpreter_FOUND)
        set(problem "it needs Python 3, which is not installed (Debian: python3)")
    elseif(arg_UNPARSED_ARGUMENTS)
        set(problem "'${arg_UNPARSED_ARGUMENTS}' is not an option of it")
    elseif(NOT target MATCHES "^[A-Za-z_][A-Za-z0-9_]*$")
        set(problem "use letters, digits and _ in the name of the target: it becomes a name in C++")
    elseif(NOT arg_DIR OR NOT arg_PERIOD)
        set(problem "it needs DIR and PERIOD: qtplc_add_simulink_node(${target} DIR LaweModel PERIOD 10ms)")
    endif()
    if(problem)
        message(FATAL_ERROR "qtplc_add_simulink_node(${target}): ${problem}")
    endif()
    get_filename_component(directory ${arg_DIR} ABSOLUTE)
    set(options --target=${target} --dir=${directory} --period=${arg_PERIOD} --output=${output})
    foreach(name MODEL NODE_NAME PREFIX WORKLOAD INITIALIZE STEP TERMINATE)
        if(arg_${name})
            string(TOLOWER ${name} option)
            string(REPLACE _ - option ${option})
            list(APPEND options "--${option}=${arg_${name}}")
        endif()
    endforeach()
    if(arg_MAP)
        get_filename_component(map ${arg_MAP} ABSOLUTE)
        list(APPEND options --map=${map})
    endif()
    set(includes)
    foreach(folder ${arg_INCLUDE})
        get_filename_component(folder ${folder} ABSOLUTE)
        list(APPEND includes ${folder})
        list(APPEND options --include=${folder})
    endforeach()
    list(TRANSFORM arg_DEFINITIONS PREPEND --define= OUTPUT_VARIABLE defines)
    list(APPEND options ${defines})
    # What comes or goes in the folder, and what changes in it, is read again.
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${directory}/*.h ${directory}/*.hpp ${directory}/*.c ${directory}/*.cpp)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files} ${map}
        ${QTPLC_SIMULINK_SCRIPTS}/headers.py ${QTPLC_SIMULINK_SCRIPTS}/model.py ${QTPLC_SIMULINK_SCRIPTS}/generate.py)
    execute_process(COMMAND ${Python3_EXECUTABLE} -B ${QTPLC_SIMULINK_SCRIPTS}/generate.py ${options}
        RESULT_VARIABLE result ERROR_VARIABLE error OUTPUT_QUIET)
    if(NOT result EQUAL 0)
        string(STRIP "${error}" error)
        message(FATAL_ERROR "qtplc_add_simulink_node(${target}): ${error}")
    endif()
    set(includes ${includes} PARENT_SCOPE)
    set(definitions ${arg_DEFINITIONS} PARENT_SCOPE)
endfunction()

function(qtplc_add_simulink_node target)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_simulink)
    qtplc_read_simulink_export(${target} ${output} ${ARGN})
    include(${output}/${target}.cmake)
    get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
    if(sources MATCHES "[.]c(;|$)" AND NOT C IN_LIST languages)
        message(FATAL_ERROR "qtplc_add_simulink_node(${target}): the export has C sources, and the project does not "
            "compile C; write project(... LANGUAGES C CXX)")
    endif()

    # The export as it is: without warnings of this project, and hidden from other programs.
    add_library(${target}_model OBJECT ${sources})
    target_include_directories(${target}_model SYSTEM PUBLIC ${folders} ${includes})
    target_compile_definitions(${target}_model PUBLIC ${definitions})
    target_compile_options(${target}_model PRIVATE -w)
    # The node around it.
    add_library(${target}_node STATIC ${output}/${target}_node.cpp $<TARGET_OBJECTS:${target}_model>)
    target_include_directories(${target}_node PUBLIC ${output})
    target_include_directories(${target}_node SYSTEM PRIVATE ${folders} ${includes})
    target_compile_definitions(${target}_node PRIVATE ${definitions} QT_NO_KEYWORDS)
    target_compile_options(${target}_node PRIVATE -w)
    target_link_libraries(${target}_node PUBLIC QtPlc::Core)
    add_executable(${target} ${output}/${target}_main.cpp)
    target_link_libraries(${target} PRIVATE ${target}_node)
    set_target_properties(${target}_model ${target}_node ${target} PROPERTIES
        AUTOMOC OFF UNITY_BUILD OFF POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden
        CXX_VISIBILITY_PRESET hidden CXX_CLANG_TIDY "" CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON)
endfunction()
