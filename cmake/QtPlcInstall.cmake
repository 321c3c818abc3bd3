# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where, and the package that find_package(QtPlc) finds there.
# Components are called like the Debian packages that they become (QtPlcPackages.cmake).
include(CMakePackageConfigHelpers)

set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/QtPlc)

# A library for the component \a runtime, and what is needed to build with it for \a runtime-dev.
function(qtplc_install_library target export runtime)
    install(TARGETS ${target}
        EXPORT ${export}
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${runtime}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${runtime} NAMELINK_COMPONENT ${runtime}-dev
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${runtime}-dev
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${runtime}-dev
    )
    install(EXPORT ${export} NAMESPACE QtPlc:: DESTINATION ${package_directory} COMPONENT ${runtime}-dev)
endfunction()

qtplc_install_library(QtPlcCore QtPlcTargets libqtplc)
# What tests, FMUs and controller libraries contain. A static library needs no second one.
if(QTPLC_INSIDE_ARCHIVES)
    qtplc_install_library(QtPlcCoreInside QtPlcInsideTargets libqtplc)
endif()
install(FILES ${CMAKE_CURRENT_LIST_DIR}/QtPlcExport.cmake DESTINATION ${package_directory} COMPONENT libqtplc-dev)
install(DIRECTORY src/export DESTINATION ${package_directory} COMPONENT libqtplc-dev)
install(TARGETS qtplc RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT qtplc-tools)
if(TARGET QtPlcHardware)
    qtplc_install_library(QtPlcHardware QtPlcHardwareTargets libqtplc)
    install(TARGETS qtplc_hardware RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT qtplc-tools)
    # Whoever links the static library links what it uses, too.
    if(NOT BUILD_SHARED_LIBS)
        get_target_property(dependencies QtPlcHardware QTPLC_STATIC_DEPENDENCIES)
        list(TRANSFORM dependencies REPLACE "(.+)" "    find_dependency(\\1)\n")
        string(CONCAT QTPLC_HARDWARE_DEPENDENCIES
            "    list(PREPEND CMAKE_MODULE_PATH \${CMAKE_CURRENT_LIST_DIR})\n"
            ${dependencies} "    list(POP_FRONT CMAKE_MODULE_PATH)\n")
        install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindModbus.cmake DESTINATION ${package_directory}
            COMPONENT libqtplc-dev)
    endif()
endif()
qtplc_install_library(QtPlcRecording QtPlcRecordingTargets libqtplc)
# Tests contain it: docs/design/abi.md.
if(QTPLC_INSIDE_ARCHIVES AND TARGET QtPlcTest)
    qtplc_install_library(QtPlcRecordingInside QtPlcRecordingInsideTargets libqtplc-test)
endif()
if(NOT BUILD_SHARED_LIBS OR TARGET QtPlcTest)
    install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindZstd.cmake DESTINATION ${package_directory} COMPONENT libqtplc-dev)
endif()
if(TARGET QtPlcModels)
    qtplc_install_library(QtPlcModels QtPlcModelsTargets libqtplc)
    install(TARGETS qtplc_fmu RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT qtplc-tools)
    if(NOT BUILD_SHARED_LIBS)
        install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindZip.cmake DESTINATION ${package_directory} COMPONENT libqtplc-dev)
    endif()
endif()
if(QTPLC_BUILD_GUI)
    qtplc_install_library(QtPlcGui QtPlcGuiTargets libqtplc-gui)
    install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindKissFft.cmake ${CMAKE_CURRENT_LIST_DIR}/FindMuParser.cmake
        ${CMAKE_CURRENT_LIST_DIR}/FindQwt.cmake
        DESTINATION ${package_directory} COMPONENT libqtplc-gui-dev)
endif()
if(TARGET QtPlcTest)
    qtplc_install_library(QtPlcTest QtPlcTestTargets libqtplc-test)
endif()
if(TARGET QtPlcGui3D)
    qtplc_install_library(QtPlcGui3D QtPlcGui3DTargets libqtplc-gui)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/QtPlcConfig.cmake.in ${PROJECT_BINARY_DIR}/QtPlcConfig.cmake
    INSTALL_DESTINATION ${package_directory})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/QtPlcConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/QtPlcConfig.cmake ${PROJECT_BINARY_DIR}/QtPlcConfigVersion.cmake
    ${CMAKE_CURRENT_LIST_DIR}/FindSodium.cmake ${CMAKE_CURRENT_LIST_DIR}/QtPlcComponents.cmake
    DESTINATION ${package_directory} COMPONENT libqtplc-dev)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/QtPlcSimulink.cmake DESTINATION ${package_directory} COMPONENT libqtplc-dev)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/simulink/generate.py ${CMAKE_CURRENT_LIST_DIR}/simulink/headers.py
    ${CMAKE_CURRENT_LIST_DIR}/simulink/model.py DESTINATION ${package_directory}/simulink COMPONENT libqtplc-dev)
# The documents with all that they link to; the menu Help of windows shows them.
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
    COMPONENT qtplc-doc)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT qtplc-doc
    PATTERN "build" EXCLUDE
    PATTERN "__pycache__" EXCLUDE
    PATTERN "Doxyfile.in" EXCLUDE
    PATTERN "reference.dox" EXCLUDE
    PATTERN ".clang-format" EXCLUDE)
include(QtPlcServices)
include(QtPlcPackages)
