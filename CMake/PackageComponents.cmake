# Read by cpack for each kind of package: the archive is one file with the libraries in it; Debian's packages name them.
if(CPACK_GENERATOR STREQUAL "DEB")
  set(CPACK_COMPONENTS_ALL RuntimeLibraries Development)
else()
  set(CPACK_COMPONENTS_ALL RuntimeLibraries Bundle)
  set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
endif()
