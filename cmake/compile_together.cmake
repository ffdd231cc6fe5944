# compile_together(TARGET ALONE_FILE...): with EDGESCOUT_UNITY several sources of TARGET are one to
# the compiler. The files named stay alone: their anonymous namespaces have names that other files
# of the target have, too.
function(compile_together target)
  if(EDGESCOUT_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()
