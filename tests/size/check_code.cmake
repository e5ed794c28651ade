# cmake -DLIBRARY=libtvg.so -DBUDGET=BYTES -DSIZE_PROGRAM=size -P check_code.cmake: fails where the library's code and
# constants (.text and .rodata) are larger. Tables for unwinding, which the decoder never does, are not counted.
execute_process(COMMAND ${SIZE_PROGRAM} -A ${LIBRARY} OUTPUT_VARIABLE table COMMAND_ERROR_IS_FATAL ANY)
set(bytes 0)
foreach(section text rodata)
  string(REGEX MATCH "\n\\.${section} +([0-9]+)" line "${table}")
  math(EXPR bytes "${bytes} + ${CMAKE_MATCH_1}")
endforeach()
message("${LIBRARY}: ${bytes} bytes of code and constants; the budget is ${BUDGET}")
if(bytes GREATER BUDGET)
  message(FATAL_ERROR "above the budget")
endif()
