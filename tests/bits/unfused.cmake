# cmake -DOBJDUMP=objdump "-DARCHIVES=a.a;b.a" -P unfused.cmake
# Fails on a fused multiply-add in the machine code of a module: it rounds once where other
# processors round twice. -ffp-contract=off forbids them, but g++ 12 makes some all the same.
cmake_minimum_required(VERSION 3.25)
set(faults 0)
foreach(archive IN LISTS ARCHIVES)
  execute_process(COMMAND ${OBJDUMP} -d --no-show-raw-insn "${archive}" OUTPUT_VARIABLE code
                  RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${OBJDUMP} cannot read ${archive}")
  endif()
  string(REGEX MATCHALL "vfn?m(add|sub)[a-z0-9]*" fused "${code}")
  list(LENGTH fused count)
  if(count GREATER 0)
    list(GET fused 0 first)
    message("${archive}: ${count} fused instructions, such as ${first}; give the module unfused()")
    math(EXPR faults "${faults} + 1")
  endif()
endforeach()
if(faults GREATER 0)
  message(FATAL_ERROR "${faults} modules fuse products and sums")
endif()
list(LENGTH ARCHIVES count)
message("${count} modules round after every operation")
