find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(ZLIB REQUIRED)

# Debian may carry the serial and the MPI build side by side.
set(HDF5_PREFER_PARALLEL OFF)
find_package(HDF5 REQUIRED COMPONENTS C)

# VTK writes the files for ParaView where it is installed, model/vtk_xml.cpp where it is not.
set(FLOWSLIDE_VTK AUTO CACHE STRING "Write files for ParaView with VTK: ON, OFF or AUTO (docs/adr/0013)")
if(FLOWSLIDE_VTK STREQUAL "AUTO")
  find_package(VTK 9.1 QUIET COMPONENTS CommonCore CommonDataModel IOXML)
elseif(FLOWSLIDE_VTK)
  find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOXML)
endif()
