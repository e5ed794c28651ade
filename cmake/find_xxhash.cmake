# xxHash is used from its header alone, which is copied into the build: TVG_XXHASH_FOLDER. The folder it lies in may
# hold the headers of another system than the one that is built for.
find_path(TVG_XXHASH_INCLUDE_DIR xxhash.h DOC "The folder of xxhash.h (xxHash 0.8 or later)")
if(NOT TVG_XXHASH_INCLUDE_DIR AND CMAKE_CROSSCOMPILING)
  find_path(TVG_XXHASH_INCLUDE_DIR xxhash.h PATHS /usr/include /usr/local/include NO_CMAKE_FIND_ROOT_PATH)
endif()
if(NOT TVG_XXHASH_INCLUDE_DIR)
  message(FATAL_ERROR "xxhash.h was not found. Install xxHash 0.8 or later (Debian: libxxhash-dev), or set "
    "TVG_XXHASH_INCLUDE_DIR to the folder it lies in.")
endif()
file(STRINGS ${TVG_XXHASH_INCLUDE_DIR}/xxhash.h tvg_xxhash_version REGEX "#define XXH_VERSION_(MAJOR|MINOR) ")
list(TRANSFORM tvg_xxhash_version REPLACE "[^0-9]+" "")
list(JOIN tvg_xxhash_version . tvg_xxhash_version)
if(tvg_xxhash_version VERSION_LESS 0.8)
  message(FATAL_ERROR "${TVG_XXHASH_INCLUDE_DIR}/xxhash.h is of version ${tvg_xxhash_version}: 0.8 or later is needed.")
endif()
set(TVG_XXHASH_FOLDER ${CMAKE_CURRENT_BINARY_DIR}/xxhash)
configure_file(${TVG_XXHASH_INCLUDE_DIR}/xxhash.h ${TVG_XXHASH_FOLDER}/xxhash.h COPYONLY)
