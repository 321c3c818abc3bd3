# SPDX-License-Identifier: Apache-2.0
# Debian packages: scripts/package makes them of the preset package. A component of the installation
# is a package.
set(packages libqtplc libqtplc-dev qtplc-tools qtplc-doc)
if(QTPLC_BUILD_EXAMPLES)
    list(APPEND packages qtplc-awe)
endif()
if(QTPLC_BUILD_GUI)
    list(APPEND packages libqtplc-gui libqtplc-gui-dev)
    if(QTPLC_BUILD_EXAMPLES)
        list(APPEND packages qtplc-control-center)
    endif()
endif()

if(TARGET QtPlcTest)
    list(APPEND packages libqtplc-test-dev)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL ${packages})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGE_NAME qtplc)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGE_CONTACT "The QtPLC developers <maintainers@qtplc.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
    GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON) # of those that have libraries
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src ${PROJECT_BINARY_DIR}/src/hardware
    ${PROJECT_BINARY_DIR}/src/models ${PROJECT_BINARY_DIR}/src/recording
    ${PROJECT_BINARY_DIR}/src/gui ${PROJECT_BINARY_DIR}/src/gui3d)
if(CMAKE_CROSSCOMPILING)
    execute_process(COMMAND dpkg-architecture -t ${CMAKE_LIBRARY_ARCHITECTURE} -q DEB_HOST_ARCH
        OUTPUT_VARIABLE CPACK_DEBIAN_PACKAGE_ARCHITECTURE OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
endif()

# qtplc_package(NAME SECTION section SUMMARY line DESCRIPTION text [LIBRARIES] [ALL_ARCHITECTURES]
# [DEPENDS package ...] [RECOMMENDS package ...] [SUGGESTS package ...]): a Debian package. SUMMARY
# does not repeat the name.
macro(qtplc_package name)
    cmake_parse_arguments(arg "LIBRARIES;ALL_ARCHITECTURES" "SECTION;SUMMARY;DESCRIPTION"
        "DEPENDS;RECOMMENDS;SUGGESTS" ${ARGN})
    string(TOUPPER ${name} key)
    set(CPACK_COMPONENT_${key}_DESCRIPTION "${arg_SUMMARY}\n${arg_DESCRIPTION}")
    set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
    set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${arg_SECTION})
    if(arg_ALL_ARCHITECTURES)
        set(CPACK_DEBIAN_${key}_PACKAGE_ARCHITECTURE all)
    else()
        set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS ON)
    endif()
    set(depends)
    foreach(package ${arg_DEPENDS})
        if(package IN_LIST packages)
            string(APPEND package " (= ${PROJECT_VERSION})")
        endif()
        list(APPEND depends "${package}")
    endforeach()
    list(JOIN depends ", " CPACK_DEBIAN_${key}_PACKAGE_DEPENDS)
    list(JOIN arg_RECOMMENDS ", " CPACK_DEBIAN_${key}_PACKAGE_RECOMMENDS)
    list(JOIN arg_SUGGESTS ", " CPACK_DEBIAN_${key}_PACKAGE_SUGGESTS)
    file(GLOB control CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/packaging/debian/${name}/*)
    if(arg_LIBRARIES)
        list(APPEND control ${PROJECT_SOURCE_DIR}/packaging/debian/triggers)
    endif()
    set(CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA ${control})
    install(FILES ${PROJECT_SOURCE_DIR}/packaging/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
        COMPONENT ${name} EXCLUDE_FROM_ALL)
    install(FILES ${PROJECT_BINARY_DIR}/debian/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
        COMPONENT ${name} EXCLUDE_FROM_ALL)
endmacro()

file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/debian)
execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/packaging/debian/changelog
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/debian/changelog.gz)

qtplc_package(libqtplc SECTION libs LIBRARIES
    SUMMARY "distributed real-time controllers, libraries"
    DESCRIPTION "QtPLC makes a real-time controller of ordinary Linux computers: a master owns
the cycle and the values of all signals, nodes read and write them by name.
.
These are the libraries that nodes need at run time, without windows.")
qtplc_package(libqtplc-dev SECTION libdevel
    SUMMARY "distributed real-time controllers, for building nodes"
    DESCRIPTION "Headers of QtPLC, and what find_package(QtPlc) finds: also the functions that make
FMUs and controller libraries of nodes. Python reads code that Simulink has exported."
    DEPENDS libqtplc qtbase5-dev libsodium-dev python3 RECOMMENDS qtplc-doc)
qtplc_package(libqtplc-test-dev SECTION libdevel
    SUMMARY "distributed real-time controllers, for testing nodes"
    DESCRIPTION "What find_package(QtPlc COMPONENTS Test) finds: whole plants in one thread and in
virtual time, and nodes that compute recordings again, for tests of nodes."
    DEPENDS libqtplc-dev libboost-context-dev libsodium-dev libzstd-dev RECOMMENDS qtplc-doc)
qtplc_package(qtplc-tools SECTION utils
    SUMMARY "distributed real-time controllers, tools"
    DESCRIPTION "The command qtplc looks into a running QtPLC plant and steers it, and tells
whether a computer is fit for real time. The service qtplc-hardware@ ties
signals to devices, and qtplc_fmu makes nodes of FMUs (FMI 2.0 and 3.0)."
    DEPENDS libqtplc adduser RECOMMENDS qtplc-doc SUGGESTS rt-tests stress-ng)
qtplc_package(qtplc-doc SECTION doc ALL_ARCHITECTURES
    SUMMARY "distributed real-time controllers, documents"
    DESCRIPTION "Tutorial, how-tos and reference of QtPLC in /usr/share/doc/QtPlc. The menu Help
of its windows shows them.")
qtplc_package(qtplc-awe SECTION science
    SUMMARY "distributed real-time controllers, airborne wind energy"
    DESCRIPTION "A kite that generates power on its tether, simulated in real time: master,
model and autopilot as programs and as services. Nothing starts by itself."
    DEPENDS libqtplc qtplc-tools RECOMMENDS python3)
qtplc_package(libqtplc-gui SECTION libs LIBRARIES
    SUMMARY "distributed real-time controllers, libraries of windows"
    DESCRIPTION "Plots, gauges, tables and the 3D view of QtPLC."
    DEPENDS libqtplc)
qtplc_package(libqtplc-gui-dev SECTION libdevel
    SUMMARY "distributed real-time controllers, for building windows"
    DESCRIPTION "What find_package(QtPlc COMPONENTS Gui) finds."
    DEPENDS libqtplc-gui libqtplc-dev libqt5svg5-dev libqwt-qt5-dev libmuparser-dev
        libkissfft-dev qt3d5-dev)
qtplc_package(qtplc-control-center SECTION science
    SUMMARY "distributed real-time controllers, Control Center"
    DESCRIPTION "The window in which people see, steer and understand a running QtPLC plant."
    DEPENDS libqtplc-gui RECOMMENDS qtplc-awe qtplc-doc qtplc-tools SUGGESTS ffmpeg)

include(CPack)
