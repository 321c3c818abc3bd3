# SPDX-License-Identifier: Apache-2.0
# qtplc_add_test(tst_name SOURCES a.cpp ... [LIBRARIES target ...] [LABELS label ...] [TIMEOUT seconds])
# One Qt Test program, one CTest entry; it may use the headers of every room of src/.
find_package(Qt5 5.15 REQUIRED COMPONENTS Test)
function(qtplc_add_test name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS")
    add_executable(${name} ${arg_SOURCES})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(${name} PRIVATE QtPlc::Core Qt5::Test ${arg_LIBRARIES})
    add_test(NAME ${name} COMMAND ${name})
    if(NOT arg_TIMEOUT)
        set(arg_TIMEOUT 60)
    endif()
    set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS "${arg_LABELS}"
        ENVIRONMENT "QT_QPA_PLATFORM=offscreen")
endfunction()
