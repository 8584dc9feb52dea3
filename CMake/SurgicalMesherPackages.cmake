# What is installed besides the programs, and the packages made of it by `cpack`: Debian packages of the programs
# (surgicalmesher) and of the libraries (libsurgicalmesher-dev), and an archive that brings the libraries that the
# programs are linked to, and runs wherever it is unpacked.

include(CMakePackageConfigHelpers)

# ---- for find_package(SurgicalMesher)
set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/SurgicalMesher)
install(TARGETS SurgicalMesherFlags EXPORT SurgicalMesherTargets COMPONENT Development)
install(EXPORT SurgicalMesherTargets NAMESPACE SurgicalMesher:: DESTINATION ${cmake_folder} COMPONENT Development)
configure_package_config_file(CMake/SurgicalMesherConfig.cmake.in
  ${PROJECT_BINARY_DIR}/SurgicalMesherConfig.cmake INSTALL_DESTINATION ${cmake_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/SurgicalMesherConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/SurgicalMesherConfig.cmake
  ${PROJECT_BINARY_DIR}/SurgicalMesherConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/CMake/FindCHOLMOD.cmake
  ${PROJECT_SOURCE_DIR}/CMake/FindTetGen.cmake
  DESTINATION ${cmake_folder} COMPONENT Development)
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT RuntimeLibraries)

# ---- the archive's libraries, where the programs' RPATH looks; those of the C library are the system's
get_property(programs GLOBAL PROPERTY SurgicalMesher_PROGRAMS)
set(program_files)
foreach(program ${programs})
  list(APPEND program_files $<TARGET_FILE:${program}>)
endforeach()
install(CODE "
  file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${program_files} RESOLVED_DEPENDENCIES_VAR libraries
    PRE_EXCLUDE_REGEXES \"^ld-linux\" \"^lib(c|m|dl|rt|pthread|resolv|util)\\\\.so\")
  file(INSTALL \${libraries} DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/surgicalmesher\"
    FOLLOW_SYMLINK_CHAIN)"
  COMPONENT Bundle EXCLUDE_FROM_ALL)

# ---- packages
set(CPACK_PACKAGE_NAME surgicalmesher)
set(CPACK_PACKAGE_VENDOR "The SurgicalMesher contributors")
set(CPACK_PACKAGE_CONTACT "The SurgicalMesher contributors <surgicalmesher@users.noreply.github.com>")
set(CPACK_PACKAGE_HOMEPAGE_URL "https://github.com/SurgicalMesher/SurgicalMesher")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Graded finite element meshes of all tissues of a label map")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/CMake/PackageComponents.cmake)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIMELIBRARIES_PACKAGE_NAME surgicalmesher)
set(CPACK_DEBIAN_RUNTIMELIBRARIES_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIMELIBRARIES_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsurgicalmesher-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libvtk9-dev, libinsighttoolkit5-dev, libtet1.5-dev, libcgal-dev, libeigen3-dev, libsuitesparse-dev, rapidjson-dev")
include(CPack)

if(SurgicalMesher_UNIT_TESTS)
  add_test(NAME test_package
    COMMAND ${SurgicalMesher_PYTHON} ${PROJECT_SOURCE_DIR}/Testing/Package/test_package.py
      ${CMAKE_COMMAND} ${PROJECT_BINARY_DIR} ${PROJECT_BINARY_DIR}/Testing/Package)
  set_tests_properties(test_package PROPERTIES TIMEOUT 300)
endif()
