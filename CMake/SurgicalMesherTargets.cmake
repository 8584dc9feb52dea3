# The kinds of target the project is made of, each with one function.
#   surgicalmesher_add_library(NAME SOURCES ... [LINK ...])       static library of host-independent code
#   surgicalmesher_add_cli(NAME [LINK ...])                       NAME.cxx + NAME.xml in the current folder; goes to
#                                                                 SurgicalMesher_CLI_OUTPUT_DIRECTORY
#   surgicalmesher_add_nipype_test(NAME)                          runs module NAME through an interface nipype generates
#   surgicalmesher_add_test(NAME SOURCES ... [LINK ...])          GoogleTest executable, each test known to CTest

# Debian's packages are those of Debian's own interpreter, not of one that comes first on the path.
find_program(SurgicalMesher_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(SurgicalMesher_PYTHON NAMES python3)

add_library(SurgicalMesherFlags INTERFACE)
if(Slicer_DIR)
  set_property(GLOBAL APPEND PROPERTY Slicer_TARGETS SurgicalMesherFlags)
endif()
target_compile_options(SurgicalMesherFlags INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra>
  # Fused multiply-add would make the mesh depend on the processor.
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>
  # Nobody reads errno after a square root. Nobody enables traps, either, and they keep loops from vector registers.
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-fno-math-errno;-fno-trapping-math>
  $<$<AND:$<BOOL:${SurgicalMesher_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)

# Debian's ITK takes no other compiler than GCC.
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang AND NOT Slicer_DIR)
  target_compile_options(SurgicalMesherFlags INTERFACE
    $<BUILD_INTERFACE:-include${PROJECT_SOURCE_DIR}/CMake/ItkWithClang.h>)
endif()

# ON: every executable ends at the first error that the address or undefined behaviour sanitizer finds.
set(SurgicalMesher_SANITIZE OFF CACHE STRING "ON: address and undefined behaviour sanitizers; thread: data races")
set_property(CACHE SurgicalMesher_SANITIZE PROPERTY STRINGS OFF ON thread)
if(SurgicalMesher_SANITIZE STREQUAL "thread")
  set(sanitize -fsanitize=thread)
elseif(SurgicalMesher_SANITIZE STREQUAL "ON")
  set(sanitize -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
elseif(NOT SurgicalMesher_SANITIZE STREQUAL "OFF")
  message(FATAL_ERROR "SurgicalMesher_SANITIZE is ${SurgicalMesher_SANITIZE}, expected OFF, ON or thread")
endif()
if(sanitize)
  target_compile_options(SurgicalMesherFlags INTERFACE ${sanitize})
  target_link_options(SurgicalMesherFlags INTERFACE ${sanitize})
endif()

function(surgicalmesher_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/surgicalmesher>)
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE SurgicalMesherFlags)
  if(Slicer_DIR)
    set_property(GLOBAL APPEND PROPERTY Slicer_TARGETS ${name}) # the host exports what its libraries link to
  else()
    surgicalmesher_install_library(${name})
  endif()
endfunction()

# SurgicalMesherTetMesh becomes SurgicalMesher::TetMesh of find_package(SurgicalMesher), its headers one flat folder.
function(surgicalmesher_install_library name)
  string(REPLACE SurgicalMesher "" short ${name})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${short})
  install(TARGETS ${name} EXPORT SurgicalMesherTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT Development)
  file(GLOB headers CONFIGURE_DEPENDS *.h Export/*.h)
  install(FILES ${headers} DESTINATION include/surgicalmesher COMPONENT Development)
endfunction()

# Programs find what an archive brings in lib/surgicalmesher. An RPATH, not a RUNPATH: it has to serve the libraries'
# own libraries, too.
function(surgicalmesher_install_program name)
  install(TARGETS ${name} RUNTIME DESTINATION ${SurgicalMesher_CLI_INSTALL_DIRECTORY} COMPONENT RuntimeLibraries)
  set_property(GLOBAL APPEND PROPERTY SurgicalMesher_PROGRAMS ${name})
  if(UNIX AND NOT APPLE AND NOT Slicer_DIR)
    set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}/surgicalmesher")
    target_link_options(${name} PRIVATE -Wl,--disable-new-dtags)
  endif()
endfunction()

# The description is compiled in, for --xml, and lies beside the executable, where Slicer looks first.
function(surgicalmesher_add_cli name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  set(xml ${CMAKE_CURRENT_SOURCE_DIR}/${name}.xml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${xml})
  file(READ ${xml} SURGICALMESHER_XML)
  if(NOT SURGICALMESHER_XML MATCHES "<version>${PROJECT_VERSION}</version>")
    message(FATAL_ERROR "${xml}: <version>${PROJECT_VERSION}</version> expected, the project's version")
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/CMake/ModuleXML.h.in ${CMAKE_CURRENT_BINARY_DIR}/${name}XML.h @ONLY)
  add_executable(${name} ${name}.cxx)
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
  target_link_libraries(${name} PRIVATE SurgicalMesherFlags SurgicalMesherCommandLine ${ARG_LINK})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${SurgicalMesher_CLI_OUTPUT_DIRECTORY})
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${xml} $<TARGET_FILE_DIR:${name}>/${name}.xml)
  surgicalmesher_install_program(${name})
  set_property(GLOBAL APPEND PROPERTY SurgicalMesher_DESCRIPTIONS ${name}=${xml}) # for manual pages
  install(FILES ${xml} DESTINATION ${SurgicalMesher_CLI_INSTALL_DIRECTORY} COMPONENT RuntimeLibraries)
  if(SurgicalMesher_UNIT_TESTS AND SurgicalMesher_PYTHON)
    surgicalmesher_add_description_test(${name})
  endif()
endfunction()

# Description, parser and source agree: whatever the .cxx asks for is in the .xml and the other way round, and the
# executable accepts each parameter, refuses wrong values of it, and lists it in --help.
function(surgicalmesher_add_description_test name)
  add_test(NAME ${name}Description
    COMMAND ${SurgicalMesher_PYTHON} ${PROJECT_SOURCE_DIR}/Testing/Python/test_description.py
      $<TARGET_FILE:${name}> ${CMAKE_CURRENT_SOURCE_DIR}/${name}.cxx)
endfunction()

# nipype's own generator of Slicer interfaces makes one from the module's --xml, and that interface runs the module.
function(surgicalmesher_add_nipype_test name)
  add_test(NAME ${name}Nipype
    COMMAND ${SurgicalMesher_PYTHON} ${PROJECT_SOURCE_DIR}/Testing/Python/test_nipype.py
      ${name} $<TARGET_FILE_DIR:${name}> ${CMAKE_CURRENT_BINARY_DIR}/nipype-${name})
  set_tests_properties(${name}Nipype PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
endfunction()

function(surgicalmesher_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE SurgicalMesherFlags GTest::gtest_main ${ARG_LINK})
  # What takes time is in the libraries; tests themselves compile in half the time so.
  target_compile_options(${name} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-O1>)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60)
endfunction()
