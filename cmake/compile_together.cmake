# compile_together(TARGET ALONE_FILE...): with EDGESCOUT_UNITY several sources of TARGET are one to
# the compiler. The files named stay alone: their anonymous namespaces have names that other files
# of the target have, too.
# Each file costs its headers again. Two processors do best with one file a target; more of them
# need more files to be busy, and the memory of a large one once for each.
cmake_host_system_information(RESULT edgescout_processors QUERY NUMBER_OF_LOGICAL_CORES)
if(edgescout_processors GREATER 2)
  set(edgescout_sources_together 16)
else()
  set(edgescout_sources_together 0)  # all
endif()

function(compile_together target)
  if(EDGESCOUT_UNITY)
    set_target_properties(${target} PROPERTIES
      UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${edgescout_sources_together})
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    # A local name may be that of another file's constant. The preset dev warns of the rest.
    target_compile_options(${target} PRIVATE -Wno-shadow)
  endif()
endfunction()
