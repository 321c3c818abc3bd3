# SPDX-License-Identifier: Apache-2.0
# Units of systemd for master and nodes. They name the installed programs by their whole paths, so
# they are part of packages, and of an installation only where that is asked for.
option(QTPLC_INSTALL_SERVICES "Install units of systemd, and what belongs to them (for CMAKE_INSTALL_PREFIX=/usr)" OFF)

set(units_of_awe qtplc-awe.target qtplc-awe-master.service qtplc-awe-model.service qtplc-awe-autopilot.service)
set(units_of_tools qtplc-hardware@.service qtplc-recorder.service)
set(packaging ${PROJECT_SOURCE_DIR}/packaging)
foreach(part real-time sandbox)
    file(READ ${packaging}/systemd/${part}.conf text)
    string(STRIP "${text}" text)
    string(REPLACE - _ name ${part})
    set(${name} "${text}")
endforeach()
foreach(unit ${units_of_awe} ${units_of_tools})
    configure_file(${packaging}/systemd/${unit}.in ${PROJECT_BINARY_DIR}/systemd/${unit} @ONLY)
endforeach()
list(TRANSFORM units_of_awe PREPEND ${PROJECT_BINARY_DIR}/systemd/)
list(TRANSFORM units_of_tools PREPEND ${PROJECT_BINARY_DIR}/systemd/)

if(QTPLC_INSTALL_SERVICES)
    install(FILES ${units_of_tools} DESTINATION lib/systemd/system COMPONENT qtplc-tools)
    install(FILES ${packaging}/udev/50-qtplc.rules DESTINATION lib/udev/rules.d COMPONENT qtplc-tools)
    install(FILES ${packaging}/debian/qtplc-hardware.default DESTINATION /etc/default RENAME qtplc-hardware
        COMPONENT qtplc-tools)
    install(FILES ${packaging}/debian/qtplc-recorder.default DESTINATION /etc/default RENAME qtplc-recorder
        COMPONENT qtplc-tools)
    install(DIRECTORY DESTINATION /etc/qtplc COMPONENT qtplc-tools)
    if(QTPLC_BUILD_EXAMPLES)
        install(FILES ${units_of_awe} DESTINATION lib/systemd/system COMPONENT qtplc-awe)
        install(FILES ${packaging}/debian/qtplc-awe.default DESTINATION /etc/default RENAME qtplc-awe
            COMPONENT qtplc-awe)
    endif()
endif()
