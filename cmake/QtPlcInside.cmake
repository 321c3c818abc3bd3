# SPDX-License-Identifier: Apache-2.0
# The shared libraries export the public API alone. A program of this repository that calls more of
# them has the property QTPLC_INSIDE (or the variable of that name, for all programs of a folder).
# It contains the objects of the libraries that it links: docs/design/abi.md.
# Where one library has all symbols for everybody (a static one, or QTPLC_EXPORT_ALL), it is that
# one.
set(QTPLC_INSIDE_ARCHIVES ${BUILD_SHARED_LIBS})
if(QTPLC_EXPORT_ALL)
    set(QTPLC_INSIDE_ARCHIVES OFF)
endif()
define_property(TARGET PROPERTY QTPLC_INSIDE INITIALIZE_FROM_VARIABLE QTPLC_INSIDE
    BRIEF_DOCS "The program contains the libraries of QtPLC that it links"
    FULL_DOCS "It links each library of QtPLC as an archive of all its objects, and not as a shared library.")

# qtplc_add_library(Name): the library QtPlcName, which is installed as QtPlc::Name.
function(qtplc_add_library name)
    add_library(QtPlc${name})
    set_target_properties(QtPlc${name} PROPERTIES
        EXPORT_NAME ${name}
        VERSION ${PROJECT_VERSION}
        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
        VERIFY_INTERFACE_HEADER_SETS ON
        POSITION_INDEPENDENT_CODE ON # static ones, too: the same objects
        DEFINE_SYMBOL ""
    )
endfunction()

# qtplc_add_common(objects library): an object library, a part of \a library that others use, too.
function(qtplc_add_common objects library)
    add_library(${objects} OBJECT)
    set_target_properties(${objects} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_sources(${library} PRIVATE $<TARGET_OBJECTS:${objects}>)
    set_property(TARGET ${library} APPEND PROPERTY QTPLC_OBJECTS $<TARGET_OBJECTS:${objects}>)
endfunction()

# qtplc_use_common(library objects): a shared library has a copy of its own, which no other library
# sees. So these sources have no state that libraries would have to share. An archive needs no copy.
function(qtplc_use_common library objects)
    if(QTPLC_INSIDE_ARCHIVES)
        target_sources(${library} PRIVATE $<TARGET_OBJECTS:${objects}>)
    endif()
endfunction()

# qtplc_add_inside(Name), when the library QtPlcName is complete: QtPlc::Name, which is for a
# program the library, or the archive QtPlcNameInside of the same objects.
function(qtplc_add_inside name)
    set(library QtPlc${name})
    add_library(${library}Choice INTERFACE)
    add_library(QtPlc::${name} ALIAS ${library}Choice)
    if(NOT QTPLC_INSIDE_ARCHIVES)
        target_link_libraries(${library}Choice INTERFACE ${library})
        return()
    endif()
    get_property(objects TARGET ${library} PROPERTY QTPLC_OBJECTS)
    get_target_property(public ${library} INTERFACE_LINK_LIBRARIES)
    get_target_property(all ${library} LINK_LIBRARIES)
    add_library(${library}Inside STATIC $<TARGET_OBJECTS:${library}> ${objects})
    set_target_properties(${library}Inside PROPERTIES EXPORT_NAME ${name}Inside LINKER_LANGUAGE CXX
        AUTOMOC OFF AUTORCC OFF)
    target_include_directories(${library}Inside INTERFACE $<TARGET_PROPERTY:${library},INTERFACE_INCLUDE_DIRECTORIES>)
    target_compile_definitions(${library}Inside INTERFACE $<TARGET_PROPERTY:${library},INTERFACE_COMPILE_DEFINITIONS>)
    foreach(item IN LISTS all)
        if(item MATCHES "^QtPlc")
            target_link_libraries(${library}Inside INTERFACE ${item}Inside)
        elseif(item IN_LIST public)
            target_link_libraries(${library}Inside INTERFACE ${item})
        else()
            target_link_libraries(${library}Inside INTERFACE $<LINK_ONLY:${item}>)
        endif()
    endforeach()
    target_link_libraries(${library}Choice INTERFACE
        $<IF:$<BOOL:$<TARGET_PROPERTY:QTPLC_INSIDE>>,${library}Inside,${library}>)
endfunction()
