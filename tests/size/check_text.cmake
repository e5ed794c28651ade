# cmake -DARCHIVE=... -DTEXT=BYTES -DSIZE_PROGRAM=size -P check_text.cmake: fails where code and constants of all the
# archive's objects together are larger.
execute_process(COMMAND ${SIZE_PROGRAM} -t ${ARCHIVE} OUTPUT_VARIABLE table COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "\n *([0-9]+)[^\n]*\\(TOTALS\\)" total "${table}")
set(bytes ${CMAKE_MATCH_1})
message("${table}\n${bytes} bytes of text; the budget is ${TEXT}")
if(NOT bytes OR bytes GREATER TEXT)
  message(FATAL_ERROR "above the budget")
endif()
