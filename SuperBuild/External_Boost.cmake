# Boost 1.83.0, its headers, which CGAL needs. Nothing of it is built. Licence: Boost 1.0.

set(proj Boost)
set(${proj}_DEPENDS "")
ExternalProject_Include_Dependencies(${proj} PROJECT_VAR proj)

if(NOT DEFINED BOOST_ROOT)
  ExternalProject_SetIfNotDefined(${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_URL
    "https://archives.boost.io/release/1.83.0/source/boost_1_83_0.tar.bz2" QUIET)
  ExternalProject_SetIfNotDefined(${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_SHA256
    "6478edfe2f3305127cffe8caf73ea0176c53769f4bf1585be237eb30798c3b8e" QUIET)

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
  set(BOOST_ROOT ${CMAKE_BINARY_DIR}/${proj})
  # A Boost of the system must not come first.
  set(Boost_NO_BOOST_CMAKE ON)
  set(Boost_NO_SYSTEM_PATHS ON)
else()
  ExternalProject_Add_Empty(${proj} DEPENDS ${${proj}_DEPENDS})
endif()

mark_as_superbuild(VARS BOOST_ROOT:PATH Boost_NO_BOOST_CMAKE:BOOL Boost_NO_SYSTEM_PATHS:BOOL)
