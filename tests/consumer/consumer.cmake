# SPDX-License-Identifier: Apache-2.0
# Run by CTest, or by hand:
# cmake -DSOURCE=... -DBUILD=... -DWORK=... -DBUILD_TYPE=Release -P tests/consumer/consumer.cmake
cmake_policy(VERSION 3.23)
set(prefix ${WORK}/prefix)
if(NOT GENERATOR)
    set(GENERATOR Ninja)
endif()
set(compiler)
if(COMPILER)
    set(compiler -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
endif()

function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        string(JOIN " " command ${ARGN})
        message(FATAL_ERROR "${command}\n${output}\ngave ${result}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

function(run_failing)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(result EQUAL 0)
        string(JOIN " " command ${ARGN})
        message(FATAL_ERROR "${command}\n${output}\nworks, and is to fail")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect text)
    if(NOT output MATCHES "${text}")
        message(FATAL_ERROR "expected '${text}' in\n${output}")
    endif()
endfunction()

# A project that knows nothing but where QtPLC is installed.
function(build_project name folder)
    run(${CMAKE_COMMAND} -S ${folder} -B ${WORK}/${name} -G ${GENERATOR} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
        -DCMAKE_PREFIX_PATH=${prefix} ${compiler} -DCMAKE_INSTALL_PREFIX=${prefix} ${ARGN})
    run(${CMAKE_COMMAND} --build ${WORK}/${name} --parallel 2)
    message(STATUS "${name}: built against the installed package")
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${prefix}/bin/qtplc --version)
find_program(python python3 REQUIRED)
run(${python} -B ${SOURCE}/tests/documents/documents.py --installed ${prefix}/share/doc/QtPlc)

build_project(winch ${SOURCE}/tests/consumer/winch)
run(${WORK}/winch/winch --help)
expect("--master")
run(${WORK}/winch/both_include_styles)
run(ldd ${WORK}/winch/winch)
string(REGEX MATCHALL "libQt5[A-Za-z0-9]+" libraries "${output}")
list(REMOVE_DUPLICATES libraries)
list(SORT libraries)
if(NOT libraries STREQUAL "libQt5Core;libQt5Network")
    message(FATAL_ERROR "a node needs ${libraries}; it is to need libQt5Core and libQt5Network only")
endif()

# A node from an export of Simulink; another sample time, and a second node in the same program, are
# refused.
set(simulink ${SOURCE}/tests/consumer/simulink)
set(models -DMODELS=${SOURCE}/tests/simulink)
build_project(simulink ${simulink} ${models})
run(${WORK}/simulink/pendulum --table)
expect("\\[angle\\]\ntype = Real64")
run_failing(${CMAKE_COMMAND} --build ${WORK}/simulink --target both)
expect("only_one_node_of_Pendulum_because_its_variables_are_global")
run_failing(${CMAKE_COMMAND} -S ${simulink} -B ${WORK}/simulink_period -DCMAKE_PREFIX_PATH=${prefix} ${models}
    ${compiler} -DPERIOD=20ms)
expect("the[ \n]+model[ \n]+has[ \n]+the[ \n]+sample[ \n]+time[ \n]+0.01")

# A window, as in the README. Without the component CMake and the compiler name the remedy.
set(window ${SOURCE}/tests/consumer/window)
if(EXISTS ${prefix}/include/QtPlc/QPlcControlCenter.h)
    build_project(window ${window})
    run_failing(${CMAKE_COMMAND} -S ${window} -B ${WORK}/window_without_component -DCMAKE_PREFIX_PATH=${prefix}
        -DCOMPONENTS= ${compiler})
    expect("The target 'window' links QtPlc::Gui.*\
Remedy:[ \n]+find_package\\(QtPlc[ \n]+REQUIRED[ \n]+COMPONENTS[ \n]+Gui\\)")
    run(${CMAKE_COMMAND} -S ${window} -B ${WORK}/window_of_core -DCMAKE_PREFIX_PATH=${prefix}
        -DCOMPONENTS= -DLIBRARY=QtPlc::Core ${compiler})
    run_failing(${CMAKE_COMMAND} --build ${WORK}/window_of_core)
    expect("find_package\\(QtPlc REQUIRED COMPONENTS Gui\\)")

    # A panel of a user, as in docs/howto/write-a-panel.md, seen in a window with a plant.
    build_project(panel ${SOURCE}/tests/consumer/panel)
    file(MAKE_DIRECTORY ${WORK}/pictures)
    set(check ${WORK}/panel/check_panel ${WORK}/pictures)
    find_program(xvfb_run xvfb-run)
    if(xvfb_run)
        run(${CMAKE_COMMAND} -E env QT_QPA_PLATFORM=xcb ${xvfb_run} -a -s "-screen 0 1366x768x24" ${check})
    else()
        run(${CMAKE_COMMAND} -E env QT_QPA_PLATFORM=offscreen ${check})
    endif()
    build_project(panel_page ${SOURCE}/docs/howto/code/panel)
