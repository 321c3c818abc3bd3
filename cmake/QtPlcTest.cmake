# SPDX-License-Identifier: Apache-2.0
# qtplc_add_test(tst_name SOURCES a.cpp ... [LIBRARIES target ...] [LABELS label ...] [TIMEOUT s])
# Label not-emulated: an emulator of another processor cannot run it (it starts programs, asks the
# scheduler, ...), which a comment beside it says. Nor does it run what is labelled programs. One Qt
# Test program, one CTest entry; it may use the headers of every room of src/. Target tests_LABEL
# builds the tests of a label.
find_package(Qt5 5.15 REQUIRED COMPONENTS Test)

# To read the headers of Qt and of fixtures takes longer than to compile most tests: all tests of a
# kind share them, read once. Kinds with fixtures are added where the fixtures are.
set(QTPLC_TEST_HEADERS <QtNetwork/QtNetwork> <QtTest/QtTest> <functional> <memory> <thread>)
function(qtplc_precompile_headers test)
    get_target_property(libraries ${test} LINK_LIBRARIES)
    if(libraries MATCHES "gui_fixtures")
        set(kind gui)
    elseif(libraries MATCHES "node_fixtures")
        set(kind node)
    else()
        set(kind core)
        qtplc_add_test_headers(core LIBRARIES QtPlc::Core)
    endif()
    target_precompile_headers(${test} REUSE_FROM ${kind}_test_headers)
endfunction()

# qtplc_add_test_headers(kind LIBRARIES target ... [HEADERS header ...])
function(qtplc_add_test_headers kind)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES;HEADERS")
    set(name ${kind}_test_headers)
    if(NOT TARGET ${name})
        # Written once only.
        file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "int main() { return 0; }\n")
        add_executable(${name} EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/${name}.cpp)
        set_target_properties(${name} PROPERTIES AUTOMOC OFF)
        target_link_libraries(${name} PRIVATE Qt5::Test ${arg_LIBRARIES})
        target_precompile_headers(${name} PRIVATE ${QTPLC_TEST_HEADERS} ${arg_HEADERS})
    endif()
endfunction()

# What has no header of its own needs moc for one file only: AUTOMOC begins CMake anew, and compiles
# a file, for each program.
function(qtplc_moc_test name)
    get_target_property(sources ${name} SOURCES)
    if(NOT sources MATCHES "[.]h(;|$)")
        list(GET sources 0 source)
        get_filename_component(base ${source} NAME_WE)
        set(moc ${CMAKE_CURRENT_BINARY_DIR}/${base}.moc)
        qt5_generate_moc(${source} ${moc} TARGET ${name})
        target_sources(${name} PRIVATE ${moc})
        target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
        set_target_properties(${name} PROPERTIES AUTOMOC OFF)
    endif()
endfunction()

function(qtplc_add_test name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS")
    qtplc_sort_tests_later()
    add_executable(${name} ${arg_SOURCES})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(${name} PRIVATE QtPlc::Core Qt5::Test ${arg_LIBRARIES})
    qtplc_precompile_headers(${name})
    qtplc_moc_test(${name})
    add_test(NAME ${name} COMMAND ${name})
    if(NOT arg_TIMEOUT)
        set(arg_TIMEOUT 300)
    endif()
    set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS "${arg_LABELS}"
        ENVIRONMENT "QT_QPA_PLATFORM=offscreen;XDG_STATE_HOME=${CMAKE_BINARY_DIR}/state")
    foreach(label ${arg_LABELS})
        qtplc_build_with_label(${label} ${name})
    endforeach()
endfunction()

# qtplc_add_screen_test(name target [VARIABLE=VALUE ...]) runs a test program on the screen of a
# laptop, with OpenGL in software. Pictures that it makes are kept in the folder "screenshots" of
# the build (QTPLC_SCREENSHOTS). The variable QTPLC_SCREEN of the caller names another size of the
# screen: 1920x1080. Servers and drivers keep memory until the end, and take texts without an end:
# leaks of ours are looked for by the tests without a screen.
find_program(XVFB_RUN xvfb-run)
function(qtplc_add_screen_test name target)
    if(NOT XVFB_RUN)
        message(STATUS "${name} is not tested on a screen: xvfb-run is missing (Debian: xvfb, xauth)")
        return()
    endif()
    set(screen 1366x768)
    if(QTPLC_SCREEN)
        set(screen ${QTPLC_SCREEN})
    endif()
    add_test(NAME ${name} COMMAND ${XVFB_RUN} -a -s "-screen 0 ${screen}x24" $<TARGET_FILE:${target}>)
    set(environment QT_QPA_PLATFORM=xcb QT_FONT_DPI=96 LIBGL_ALWAYS_SOFTWARE=1 XDG_STATE_HOME=${CMAKE_BINARY_DIR}/state
        ASAN_OPTIONS=detect_leaks=0 QTPLC_SCREENSHOTS=${CMAKE_BINARY_DIR}/screenshots ${ARGN})
    set_tests_properties(${name} PROPERTIES TIMEOUT 300 ENVIRONMENT "${environment}")
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/screenshots)
endfunction()

# qtplc_label_tests(label tst_name ...) gives a label to tests of this directory.
function(qtplc_label_tests label)
    foreach(name ${ARGN})
        set_property(TEST ${name} APPEND PROPERTY LABELS ${label})
        qtplc_build_with_label(${label} ${name})
    endforeach()
endfunction()

function(qtplc_build_with_label label name)
    if(NOT TARGET tests_${label})
        add_custom_target(tests_${label})
    endif()
    add_dependencies(tests_${label} ${name})
endfunction()
