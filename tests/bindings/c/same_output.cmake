# Runs the commands FIRST and SECOND, which must print the same; the text PART must be in it.
foreach(name FIRST SECOND)
  execute_process(COMMAND ${${name}} OUTPUT_VARIABLE output_of_${name} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(NOT output_of_FIRST STREQUAL output_of_SECOND)
  message(FATAL_ERROR
    "${FIRST} and ${SECOND} print different results:\n${output_of_FIRST}\n${output_of_SECOND}")
endif()
if(NOT output_of_FIRST MATCHES "${PART}")
  message(FATAL_ERROR "no ${PART} in\n${output_of_FIRST}")
endif()
