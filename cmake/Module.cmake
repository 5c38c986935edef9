# Headers that nearly every file reads, read once. Off in the presets that look for faults: there a
# file has to name what it uses.
option(FLOWSLIDE_PCH "Precompile the headers of the standard library, fmt, Eigen and Catch2" OFF)
set(flowslide_common_headers
  <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional>
  <set> <span> <sstream> <string> <variant> <vector> <fmt/format.h>)

# share_headers(target libraries kind HEADERS...): gives the target the common headers and HEADERS,
# precompiled once for all of a kind (module, test) with and without OpenMP.
function(share_headers target libraries kind)
  if(NOT FLOWSLIDE_PCH)
    return()
  endif()
  set(owner flowslide_headers_${kind})
  set(headers ${flowslide_common_headers} ${ARGN})
  if("OpenMP::OpenMP_CXX" IN_LIST libraries)
    string(APPEND owner _openmp)
    list(APPEND headers <Eigen/Core>)
  endif()
  if(NOT TARGET ${owner})
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/${owner}.cpp" CONTENT "")
    add_library(${owner} OBJECT "${PROJECT_BINARY_DIR}/${owner}.cpp")
    target_link_libraries(${owner} PRIVATE flowslide_options flowslide_warnings fmt::fmt Eigen3::Eigen)
    if(owner MATCHES openmp)
      target_link_libraries(${owner} PRIVATE OpenMP::OpenMP_CXX)
    endif()
    if(kind STREQUAL "test")  # part of an executable
      set_target_properties(${owner} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${owner} PRIVATE -fPIE)
    endif()
    target_precompile_headers(${owner} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

# Nothing in these, in commands and in tests runs per point, element or row of a file: half the
# optimisation saves a quarter of the time of compiling them.
set(flowslide_seldom_run "^(config|report|workflows|verify_.*|.*_verify)$")
function(optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# add_module(name SOURCES ... LINKS ... [PRIVATE_LINKS ...])
# One static library per folder. LINKS are the modules whose headers it may include; the test
# style.includes reads the same list.
function(add_module name)
  cmake_parse_arguments(M "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(flowslide_${name} STATIC ${M_SOURCES})
  add_library(flowslide::${name} ALIAS flowslide_${name})
  target_link_libraries(flowslide_${name} PUBLIC flowslide_options ${M_LINKS}
                        PRIVATE $<BUILD_INTERFACE:flowslide_warnings> ${M_PRIVATE_LINKS})
  if(name MATCHES "${flowslide_seldom_run}")
    optimise_less(flowslide_${name})
  endif()
  share_headers(flowslide_${name} "${M_PRIVATE_LINKS}" module)
endfunction()

# add_rooms(name room ...)
# The rooms of a large module, lower ones first: each is a module name_room in the folder name/room.
# flowslide::name stands for all of them.
function(add_rooms name)
  add_library(flowslide_${name} INTERFACE)
  add_library(flowslide::${name} ALIAS flowslide_${name})
  foreach(room IN LISTS ARGN)
    add_subdirectory(${room})
    target_link_libraries(flowslide_${name} INTERFACE flowslide::${name}_${room})
  endforeach()
endfunction()

# add_module_tests(name SOURCES a.test.cpp ... [LINKS ...])
# Sources are relative to tests/<name>/; one executable per module.
function(add_module_tests name)
  if(NOT FLOWSLIDE_TESTS)
    return()
  endif()
  cmake_parse_arguments(T "" "" "SOURCES;LINKS" ${ARGN})
  list(TRANSFORM T_SOURCES PREPEND "${PROJECT_SOURCE_DIR}/tests/${name}/")
  add_executable(test_${name} ${T_SOURCES})
  target_link_libraries(test_${name} PRIVATE flowslide::${name} ${T_LINKS} flowslide_warnings flowslide_catch_main)
  optimise_less(test_${name})
  share_headers(test_${name} "${T_LINKS}" test <catch2/catch.hpp>)
  catch_discover_tests(test_${name} TEST_PREFIX "${name}." PROPERTIES LABELS unit)
endfunction()

if(FLOWSLIDE_TESTS)
  find_package(Catch2 2.13 REQUIRED)
  include(Catch)
  add_library(flowslide_catch_main STATIC "${PROJECT_SOURCE_DIR}/tests/support/catch_main.cpp"
              "${PROJECT_SOURCE_DIR}/tests/support/paths.cpp")
  set_source_files_properties("${PROJECT_SOURCE_DIR}/tests/support/paths.cpp" PROPERTIES
    COMPILE_DEFINITIONS FLOWSLIDE_SOURCE="${PROJECT_SOURCE_DIR}")
  target_include_directories(flowslide_catch_main PUBLIC "${PROJECT_SOURCE_DIR}")
  target_link_libraries(flowslide_catch_main PUBLIC Catch2::Catch2)
endif()
