# Writes OUTPUT, a header with the commit of SOURCE, when it changed. Where files under PATHS differ
# from it, "+changes" and a mark of how: results of two such states are not of one program. Without
# git a mark of the files alone, "sources-..". Run at every build: the configure step's answer would
# be stale.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE
                failed)
if(failed)
  # No repository, or none that git would read: a mark of the sources in its place.
  set(marks "")
  foreach(path IN LISTS PATHS)
    file(GLOB_RECURSE files LIST_DIRECTORIES false RELATIVE ${SOURCE} ${SOURCE}/${path}/*)
    foreach(file IN LISTS files)
      file(SHA1 ${SOURCE}/${file} mark)
      string(APPEND marks "${file} ${mark}\n")
    endforeach()
  endforeach()
  string(SHA1 mark "${marks}")
  string(SUBSTRING ${mark} 0 12 mark)
  set(commit "sources-${mark}")
else()
  execute_process(COMMAND git -C ${SOURCE} diff HEAD -- ${PATHS} OUTPUT_VARIABLE changes
    ERROR_QUIET)
  execute_process(COMMAND git -C ${SOURCE} ls-files --others --exclude-standard -- ${PATHS}
                  OUTPUT_VARIABLE untracked OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(REPLACE "\n" ";" untracked "${untracked}")
  foreach(file IN LISTS untracked)
    file(SHA1 ${SOURCE}/${file} mark)
    string(APPEND changes "${file} ${mark}\n")
  endforeach()
  if(changes)
    string(SHA1 mark "${changes}")
    string(SUBSTRING ${mark} 0 8 mark)
    string(APPEND commit "+changes-${mark}")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define EDGESCOUT_COMMIT \"${commit}\"\n")
