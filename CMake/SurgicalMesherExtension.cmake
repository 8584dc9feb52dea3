# The project as an extension of 3D Slicer: the host's settings, and where the host looks for executables.

set(EXTENSION_NAME ${PROJECT_NAME})
set(EXTENSION_DEPENDS "NA")
set(EXTENSION_README_FILE ${PROJECT_SOURCE_DIR}/README.md)
set(EXTENSION_LICENSE_FILE ${PROJECT_SOURCE_DIR}/LICENSE)

# Slicer's extension factory says that it is at work by the first of these variables.
set(SurgicalMesher_BUILD_SLICER_EXTENSION OFF CACHE BOOL "Build as Slicer's extension factory does")
mark_as_advanced(SurgicalMesher_BUILD_SLICER_EXTENSION)
option(SurgicalMesher_SUPERBUILD "Fetch and build TetGen and CGAL as well" ${SurgicalMesher_BUILD_SLICER_EXTENSION})
if(SurgicalMesher_SUPERBUILD OR DEFINED EXTENSION_SUPERBUILD_BINARY_DIR)
  set(EXTENSION_BUILD_SUBDIRECTORY inner-build)
endif()

find_package(Slicer REQUIRED)
include(${Slicer_USE_FILE})

set(SurgicalMesher_CLI_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/${Slicer_CLIMODULES_BIN_DIR})
set(SurgicalMesher_CLI_INSTALL_DIRECTORY ${Slicer_INSTALL_CLIMODULES_BIN_DIR})
