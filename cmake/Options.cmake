# Compile options of every target of the project, as two interface targets.
add_library(flowslide_options INTERFACE)
target_include_directories(flowslide_options INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>" "$<INSTALL_INTERFACE:include/flowslide>")
# No -ffast-math: NaN means "unset" and results must not depend on reordering. These two only
# free the compiler from errno and floating-point exceptions, which nothing here reads.
target_compile_options(flowslide_options INTERFACE -fno-math-errno -fno-trapping-math)
target_compile_features(flowslide_options INTERFACE cxx_std_20)  # for those who link an installed module
# The same bits on every machine (docs/adr/0002): no fused multiply-add where the compiler happens
# to see one, and Eigen's sums neither in the width of a register nor in blocks that suit the cache.
# They are never dealt to threads, whose number may not matter anywhere.
target_compile_definitions(flowslide_options INTERFACE EIGEN_DONT_PARALLELIZE)
if(FLOWSLIDE_SAME_BITS)
  target_compile_options(flowslide_options INTERFACE -ffp-contract=off)
  target_compile_definitions(flowslide_options INTERFACE EIGEN_DONT_VECTORIZE EIGEN_NO_CPUID)
endif()
if(FLOWSLIDE_ARCH)
  target_compile_options(flowslide_options INTERFACE "-march=${FLOWSLIDE_ARCH}")
endif()
if(FLOWSLIDE_CONTRACTS)
  target_compile_definitions(flowslide_options INTERFACE FLOWSLIDE_CONTRACTS _GLIBCXX_ASSERTIONS)
endif()
if(FLOWSLIDE_SANITIZE)
  # The first finding ends the program: a test must not pass beside it.
  set(sanitize "-fsanitize=${FLOWSLIDE_SANITIZE}" -fno-sanitize-recover=all)
  target_compile_options(flowslide_options INTERFACE ${sanitize} -fno-omit-frame-pointer)
  target_link_options(flowslide_options INTERFACE ${sanitize})
endif()
if(FLOWSLIDE_FUZZ)
  target_compile_options(flowslide_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

add_library(flowslide_warnings INTERFACE)
target_compile_options(flowslide_warnings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # False positives of g++ 12 with fmt, Eigen and std::string.
  target_compile_options(flowslide_warnings INTERFACE
    -Wno-array-bounds -Wno-maybe-uninitialized -Wno-stringop-overflow -Wno-restrict)
  # Its AVX-512 intrinsics initialise what "undefined" stands for with itself (GCC bug 105593), which
  # is seen through Eigen, a system header, once it is inlined; clang's warning stays on.
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(flowslide_warnings INTERFACE -Wno-uninitialized)
  endif()
endif()
# Where files are compiled together clang takes what one calls for itself as shadowed by the next;
# `dev`, `race` and clang-tidy, file by file, keep the warning.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND FLOWSLIDE_UNITY)
  target_compile_options(flowslide_warnings INTERFACE -Wno-shadow)
endif()
# Without AVX-512 the vector of a node is wider than a register, which compilers have no common way
# to return; nothing but inlined functions does.
include(CheckCXXSourceCompiles)
if(FLOWSLIDE_ARCH)
  set(CMAKE_REQUIRED_FLAGS "-march=${FLOWSLIDE_ARCH}")
endif()
check_cxx_source_compiles("#ifndef __AVX512F__\n#error narrow\n#endif\nint main() {}" FLOWSLIDE_WIDE_REGISTERS)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT FLOWSLIDE_WIDE_REGISTERS)
  target_compile_options(flowslide_warnings INTERFACE -Wno-psabi)
endif()
if(FLOWSLIDE_WERROR)
  target_compile_options(flowslide_warnings INTERFACE -Werror)
endif()
