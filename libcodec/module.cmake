# tvg.wasm: a module for pages and for Node that needs no script of Emscripten's: it imports next to nothing, opens no
# files and starts no threads; memory grows as streams need it. web/ has what runs it.
#
# Its vectors are those of WebAssembly (-msimd128), which the models and lanes use through the names of SSE2; browsers
# that have them have the other extensions too.
# Emscripten has nothing inlined with -Oz and -Os, -finline-functions takes that back: every sum of lanes would be a call.
# Nothing else is made into vectors: what clang 14 makes of the pyramid's loops for -Os decodes wrongly.
set(tvg_module_options -msimd128 -msse2 -msign-ext -mnontrapping-fptoint -mbulk-memory -flto
  -finline-functions -fno-vectorize -fno-slp-vectorize)
# The linker optimizes once more, and has its own idea of vectors; one wide and one at a time is none.
set(tvg_module_link_options -flto -msimd128 -Wl,-mllvm,-force-vector-width=1,-mllvm,-force-vector-interleave=1)

# Loops of mode basis, which -Oz makes half as fast. With all that decodes frames, the module would be a quarter faster
# and 10,000 bytes larger, gzipped.
set_source_files_properties(basis/basis_sums.cpp basis/pair_sums.cpp PROPERTIES COMPILE_OPTIONS -O2)

add_executable(tvg_wasm ${tvg_c_sources})
target_link_libraries(tvg_wasm PRIVATE ${tvg_c_stands_on})
target_include_directories(tvg_wasm PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_options(tvg_wasm PRIVATE --no-entry -sSTANDALONE_WASM=1 -sALLOW_MEMORY_GROWTH=1 -sFILESYSTEM=0
  -sMALLOC=emmalloc -sEXPORTED_FUNCTIONS=_malloc,_free)
set_target_properties(tvg_wasm PROPERTIES OUTPUT_NAME tvg SUFFIX .wasm)
tvg_compile_options(tvg_wasm)
# Types at run time serve exceptions only, of which the module has none.
target_compile_options(tvg_wasm PRIVATE ${tvg_module_options} -fno-rtti -ffunction-sections -fdata-sections)
target_compile_options(tvg_decoder PRIVATE ${tvg_module_options})
target_link_options(tvg_decoder INTERFACE "$<BUILD_INTERFACE:${tvg_module_link_options}>")
