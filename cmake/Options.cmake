# Compile options of every target of the project, as two interface targets.
add_library(flowslide_options INTERFACE)
target_include_directories(flowslide_options INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>" "$<INSTALL_INTERFACE:include/flowslide>")
# No -ffast-math: NaN means "unset" and results must not depend on reordering. These two only
# free the compiler from errno and floating-point exceptions, which nothing here reads.
target_compile_options(flowslide_options INTERFACE -fno-math-errno -fno-trapping-math)
# Nobody replaces a function of a library at load time, so position-independent code may inline it.
target_compile_options(flowslide_options INTERFACE -fno-semantic-interposition)
target_compile_features(flowslide_options INTERFACE cxx_std_20)  # for those who link an installed module
if(FLOWSLIDE_ARCH)
  target_compile_options(flowslide_options INTERFACE "-march=${FLOWSLIDE_ARCH}")
endif()
if(FLOWSLIDE_CONTRACTS)
  target_compile_definitions(flowslide_options INTERFACE FLOWSLIDE_CONTRACTS _GLIBCXX_ASSERTIONS)
endif()
if(FLOWSLIDE_SANITIZE)
  target_compile_options(flowslide_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(flowslide_options INTERFACE -fsanitize=address,undefined)
endif()

add_library(flowslide_warnings INTERFACE)
target_compile_options(flowslide_warnings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
  # False positives of g++ 12 with fmt, Eigen and std::string.
  -Wno-array-bounds -Wno-maybe-uninitialized -Wno-stringop-overflow -Wno-restrict)
if(FLOWSLIDE_WERROR)
  target_compile_options(flowslide_warnings INTERFACE -Werror)
endif()
