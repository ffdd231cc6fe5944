# What belongs to the program beside itself: manual pages, and the completion of verbs and options
# in bash.
install(FILES scripts/completion.bash DESTINATION
  ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME edgescout COMPONENT program)
find_program(HELP2MAN help2man)
if(NOT HELP2MAN)
  message(STATUS "Manual pages: left out, help2man is missing")
  return()
endif()
# Made when the program is installed: some twenty calls of it are too slow for every build.
set(man_dir ${PROJECT_BINARY_DIR}/man)
install(CODE "execute_process(COMMAND ${PROJECT_SOURCE_DIR}/scripts/man_pages.sh
  $<TARGET_FILE:edgescout_cli> ${man_dir} COMMAND_ERROR_IS_FATAL ANY)" COMPONENT program)
install(DIRECTORY ${man_dir}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
