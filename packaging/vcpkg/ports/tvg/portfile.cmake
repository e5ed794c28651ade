# An overlay port: builds the tree that it lies in (--overlay-ports=packaging/vcpkg/ports).
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES encoder TVG_BUILD_ENCODER)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${features} -DTVG_BUILD_TESTS=OFF -DTVG_BUILD_TOOL=OFF -DTVG_BUILD_PLAYER=OFF
  # Known only where the encoding half is built.
  MAYBE_UNUSED_VARIABLES TVG_BUILD_TOOL TVG_BUILD_PLAYER
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/tvg)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
