# `cpack` in a build folder makes three Debian packages: tvg (the tool), libtvg0.2 (the shared library with the C interface)
# and libtvg-dev (headers, static libraries, CMake's and pkg-config's files).
set(TVG_PACKAGE_CONTACT "The TVG authors <tvg@localhost.localdomain>" CACHE STRING
  "Who answers for the packages that cpack makes: NAME <ADDRESS>")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tvg)
set(CPACK_PACKAGE_VENDOR "The TVG authors")
set(CPACK_PACKAGE_CONTACT "${TVG_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "codec for animated meshes")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL tool runtime library)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(soname_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_TOOL_PACKAGE_NAME tvg)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOL_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOL_DESCRIPTION "Compresses, inspects, restores, plays and serves time-variant geometry:
vertex caches, sequences of mesh files and scenes become .tvg streams that
play while they arrive and decode bit for bit the same everywhere.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libtvg${soname_version})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/debian/triggers)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "The C interface of TVG: encodes and decodes .tvg streams of time-variant
geometry from memory.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libtvg-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "libtvg${soname_version} (= ${PROJECT_VERSION}), libopenmesh-dev (>= 9.0), libzstd-dev (>= 1.5)")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "Headers, static libraries and the files by which CMake and pkg-config find
TVG.")

# Policy wants a licence, as its own format has it, and a changelog with every package.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX REPLACE "^.*(Permission is hereby.*[^\n])\n*$" "\\1" licence "${licence}")  # less title and holder
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " tvg_licence_text " ${licence}")
configure_file(${CMAKE_CURRENT_LIST_DIR}/debian/copyright.in ${PROJECT_BINARY_DIR}/debian/copyright @ONLY)
configure_file(${CMAKE_CURRENT_LIST_DIR}/debian/changelog.in ${PROJECT_BINARY_DIR}/debian/changelog @ONLY)
find_program(TVG_GZIP gzip)
if(TVG_GZIP)
  execute_process(COMMAND ${TVG_GZIP} -9nc ${PROJECT_BINARY_DIR}/debian/changelog
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/debian/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
  foreach(component TOOL RUNTIME LIBRARY)
    string(TOLOWER ${component} name)
    install(FILES ${PROJECT_BINARY_DIR}/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
      DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${component}_PACKAGE_NAME} COMPONENT ${name})
  endforeach()
endif()
# CPack calls ldconfig from scripts too, which the trigger has made needless.
file(WRITE ${PROJECT_BINARY_DIR}/debian/overrides "${CPACK_DEBIAN_RUNTIME_PACKAGE_NAME}: maintscript-calls-ldconfig\n")
install(FILES ${PROJECT_BINARY_DIR}/debian/overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
  RENAME ${CPACK_DEBIAN_RUNTIME_PACKAGE_NAME} COMPONENT runtime)
include(CPack)
