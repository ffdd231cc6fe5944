# Target `docs`: pages of the C++ API by Doxygen, in docs/html below the build folder. They cover
# the headers of EDGESCOUT_PUBLIC_HEADERS (cmake/public_headers.cmake), or all of host/ where that
# variable is not set. A warning of Doxygen fails the target.
option(EDGESCOUT_DOCS_STRICT "Warnings of Doxygen are errors" ON)

find_program(EDGESCOUT_DOXYGEN doxygen)
find_package(Python3 QUIET COMPONENTS Interpreter)
if(NOT EDGESCOUT_DOXYGEN OR NOT Python3_FOUND)
  message(STATUS "Target docs: left out, Doxygen or Python 3 is missing (scripts/setup.sh --dev)")
  return()
endif()

include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake OPTIONAL)
if(EDGESCOUT_PUBLIC_HEADERS)
  set(doxygen_headers ${EDGESCOUT_PUBLIC_HEADERS})
else()
  file(GLOB_RECURSE doxygen_headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} host/*.h)
endif()
# The list holds paths from the root of the repository.
set(doxygen_input "\"${PROJECT_SOURCE_DIR}/docs/cpp_api.md\"")
if(NOT EXISTS ${PROJECT_SOURCE_DIR}/docs/cpp_api.md)
  set(doxygen_input "")
endif()
set(doxygen_depends)
foreach(header ${doxygen_headers})
  cmake_path(ABSOLUTE_PATH header BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
  string(APPEND doxygen_input " \\\n    \"${header}\"")
  list(APPEND doxygen_depends ${header})
endforeach()
set(doxygen_output ${PROJECT_BINARY_DIR}/docs)
set(doxygen_warn_as_error NO)
if(EDGESCOUT_DOCS_STRICT)
  set(doxygen_warn_as_error FAIL_ON_WARNINGS)
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in ${doxygen_output}/Doxyfile @ONLY)
add_custom_target(docs
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${doxygen_output}/html
  COMMAND ${EDGESCOUT_DOXYGEN} ${doxygen_output}/Doxyfile
  DEPENDS ${doxygen_depends}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
  COMMENT "Pages of the C++ API: ${doxygen_output}/html/index.html"
  VERBATIM)
