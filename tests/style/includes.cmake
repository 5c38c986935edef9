# cmake -DROOT=<source folder> -P includes.cmake
# Fails on an include of a module that is not in the LINKS of the folder's add_module(), and on a
# library that is used outside its place.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/modules.cmake")

# Pattern of an include; pattern of the files that may have it; the rule in words.
set(rules
    "^yaml-cpp/" "^config/yaml[a-z_]*[.]cpp$" "config/yaml*.cpp"
    "^(hdf5|H5[A-Za-z]*)[.]h$" "^model/" "model/"
    "^vtk" "^model/vtk_library[.]cpp$" "model/vtk_library.cpp"
    "^CLI/" "^cli/" "cli/"
    "^nlohmann/" "[.]cpp$|^workflows/engine/sealed_json[.]hpp$" ".cpp files and sealed_json.hpp, which only they include"
    "^openssl/" "^core/" "core/"
    "^omp[.]h$" "^(fem|transfer|mpm|verify|bench)/" "fem/, transfer/, mpm/, verify/ and bench/")

set(faults 0)
macro(report why)
  message("${file}:${line}: '${include}' (${why})")
  math(EXPR faults "${faults} + 1")
endmacro()

foreach(module IN LISTS modules)
  set(folder "${ROOT}/${folder_${module}}")
  file(GLOB_RECURSE files RELATIVE "${ROOT}" "${folder}/*.hpp" "${folder}/*.cpp")
  foreach(file IN LISTS files)
    module_of("${file}" owner)
    if(NOT owner STREQUAL module)
      continue()
    endif()
    file(STRINGS "${ROOT}/${file}" text REGEX "^[ \t]*#[ \t]*include")
    foreach(found IN LISTS text)
      if(NOT found MATCHES "[<\"]([^>\"]+)[>\"]")
        continue()
      endif()
      set(include "${CMAKE_MATCH_1}")
      # The line number is only needed for a message, but costs little.
      file(READ "${ROOT}/${file}" whole)
      string(FIND "${whole}" "${found}" at)
      string(SUBSTRING "${whole}" 0 ${at} before)
      string(REGEX MATCHALL "\n" newlines "${before}")
      list(LENGTH newlines line)
      math(EXPR line "${line} + 1")

      module_of("${include}" top)
      if(top STREQUAL "tests")
        report("tests are seen by nothing")
      elseif(top IN_LIST modules AND NOT top IN_LIST links_${module})
        report("module ${top} is not in LINKS of ${folder_${module}}/CMakeLists.txt")
      endif()
      set(rest ${rules})
      while(rest)
        list(POP_FRONT rest pattern allowed words)
        if(include MATCHES "${pattern}" AND NOT file MATCHES "${allowed}")
          report("allowed only in ${words}")
        endif()
      endwhile()
    endforeach()
  endforeach()
endforeach()

if(faults GREATER 0)
  message(FATAL_ERROR "${faults} includes break the rules; see the list above")
endif()
message("${count} modules include only what they link")
