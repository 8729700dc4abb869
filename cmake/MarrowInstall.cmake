# What `cmake --install` puts in place, and the files that find_package(marrow) reads.
include(CMakePackageConfigHelpers)

set(marrow_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/marrow)

foreach(layer IN ITEMS engine raster skeleton)
  marrow_install_library(${layer})
endforeach()
install(TARGETS marrow_all EXPORT marrowTargets)
install(EXPORT marrowTargets NAMESPACE marrow:: DESTINATION ${marrow_cmake_dir})

marrow_find_embree()   # for its version
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/marrowConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/marrowConfig.cmake
  INSTALL_DESTINATION ${marrow_cmake_dir})
# Before 1.0 every minor version may change the interface.
write_basic_package_version_file(
  ${CMAKE_CURRENT_BINARY_DIR}/marrowConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES
    ${CMAKE_CURRENT_BINARY_DIR}/marrowConfig.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/marrowConfigVersion.cmake
    ${CMAKE_CURRENT_LIST_DIR}/Findhwy.cmake
  DESTINATION ${marrow_cmake_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(TARGET marrow_program)
  install(TARGETS marrow_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET marrow_import)
  install(TARGETS marrow_import RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