endif()

# A test of a user's node in a simulated plant, as in docs/howto/test-a-plant.md.
if(EXISTS ${prefix}/include/QtPlc/QPlcSimulator.h)
    build_project(plant_test ${SOURCE}/docs/howto/code/plant_test)
    run(${WORK}/plant_test/tst_Winch)
    run(${WORK}/plant_test/tst_WinchReplay)
endif()

# A program that reads recordings, as in docs/howto/read-a-recording.md.
build_project(recording ${SOURCE}/docs/howto/code/recording)

# A test of a user's node, as in docs/howto/test-a-node.md.
build_project(node_test ${SOURCE}/docs/howto/code/node_test)
run(${WORK}/node_test/tst_Winch)

# Nodes for the programs of others. The files contain QtPLC, and export nothing else than the
# functions of their interface.
function(expect_interface library functions)
    run(nm --dynamic --defined-only --format=posix ${library})
    string(REGEX MATCHALL "[^\n]+" symbols "${output}")
    foreach(symbol IN LISTS symbols)
        if(NOT symbol MATCHES "^(${functions})")
            message(FATAL_ERROR "${library} exports ${symbol}")
        endif()
    endforeach()
    run(ldd ${library})
    if(output MATCHES "libQtPlc")
        message(FATAL_ERROR "${library} needs a library of QtPLC\n${output}")
    endif()
endfunction()
file(COPY ${SOURCE}/docs/howto/code/fmu/ ${SOURCE}/docs/tutorial/code/Winch.h ${SOURCE}/docs/tutorial/code/winch.ini
    DESTINATION ${WORK}/fmu_project)
build_project(fmu ${WORK}/fmu_project)
build_project(turbine ${SOURCE}/examples/wind_turbine)
build_project(turbine_plant ${SOURCE}/examples/wind_turbine/network)
build_project(export ${SOURCE}/tests/consumer/export)
expect_interface(${WORK}/fmu/qtplc_add_fmu/winch/library/winch.so "fmi[23]")
expect_interface(${WORK}/turbine/discon/libdiscon_example.so "DISCON ")
expect_interface(${WORK}/turbine_plant/discon/libdiscon_plant.so "DISCON ")
expect_interface(${WORK}/export/qtplc_add_fmu/doubler/library/doubler.so "fmi[23]")

if(EXISTS ${prefix}/include/QtPlc/QPlcHardwareNode.h)
    build_project(howto ${SOURCE}/docs/howto/code)
    run(${WORK}/howto/weather_node --help)
    expect("configuration")
endif()

if(EXISTS ${prefix}/include/QtPlc/QPlcFmuNode.h)
    run(${prefix}/bin/qtplc_fmu node --help)
    expect("--master")
endif()

if(EXAMPLES)
    # Whether it compiles and flies is of interest, not how fast.
    build_project(example ${SOURCE}/examples/airborne_wind_energy -DAWE_BUILD_TESTS=OFF
        -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10 -DCMAKE_CXX_FLAGS_RELEASE=-O1)
    run(${CMAKE_COMMAND} --install ${WORK}/example)
    foreach(program awe_master awe_model awe_compact_model awe_lawe_model awe_autopilot awe_sil)
        run(${prefix}/bin/${program} --version)
    endforeach()
    if(EXISTS ${prefix}/include/QtPlc/QPlcControlCenter.h)
        run(${prefix}/bin/awe_control_center --version)
    endif()
    if(EXISTS ${prefix}/include/QtPlc/QPlcHardwareNode.h)
        run(${prefix}/bin/awe_winch_drive --version)
        run(${prefix}/bin/qtplc_hardware --check ${prefix}/share/qtplc/airborne_wind_energy/winch.ini)
        expect("winchSpeed")
    endif()
    # From the installed tree, with the installed table, in one process and in three.
    set(flight ${prefix}/bin/awe_sil --lockstep --duration 30
        --signals ${prefix}/share/qtplc/signals/airborne_wind_energy.ini)
    run(${flight})
    string(REGEX MATCH "image digest +[0-9a-f]+" digest "${output}")
    run(${flight} --processes)
    expect("${digest}")
endif()
