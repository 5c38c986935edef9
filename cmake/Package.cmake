# Read by cpack: a package goes to other machines, whose processors may not know the instructions of
# this one (docs/adr/0002).
if(CPACK_FLOWSLIDE_ARCH STREQUAL "native" AND NOT CPACK_FLOWSLIDE_FOR_THIS_MACHINE)
  message(FATAL_ERROR
    "this build is for the processor of this machine (FLOWSLIDE_ARCH=native) and its package could "
    "stop with an illegal instruction on another. Build the preset 'package', or add "
    "-D CPACK_FLOWSLIDE_FOR_THIS_MACHINE=ON if it stays here.")
endif()
