# add_module(name SOURCES ... LINKS ... [PRIVATE_LINKS ...])
# One static library per folder. LINKS are the modules whose headers it may include; the test
# style.includes reads the same list.
function(add_module name)
  cmake_parse_arguments(M "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(flowslide_${name} STATIC ${M_SOURCES})
  add_library(flowslide::${name} ALIAS flowslide_${name})
  target_link_libraries(flowslide_${name} PUBLIC flowslide_options ${M_LINKS}
                        PRIVATE $<BUILD_INTERFACE:flowslide_warnings> ${M_PRIVATE_LINKS})
  compile_together(flowslide_${name})
endfunction()

# compile_together(target): its files 36 at a time, where FLOWSLIDE_UNITY says so: most of what one
# costs is reading headers (docs/adr/0019). style.names keeps their names apart, apart(file ...) keeps
# files out of it.
function(compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${FLOWSLIDE_UNITY} UNITY_BUILD_BATCH_SIZE 36)
endfunction()
function(apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# compile_fast(target ...): -O1 in place of -O3 for modules that read, write and tell, where nobody
# would notice what the last passes gain; the same bits.
function(compile_fast)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# unfused(target): g++ 12 fuses a b - c d and a b + c d side by side, as products of complex numbers
# have them, into one rounding even with -ffp-contract=off, where it packs them into a register
# (vfmaddsub); not so without that packing. For modules that hold such code and no loop that would
# miss it. The test bits.unfused finds them, for the instruction set that it is built for.
function(unfused target)
  if(FLOWSLIDE_SAME_BITS)
    target_compile_options(${target} PRIVATE -fno-tree-vectorize)
  endif()
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
  if(FLOWSLIDE_SANITIZE)
    target_compile_options(test_${name} PRIVATE -O0)  # instrumented assertions compile 2.4 times as fast
  endif()
  # Tests with the tag [bits] state what FLOWSLIDE_SAME_BITS promises.
  set(spec "~[.]")
  if(NOT FLOWSLIDE_SAME_BITS)
    set(spec "~[.]~[bits]")
  endif()
  catch_discover_tests(test_${name} TEST_SPEC "${spec}" TEST_PREFIX "${name}." PROPERTIES LABELS unit)
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
