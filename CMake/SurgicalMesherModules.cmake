# The parts of a loadable module of Slicer, each with one function. Names are those that Slicer expects; SOURCES are
# further pairs of .h and .cxx, by their names without extension; LINK are libraries, whose headers come with them.
#   surgicalmesher_add_module_mrml(NAME ...)    in NAME/MRML:   vtkMRML<NAME>Node
#   surgicalmesher_add_module_logic(NAME ...)   in NAME/Logic:  vtkSlicer<NAME>Logic
#   surgicalmesher_add_module(NAME ...)         in NAME:        qSlicer<NAME>Module, qSlicer<NAME>ModuleWidget,
#                                               Resources/UI/qSlicer<NAME>ModuleWidget.ui (UI: further ones),
#                                               Resources/qSlicer<NAME>Module.qrc; with the host's generic module tests
#   surgicalmesher_add_host_tests(TARGET TESTS ... [SOURCES ...] [LINK ...])
#                                               a driver for the library TARGET, one test for each of TESTS, a .cxx with
#                                               a function int <name>(int, char*[]); SOURCES are file names here. Leaks
#                                               and VTK's errors and warnings fail a test.

# Warnings are ours to mend only where the headers are ours.
include_directories(SYSTEM
  ${Slicer_Libs_INCLUDE_DIRS} ${Slicer_Base_INCLUDE_DIRS} ${Slicer_ModuleMRML_INCLUDE_DIRS}
  ${Slicer_ModuleLogic_INCLUDE_DIRS} ${Slicer_ModuleWidgets_INCLUDE_DIRS})

macro(surgicalmesher_parse_module_arguments)
  cmake_parse_arguments(ARG "" "" "SOURCES;UI;LINK" ${ARGN})
  string(TOUPPER ${name} upper)
  set(MODULE_NAME ${name}) # names the folder in IDEs
endmacro()

function(surgicalmesher_source_files variable)
  set(files)
  foreach(source ${ARGN})
    list(APPEND files ${source}.cxx ${source}.h)
  endforeach()
  set(${variable} ${files} PARENT_SCOPE)
endfunction()

# Generated export headers lie in the binary folder.
function(surgicalmesher_publish_headers target)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}> $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}>)
endfunction()

function(surgicalmesher_add_module_mrml name)
  surgicalmesher_parse_module_arguments(${ARGN})
  surgicalmesher_source_files(files vtkMRML${name}Node ${ARG_SOURCES})
  SlicerMacroBuildModuleMRML(
    NAME vtkSlicer${name}ModuleMRML
    EXPORT_DIRECTIVE VTK_SLICER_${upper}_MODULE_MRML_EXPORT
    SRCS ${files}
    TARGET_LIBRARIES vtkSurgicalMesherSupportMRML SurgicalMesherFlags ${ARG_LINK})
  surgicalmesher_publish_headers(vtkSlicer${name}ModuleMRML)
endfunction()

function(surgicalmesher_add_module_logic name)
  surgicalmesher_parse_module_arguments(${ARGN})
  surgicalmesher_source_files(files vtkSlicer${name}Logic ${ARG_SOURCES})
  SlicerMacroBuildModuleLogic(
    NAME vtkSlicer${name}ModuleLogic
    EXPORT_DIRECTIVE VTK_SLICER_${upper}_MODULE_LOGIC_EXPORT
    SRCS ${files}
    TARGET_LIBRARIES vtkSlicer${name}ModuleMRML vtkSurgicalMesherSupportLogic SurgicalMesherFlags ${ARG_LINK})
  surgicalmesher_publish_headers(vtkSlicer${name}ModuleLogic)
endfunction()

function(surgicalmesher_add_module name)
  surgicalmesher_parse_module_arguments(${ARGN})
  set(sources qSlicer${name}Module qSlicer${name}ModuleWidget ${ARG_SOURCES})
  surgicalmesher_source_files(files ${sources})
  set(headers ${files})
  list(FILTER headers INCLUDE REGEX "^q.*\\.h$") # Qt classes, by their name
  slicerMacroBuildLoadableModule(
    NAME ${name}
    NO_TITLE
    EXPORT_DIRECTIVE Q_SLICER_QTMODULES_${upper}_EXPORT
    SRCS ${files}
    MOC_SRCS ${headers} # read by Slicer before it moved to AUTOMOC, ignored since
    UI_SRCS Resources/UI/qSlicer${name}ModuleWidget.ui ${ARG_UI}
    RESOURCES Resources/qSlicer${name}Module.qrc
    TARGET_LIBRARIES vtkSlicer${name}ModuleLogic qSurgicalMesherSupportWidgets SurgicalMesherFlags ${ARG_LINK}
    WITH_GENERIC_TESTS)
  surgicalmesher_publish_headers(qSlicer${name}Module)
endfunction()

function(surgicalmesher_add_host_tests target)
  cmake_parse_arguments(ARG "" "" "TESTS;SOURCES;LINK" ${ARGN})
  set(KIT ${target})
  set(files ${ARG_TESTS})
  list(TRANSFORM files APPEND .cxx)
  slicerMacroConfigureModuleCxxTestDriver(
    NAME ${target}
    SOURCES ${files}
    TARGET_LIBRARIES SurgicalMesherFlags ${ARG_LINK}
    WITH_VTK_DEBUG_LEAKS_CHECK
    WITH_VTK_ERROR_OUTPUT_CHECK)
  target_sources(${target}CxxTests PRIVATE ${ARG_SOURCES})
  foreach(test ${ARG_TESTS})
    simple_test(${test})
  endforeach()
  # On Linux the host means its thread of runs and gives the lowest priority to its main one: beside a busy machine a
  # test would wait for a hundredth of a core.
  set_tests_properties(${ARG_TESTS} PROPERTIES ENVIRONMENT SLICER_BACKGROUND_THREAD_PRIORITY=0)
endfunction()
