# The kinds of target the project is made of, each with one function.
#   surgicalmesher_add_library(NAME SOURCES ... [LINK ...])       static library of host-independent code
#   surgicalmesher_add_cli(NAME [LINK ...])                       NAME.cxx + NAME.xml in the current folder
#   surgicalmesher_add_test(NAME SOURCES ... [LINK ...])          GoogleTest executable, each test known to CTest

include(GNUInstallDirs)

add_library(SurgicalMesherFlags INTERFACE)
target_compile_options(SurgicalMesherFlags INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra>
  # Fused multiply-add would make the mesh depend on the processor.
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>
  $<$<AND:$<BOOL:${SurgicalMesher_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)

function(surgicalmesher_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE SurgicalMesherFlags)
endfunction()

function(surgicalmesher_add_cli name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  set(xml ${CMAKE_CURRENT_SOURCE_DIR}/${name}.xml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${xml})
  file(READ ${xml} SURGICALMESHER_XML)
  configure_file(${PROJECT_SOURCE_DIR}/CMake/ModuleXML.h.in ${CMAKE_CURRENT_BINARY_DIR}/${name}XML.h @ONLY)
  add_executable(${name} ${name}.cxx)
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
  target_link_libraries(${name} PRIVATE SurgicalMesherFlags SurgicalMesherCommandLine ${ARG_LINK})
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

function(surgicalmesher_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE SurgicalMesherFlags GTest::gtest_main ${ARG_LINK})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60)
endfunction()
