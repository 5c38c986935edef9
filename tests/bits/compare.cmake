# cmake -DPROGRAM=bits -DTHREADS=n -DEXPECTED=digests.txt -P compare.cmake
# The digests of this build against those that are kept.
execute_process(COMMAND "${PROGRAM}" ${THREADS} OUTPUT_VARIABLE found RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${PROGRAM} ${THREADS} failed")
endif()
file(READ "${EXPECTED}" expected)
if(found STREQUAL expected)
  return()
endif()
string(REPLACE "\n" ";" found "${found}")
string(REPLACE "\n" ";" expected "${expected}")
foreach(line IN LISTS found)
  if(NOT line IN_LIST expected)
    message("not in ${EXPECTED}: ${line}")
  endif()
endforeach()
message(FATAL_ERROR "other numbers than those kept (this processor, compiler or number of threads "
  "gives other bits, or results were changed) compare two builds with tests/bits/run.sh; for a "
  "change that is meant raise the version of the stages and keep the new lines:\n"
  "${PROGRAM} 1 > ${EXPECTED}")
