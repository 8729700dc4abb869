include(GNUInstallDirs)

if(NOT CMAKE_BUILD_TYPE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endif()

# Compile settings of every target. Contraction and fast-math change the last bit of coordinates
# from one instruction set to the next, and the same input must give the same bytes everywhere.
# Nobody reads errno: without it a square root or a rounding is one instruction, with the same bits.
add_library(marrow_options INTERFACE)
target_compile_features(marrow_options INTERFACE cxx_std_20)
target_compile_options(marrow_options INTERFACE
  -ffp-contract=off -fno-fast-math -fno-math-errno -Wall -Wextra -Wshadow -Wconversion
  $<$<BOOL:${MARROW_WERROR}>:-Werror>)
# Highway 1.0 does not compile for -march=native where the machine has this instruction set, and no
# kernel has a use for what it adds to AVX3.
target_compile_definitions(marrow_options INTERFACE HWY_DISABLED_TARGETS=HWY_AVX3_DL)
if(MARROW_SANITIZE)
  target_compile_options(marrow_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(marrow_options INTERFACE -fsanitize=address,undefined)
endif()
if(MARROW_FUZZ)
  target_compile_definitions(marrow_options INTERFACE _GLIBCXX_ASSERTIONS)
  # To trace every comparison was half the time of extract() and two thirds of that of STL, for no
  # more edges reached: memcmp() is still traced, and words come from a dictionary.
  target_compile_options(marrow_options INTERFACE
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined
    -fno-sanitize-coverage=trace-cmp -fno-omit-frame-pointer)
  target_link_options(marrow_options INTERFACE -fsanitize=address,undefined)
endif()

# Embree 3 or 4, target `embree`, for the folder that asks: both have the same name for the target.
macro(marrow_find_embree)
  find_package(embree 4 QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3 REQUIRED)
  endif()
endmacro()

# FILE_SET came with CMake 3.23; Ubuntu 22.04 has 3.22, where the headers are a folder.
set(marrow_has_file_sets OFF)
if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.23 AND NOT MARROW_WITHOUT_FILE_SETS)
  set(marrow_has_file_sets ON)
endif()

# marrow_library(NAME HEADERS... SOURCES...): one layer of the library, `marrow::NAME`.
function(marrow_library name)
  cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES" ${ARGN})
  add_library(marrow_${name} STATIC ${ARG_SOURCES})
  add_library(marrow::${name} ALIAS marrow_${name})
  set_target_properties(marrow_${name} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON MARROW_HEADERS "${ARG_HEADERS}")
  target_compile_features(marrow_${name} PUBLIC cxx_std_20)
  target_link_libraries(marrow_${name} PRIVATE $<BUILD_INTERFACE:marrow_options>)
  target_include_directories(marrow_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  if(marrow_has_file_sets)
    target_sources(marrow_${name} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${ARG_HEADERS})
  else()
    target_include_directories(marrow_${name} PUBLIC
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  endif()
endfunction()

# marrow_install_library(NAME): installs and exports the layer with its headers.
function(marrow_install_library name)
  if(marrow_has_file_sets)
    install(TARGETS marrow_${name} EXPORT marrowTargets FILE_SET HEADERS)
  else()
    install(TARGETS marrow_${name} EXPORT marrowTargets)
    get_property(headers TARGET marrow_${name} PROPERTY MARROW_HEADERS)
    list(TRANSFORM headers PREPEND ${PROJECT_SOURCE_DIR}/${name}/)
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/marrow)
  endif()
endfunction()
