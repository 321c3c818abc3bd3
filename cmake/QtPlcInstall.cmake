# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where, and the package that find_package(QtPlc) finds there.
include(CMakePackageConfigHelpers)

set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/QtPlc)
install(TARGETS QtPlcCore
    EXPORT QtPlcTargets
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
)
if(QTPLC_BUILD_HARDWARE)
    install(TARGETS QtPlcHardware
        EXPORT QtPlcHardwareTargets
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    )
    install(EXPORT QtPlcHardwareTargets NAMESPACE QtPlc:: DESTINATION ${package_directory})
    install(TARGETS qtplc_hardware RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(QTPLC_BUILD_GUI)
    install(TARGETS QtPlcGui
        EXPORT QtPlcGuiTargets
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    )
    install(EXPORT QtPlcGuiTargets NAMESPACE QtPlc:: DESTINATION ${package_directory})
    install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindMuParser.cmake ${CMAKE_CURRENT_LIST_DIR}/FindQwt.cmake DESTINATION ${package_directory})
endif()
if(TARGET QtPlcGui3D)
    install(TARGETS QtPlcGui3D
        EXPORT QtPlcGui3DTargets
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    )
    install(EXPORT QtPlcGui3DTargets NAMESPACE QtPlc:: DESTINATION ${package_directory})
endif()
install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindSodium.cmake DESTINATION ${package_directory})
install(TARGETS qtplc RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT QtPlcTargets NAMESPACE QtPlc:: DESTINATION ${package_directory})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/QtPlcConfig.cmake.in ${PROJECT_BINARY_DIR}/QtPlcConfig.cmake
    INSTALL_DESTINATION ${package_directory})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/QtPlcConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/QtPlcConfig.cmake ${PROJECT_BINARY_DIR}/QtPlcConfigVersion.cmake DESTINATION ${package_directory})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
