# cmake -DSOURCE=... -DVERSION=... -DOUTPUT=... -P ProgramVersion.cmake
# Writes a header with the version of the project and the revision of the checkout; an unchanged
# header keeps its time, so that nothing is compiled again.
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE failed)
if(failed)
  set(revision "")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
#define FLOWSLIDE_VERSION "@VERSION@"
#define FLOWSLIDE_REVISION "@revision@"
]])
