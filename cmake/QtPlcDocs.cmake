# SPDX-License-Identifier: Apache-2.0
# Target docs: the manual pages of the public headers, as HTML. Not a part of normal builds.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
    set(doxygen_output ${PROJECT_BINARY_DIR}/docs)
    configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
    file(MAKE_DIRECTORY ${doxygen_output})
    add_custom_target(docs
        COMMAND ${DOXYGEN_EXECUTABLE} ${PROJECT_BINARY_DIR}/Doxyfile
        COMMAND ${CMAKE_COMMAND} -E echo "docs: ${doxygen_output}/html/index.html"
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
        VERBATIM)
endif()
