# CGAL 5.5.1, headers only: used from its release archive as it is. Without GMP and MPFR it takes its exact numbers from
# Boost. Licence: GPL 3, in part LGPL 3.

set(proj CGAL)
set(${proj}_DEPENDS Boost)
ExternalProject_Include_Dependencies(${proj} PROJECT_VAR proj)

if(DEFINED CGAL_DIR AND NOT EXISTS ${CGAL_DIR})
  message(FATAL_ERROR "CGAL_DIR: no folder ${CGAL_DIR}")
endif()

if(NOT DEFINED CGAL_DIR)
  ExternalProject_SetIfNotDefined(${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_URL
    "https://github.com/CGAL/cgal/releases/download/v5.5.1/CGAL-5.5.1.tar.xz" QUIET)
  ExternalProject_SetIfNotDefined(${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_SHA256
    "091630def028facdcaf00eb5b68ad79eddac1b855cca6e87eef18a031566edfc" QUIET)

  ExternalProject_Add(${proj}
    ${${proj}_EP_ARGS}
    URL ${${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_URL}
    URL_HASH SHA256=${${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_SHA256}
    DOWNLOAD_DIR ${CMAKE_BINARY_DIR}/download
    SOURCE_DIR ${CMAKE_BINARY_DIR}/${proj}
    CONFIGURE_COMMAND ""
    BUILD_COMMAND ""
    INSTALL_COMMAND ""
    DEPENDS ${${proj}_DEPENDS})
  set(CGAL_DIR ${CMAKE_BINARY_DIR}/${proj}/lib/cmake/CGAL)
  set(CGAL_DISABLE_GMP ON)
else()
  ExternalProject_Add_Empty(${proj} DEPENDS ${${proj}_DEPENDS})
endif()

mark_as_superbuild(VARS CGAL_DIR:PATH CGAL_DISABLE_GMP:BOOL)
