# The C interface, tvg.h: libtvg.so, which exports nothing else; libtvg.a with BUILD_SHARED_LIBS=OFF and where nothing
# is shared; a WebAssembly module beside it with Emscripten.
set(tvg_c_sources c_api/decoder.cpp c_api/decoder_properties.cpp)
if(TVG_BUILD_ENCODER)
  list(APPEND tvg_c_sources c_api/encoder.cpp c_api/encoder_properties.cpp c_api/measure.cpp c_api/unpack.cpp)
else()
  list(APPEND tvg_c_sources c_api/unpack_stored.cpp)
endif()

get_property(tvg_can_share GLOBAL PROPERTY TARGET_SUPPORTS_SHARED_LIBS)
if(NOT tvg_can_share)
  set(tvg_c_kind STATIC)
elseif(DEFINED BUILD_SHARED_LIBS AND NOT BUILD_SHARED_LIBS)
  set(tvg_c_kind STATIC)
else()
  set(tvg_c_kind SHARED)
endif()

add_library(tvg_c ${tvg_c_kind} ${tvg_c_sources})
add_library(tvg::tvg ALIAS tvg_c)
target_include_directories(tvg_c
  PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
  PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
set_target_properties(tvg_c PROPERTIES OUTPUT_NAME tvg EXPORT_NAME tvg
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
tvg_compile_options(tvg_c)
tvg_hide_symbols(tvg_c)

if(TVG_BUILD_ENCODER)
  set(tvg_c_stands_on tvg_encoder)
else()
  set(tvg_c_stands_on tvg_decoder)
  target_compile_definitions(tvg_c PUBLIC TVG_DECODE_ONLY)
endif()

if(tvg_c_kind STREQUAL SHARED)
  target_compile_definitions(tvg_c PRIVATE TVG_BUILDS_LIBRARY)
  target_link_libraries(tvg_c PRIVATE $<BUILD_INTERFACE:${tvg_c_stands_on}>)
  # Hidden visibility does most of it; the script keeps back what the standard library's templates would export.
  include(CheckLinkerFlag)
  set(tvg_symbols ${CMAKE_CURRENT_SOURCE_DIR}/exported_symbols.map)
  if(UNIX AND NOT APPLE)
    check_linker_flag(CXX -Wl,--version-script=${tvg_symbols} TVG_HAS_VERSION_SCRIPT)
  endif()
  check_linker_flag(CXX -Wl,--gc-sections TVG_HAS_GC_SECTIONS)
  if(TVG_HAS_GC_SECTIONS)
    target_link_options(tvg_c PRIVATE -Wl,--gc-sections)
  endif()
  if(TVG_HAS_VERSION_SCRIPT)
    target_link_options(tvg_c PRIVATE -Wl,--version-script=${tvg_symbols})
    set_target_properties(tvg_c PROPERTIES LINK_DEPENDS ${tvg_symbols})
  endif()
else()
  target_compile_definitions(tvg_c PUBLIC TVG_STATIC)
  target_link_libraries(tvg_c PUBLIC ${tvg_c_stands_on})
endif()

# tvg.wasm: a module for pages and for Node that needs no script of Emscripten's: it imports next to nothing, opens no
# files and starts no threads; memory grows as streams need it. web/ has what runs it.
if(EMSCRIPTEN)
  add_executable(tvg_wasm ${tvg_c_sources})
  target_link_libraries(tvg_wasm PRIVATE ${tvg_c_stands_on})
  target_include_directories(tvg_wasm PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_options(tvg_wasm PRIVATE --no-entry -sSTANDALONE_WASM=1 -sALLOW_MEMORY_GROWTH=1 -sFILESYSTEM=0
    -sMALLOC=emmalloc -sEXPORTED_FUNCTIONS=_malloc,_free)
  set_target_properties(tvg_wasm PROPERTIES OUTPUT_NAME tvg SUFFIX .wasm)
  tvg_compile_options(tvg_wasm)
endif()
