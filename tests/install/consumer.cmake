# cmake -DBUILD=... -DSOURCE=... -DGENERATOR=... -P consumer.cmake
# Installs into a folder of its own, moves it, and builds and runs a program of others against it.
set(folder "${BUILD}/install-test")
file(REMOVE_RECURSE "${folder}")

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE out ERROR_VARIABLE out RESULT_VARIABLE failed)
  if(failed)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}\n${out}")
  endif()
  set(output "${out}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${folder}/first")
file(RENAME "${folder}/first" "${folder}/moved")
foreach(name bin/flowslide share/man/man1/flowslide.1 share/bash-completion/completions/flowslide
             share/zsh/site-functions/_flowslide share/doc/flowslide/LICENSE
             share/flowslide/workflows/mochikoshi.yaml include/flowslide/core/check.hpp)
  if(NOT EXISTS "${folder}/moved/${name}")
    message(FATAL_ERROR "${name} was not installed")
  endif()
endforeach()

# The examples find their data where they were installed.
file(GLOB workflows "${folder}/moved/share/flowslide/workflows/*.yaml")
foreach(workflow IN LISTS workflows)
  if(workflow MATCHES "-study")
    run("${folder}/moved/bin/flowslide" study run "${workflow}" --dry-run --out "${folder}/study")
    continue()
  endif()
  run("${folder}/moved/bin/flowslide" check "${workflow}")
  run("${folder}/moved/bin/flowslide" run "${workflow}" --dry-run --out "${folder}/run")
endforeach()

run(${CMAKE_COMMAND} -S "${SOURCE}/tests/install/consumer" -B "${folder}/consumer" -G "${GENERATOR}"
    -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_PREFIX_PATH=${folder}/moved")
run(${CMAKE_COMMAND} --build "${folder}/consumer")
run("${folder}/consumer/consumer" "${folder}/moved/share/flowslide/workflows/mochikoshi-static.yaml")
if(NOT output MATCHES "^peak 3 m/s2\n.*flow: mpm.run\n")
  message(FATAL_ERROR "the program that was built on the installed libraries says:\n${output}")
endif()
file(REMOVE_RECURSE "${folder}")
