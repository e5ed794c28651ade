# Options every target of the project is compiled with: tvg_compile_options(TARGET).

function(tvg_compile_options target)
  # No contraction to fused multiply-add: decoded values are the same on every machine (design promise 1).
  # gcc's vectorizer fuses multiply-adds all the same where the target has them: the second option keeps it from that.
  # -Wconversion means the same for both compilers only without clang's -Wsign-conversion.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wno-sign-conversion -Wshadow -ffp-contract=off
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
  if(TVG_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

if(TVG_SANITIZE)
  add_compile_options(-fsanitize=${TVG_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  add_link_options(-fsanitize=${TVG_SANITIZE})
endif()
if(TVG_BUILD_FUZZERS)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
