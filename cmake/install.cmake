# What `cmake --install` writes: the libraries and their headers, a CMake package (find_package(tvg), targets
# tvg::tvg with the C interface, tvg::decoder and tvg::encoder) and pkg-config files (tvg, tvg-decoder, tvg-encoder);
# the encoding half only where it is built.
include(CMakePackageConfigHelpers)

set(tvg_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tvg)

set(tvg_installed tvg_c tvg_decoder)
set(tvg_packages tvg tvg-decoder)
if(TVG_BUILD_ENCODER)
  list(APPEND tvg_installed tvg_encoder)
  list(APPEND tvg_packages tvg-encoder)
endif()
install(TARGETS ${tvg_installed} EXPORT tvg_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT library
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/libcodec/include/tvg DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT library)
install(EXPORT tvg_targets FILE tvgTargets.cmake NAMESPACE tvg:: DESTINATION ${tvg_package_folder}
  COMPONENT library)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tvgConfig.cmake.in ${PROJECT_BINARY_DIR}/tvgConfig.cmake
  INSTALL_DESTINATION ${tvg_package_folder})
# Before 1.0 a minor version may break its users.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tvgConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tvgConfig.cmake ${PROJECT_BINARY_DIR}/tvgConfigVersion.cmake
  DESTINATION ${tvg_package_folder} COMPONENT library)

# The prefix is written relative to the .pc file, so that an installed tree can be moved.
file(RELATIVE_PATH tvg_pc_to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
# What who links the C interface must know beside its name.
get_target_property(tvg_c_definitions tvg_c INTERFACE_COMPILE_DEFINITIONS)
set(tvg_pc_cflags "")
foreach(definition IN LISTS tvg_c_definitions)
  if(definition)
    string(APPEND tvg_pc_cflags " -D${definition}")
  endif()
endforeach()
set(tvg_pc_requires "")
if(tvg_c_kind STREQUAL STATIC)
  list(GET tvg_packages -1 tvg_pc_requires)
  string(APPEND tvg_pc_requires " = ${PROJECT_VERSION}")
endif()
foreach(package IN LISTS tvg_packages)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${package}.pc.in ${PROJECT_BINARY_DIR}/${package}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${package}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
    COMPONENT library)
endforeach()
