# The project as an extension of 3D Slicer: its metadata, the host's settings, and where the host looks for executables.

set(EXTENSION_NAME ${PROJECT_NAME})
set(EXTENSION_CATEGORY "Surgical Meshing")
set(EXTENSION_CONTRIBUTORS "The SurgicalMesher contributors")
string(CONCAT EXTENSION_DESCRIPTION
  "Turns a label map and surgical targets or paths into graded multi-tissue finite element meshes: dense where the "
  "surgeon works, sparse elsewhere, every tissue with the topology of the map.")
set(EXTENSION_DEPENDS "NA")
set(EXTENSION_README_FILE ${PROJECT_SOURCE_DIR}/README.md)
set(EXTENSION_LICENSE_FILE ${PROJECT_SOURCE_DIR}/LICENSE)

find_package(Slicer REQUIRED)
include(${Slicer_USE_FILE})

set(SurgicalMesher_CLI_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/${Slicer_CLIMODULES_BIN_DIR})
set(SurgicalMesher_CLI_INSTALL_DIRECTORY ${Slicer_INSTALL_CLIMODULES_BIN_DIR})
