# cmake -DPROGRAM=tvg_digest -DEMULATOR=... -DFOLDER=corpus/conformance -P check_digests.cmake: fails unless the program
# prints FOLDER/digests.txt for the streams named there.
file(READ ${FOLDER}/digests.txt expected)
string(REGEX MATCHALL "(^|\n)[a-z][a-z0-9_]* " names "${expected}")
list(TRANSFORM names STRIP)
list(TRANSFORM names APPEND .tvg)
execute_process(COMMAND ${EMULATOR} ${PROGRAM} ${names} WORKING_DIRECTORY ${FOLDER}
  RESULT_VARIABLE status OUTPUT_VARIABLE printed ERROR_VARIABLE errors)
string(REPLACE "\r" "" printed "${printed}")
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} failed (${status}):\n${errors}")
endif()
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "${PROGRAM} printed\n${printed}\ninstead of\n${expected}")
endif()
