# commit_header(TARGET PATH...): TARGET may include "commit.h", which defines EDGESCOUT_COMMIT: the
# commit it was built from, "+changes" where files under the paths differ from it.
function(commit_header target)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/generated/commit.h)
  add_custom_target(${target}_commit
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${header} "-DPATHS=${ARGN}"
    -P ${PROJECT_SOURCE_DIR}/cmake/commit.cmake
    BYPRODUCTS ${header} VERBATIM)
  add_dependencies(${target} ${target}_commit)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated)
endfunction()
