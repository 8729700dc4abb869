include(GNUInstallDirs)

if(NOT CMAKE_BUILD_TYPE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endif()

# Compile settings of every target. Contraction and fast-math change the last bit of coordinates
# from one instruction set to the next, and the same input must give the same bytes everywhere.
add_library(marrow_options INTERFACE)
target_compile_features(marrow_options INTERFACE cxx_std_20)
target_compile_options(marrow_options INTERFACE
  -ffp-contract=off -fno-fast-math -Wall -Wextra -Wshadow -Wconversion
  $<$<BOOL:${MARROW_WERROR}>:-Werror>)
if(MARROW_SANITIZE)
  target_compile_options(marrow_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(marrow_options INTERFACE -fsanitize=address,undefined)
endif()

# marrow_library(NAME HEADERS... SOURCES...): one layer of the library, `marrow::NAME`.
function(marrow_library name)
  cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES" ${ARGN})
  add_library(marrow_${name} STATIC ${ARG_SOURCES})
  add_library(marrow::${name} ALIAS marrow_${name})
  set_target_properties(marrow_${name} PROPERTIES EXPORT_NAME ${name})
  set_target_properties(marrow_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_features(marrow_${name} PUBLIC cxx_std_20)
  target_link_libraries(marrow_${name} PRIVATE $<BUILD_INTERFACE:marrow_options>)
  target_sources(marrow_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS include FILES ${ARG_HEADERS})
  target_include_directories(marrow_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()
