# TetGen 1.5.0 as a static library, built by the CMake file beside this one: its own builds the program too and installs
# neither. Licence: AGPL 3.

set(proj TetGen)
set(${proj}_DEPENDS "")
ExternalProject_Include_Dependencies(${proj} PROJECT_VAR proj)

if(NOT DEFINED TetGen_ROOT)
  ExternalProject_SetIfNotDefined(${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_URL
    "https://wias-berlin.de/software/tetgen/1.5/src/tetgen1.5.0.tar.gz" QUIET)
  ExternalProject_SetIfNotDefined(${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_SHA256
    "4d114861d5ef2063afd06ef38885ec46822e90e7b4ea38c864f76493451f9cf3" QUIET)

  ExternalProject_Add(${proj}
    ${${proj}_EP_ARGS}
    URL ${${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_URL}
    URL_HASH SHA256=${${SUPERBUILD_TOPLEVEL_PROJECT}_${proj}_SHA256}
    DOWNLOAD_DIR ${CMAKE_BINARY_DIR}/download
    SOURCE_DIR ${CMAKE_BINARY_DIR}/${proj}
    BINARY_DIR ${CMAKE_BINARY_DIR}/${proj}-build
    INSTALL_DIR ${CMAKE_BINARY_DIR}/${proj}-install
    PATCH_COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/SuperBuild/TetGen/CMakeLists.txt <SOURCE_DIR>
    CMAKE_CACHE_ARGS
      ${ep_compiler_args}
      -DCMAKE_INSTALL_PREFIX:PATH=<INSTALL_DIR>
    DEPENDS ${${proj}_DEPENDS})
  set(TetGen_ROOT ${CMAKE_BINARY_DIR}/${proj}-install) # where FindTetGen.cmake looks first
else()
  ExternalProject_Add_Empty(${proj} DEPENDS ${${proj}_DEPENDS})
endif()

mark_as_superbuild(TetGen_ROOT:PATH)
