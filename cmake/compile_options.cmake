# Options every target of the project is compiled with: tvg_compile_options(TARGET).
include(CheckCXXSourceCompiles)

# No contraction to fused multiply-add and no excess precision: decoded values are the same on every machine.
if(MSVC)
  set(tvg_same_everywhere /fp:strict)
else()
  # gcc's vectorizer fuses multiply-adds all the same where the target has them: the second option keeps it from that.
  set(tvg_same_everywhere -ffp-contract=off $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
  # The x87 unit of 32-bit x86 computes with 80 bits.
  check_cxx_source_compiles("#include <cfloat>\nstatic_assert(FLT_EVAL_METHOD == 0);\nint main() {}"
    TVG_DOUBLES_ARE_DOUBLES)
  if(NOT TVG_DOUBLES_ARE_DOUBLES)
    list(APPEND tvg_same_everywhere -msse2 -mfpmath=sse)
  endif()
endif()

function(tvg_compile_options target)
  set_property(GLOBAL APPEND PROPERTY TVG_TARGETS ${target})
  target_compile_options(${target} PRIVATE ${tvg_same_everywhere})
  if(MSVC)
    target_compile_options(${target} PRIVATE /W4 /utf-8)
  else()
    # -Wconversion means the same for both compilers only without clang's -Wsign-conversion.
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wno-sign-conversion -Wshadow)
    # gcc takes the namespaces without a name of sources that are compiled together for those of a header.
    if(TVG_UNITY)
      target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
    endif()
  endif()
  if(TVG_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE $<IF:$<BOOL:${MSVC}>,/WX,-Werror>)
  endif()
endfunction()

# Nothing is seen outside the library it is linked into but what tvg.h marks with TVG_API.
function(tvg_hide_symbols target)
  set_target_properties(${target} PROPERTIES C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# The decoder throws nothing and asks for no types at run time; what a program does not use of it can be left out when
# it is linked.
function(tvg_without_exceptions target)
  if(MSVC)
    target_compile_definitions(${target} PRIVATE _HAS_EXCEPTIONS=0)
    target_compile_options(${target} PRIVATE /GR-)
  else()
    target_compile_options(${target} PRIVATE -fno-exceptions -ffunction-sections -fdata-sections)
    # A sanitizer that checks types at run time takes objects made without them for broken ones, where another part of
    # the program has types.
    if(NOT TVG_SANITIZE)
      target_compile_options(${target} PRIVATE -fno-rtti)
    endif()
  endif()
endfunction()

if(TVG_SANITIZE)
  add_compile_options(-fsanitize=${TVG_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${TVG_SANITIZE})
endif()
if(TVG_BUILD_FUZZERS)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
