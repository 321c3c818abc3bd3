# SPDX-License-Identifier: Apache-2.0
# When a project is configured: does a target link QtPlc::Gui, QtPlc::Gui3D, QtPlc::Hardware,
# QtPlc::Models, QtPlc::Recording or QtPlc::Test although no find_package() has asked for it? CMake
# alone says only that there is no such target.
function(qtplc_check_linked_components folder)
    get_property(found GLOBAL PROPERTY QTPLC_FOUND_COMPONENTS)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
        get_property(libraries TARGET ${target} PROPERTY LINK_LIBRARIES)
        foreach(component Gui Gui3D Hardware Models Recording Test)
            if(QtPlc::${component} IN_LIST libraries AND NOT component IN_LIST found AND NOT TARGET QtPlc::${component})
                message(FATAL_ERROR
                    "The target '${target}' links QtPlc::${component}, which find_package() has not found, "
                    "because it was not asked for. Remedy: find_package(QtPlc REQUIRED COMPONENTS ${component})")
            endif()
        endforeach()
    endforeach()
    get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
    foreach(subfolder IN LISTS subfolders)
        qtplc_check_linked_components(${subfolder})
    endforeach()
endfunction()

get_property(scheduled GLOBAL PROPERTY QTPLC_CHECKS_COMPONENTS)
if(NOT scheduled AND NOT CMAKE_SCRIPT_MODE_FILE)
    set_property(GLOBAL PROPERTY QTPLC_CHECKS_COMPONENTS TRUE)
    cmake_language(DEFER DIRECTORY ${CMAKE_SOURCE_DIR} CALL qtplc_check_linked_components ${CMAKE_SOURCE_DIR})
endif()
