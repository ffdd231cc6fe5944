# edgescout_layer(NAME SOURCES FILE... [USES LAYER...] [LINKS TARGET...])
#
# One folder group of the host as an object library edgescout_NAME. It may include headers of the
# layers it names after USES and of the kernels, nothing else of the host: configuring fails where a
# file of it includes another layer. Layers can only use layers declared before, so there is no
# cycle.
function(edgescout_layer name)
  cmake_parse_arguments(layer "" "" "SOURCES;USES;LINKS" ${ARGN})
  foreach(used IN LISTS layer_USES)
    if(NOT TARGET edgescout_${used})
      message(FATAL_ERROR "layer ${name} uses ${used}, which is not declared before it")
    endif()
  endforeach()
  file(GLOB headers CONFIGURE_DEPENDS ${name}/*.h)
  if(name STREQUAL "pipeline")
    file(GLOB headers CONFIGURE_DEPENDS *.h)
  endif()
  foreach(file IN LISTS headers layer_SOURCES)
    edgescout_check_includes(${name} "${file}" "${layer_USES}")
  endforeach()
  add_library(edgescout_${name} OBJECT ${layer_SOURCES})
  target_include_directories(edgescout_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  list(TRANSFORM layer_USES PREPEND edgescout_ OUTPUT_VARIABLE used_targets)
  target_link_libraries(edgescout_${name}
    PUBLIC Eigen3::Eigen Threads::Threads edgescout_kernel_headers ${used_targets}
    PRIVATE ${layer_LINKS})
endfunction()

# "host/io/mesh.h" belongs to the layer io, "host/pipeline.h" to the layer pipeline.
function(edgescout_check_includes name file uses)
  get_filename_component(path ${file} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(STRINGS ${path} includes REGEX "^#include \"host/")
  foreach(include IN LISTS includes)
    if(include MATCHES "\"host/([a-z0-9_]+)/")
      set(layer ${CMAKE_MATCH_1})
    else()
      set(layer pipeline)
    endif()
    if(NOT layer STREQUAL name AND NOT layer IN_LIST uses)
      file(RELATIVE_PATH shown ${PROJECT_SOURCE_DIR} ${path})
      message(FATAL_ERROR
        "${shown} includes the layer ${layer}; the layer ${name} may use: ${uses}")
    endif()
  endforeach()
endfunction()
