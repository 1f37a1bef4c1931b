# What `cmake --install` puts where, so that find_package(airlight) works. In src/ a header is included as
# "render/render.h", by others as <airlight/render/render.h>: the rooms lie beside the core's headers.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/airlight)

install(DIRECTORY include/airlight DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")

# The rooms' faces, and what these include; the rest of src/ is nobody else's.
set(public_headers
  error.h
  image/atomic_file.h
  image/image.h
  image/input.h
  image/metrics.h
  image/mix.h
  image/output.h
  image/picture.h
  image/srgb.h
  image/texture.h
  image/tone_map.h
  scene/document.h
  scene/load_scene.h
  scene/render_settings.h
  scene/room_behind.h
  scene/scene.h
  render/checkpoint.h
  render/checkpoint_plan.h
  render/fair_mutex.h
  render/film.h
  render/film_layout.h
  render/holdout_sums.h
  render/path_count.h
  render/probe.h
  render/render.h
  render/traits.h
  render/version.h
  render/zeroed_memory.h
)
foreach(header IN LISTS public_headers)
  cmake_path(GET header PARENT_PATH room)
  install(FILES src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/airlight/${room})
endforeach()

install(TARGETS airlight_core EXPORT airlight-core-targets)
install(TARGETS airlight EXPORT airlight-targets)
install(EXPORT airlight-core-targets NAMESPACE airlight:: DESTINATION ${package_dir})
install(EXPORT airlight-targets NAMESPACE airlight:: DESTINATION ${package_dir})

list(TRANSFORM AIRLIGHT_PACKAGES REPLACE "(.+)" "\"\\1\"" OUTPUT_VARIABLE quoted_packages)
list(JOIN quoted_packages " " quoted_packages)
configure_package_config_file(cmake/airlight-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/airlight-config.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/airlight-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/airlight-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/airlight-config-version.cmake
  DESTINATION ${package_dir})
