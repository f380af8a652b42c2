# rockyard::rockyard, the library of all modules, and its installation as a CMake package.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY ROCKYARD_MODULES)
get_property(targets GLOBAL PROPERTY ROCKYARD_TARGETS)

add_library(rockyard_all INTERFACE)
add_library(rockyard::rockyard ALIAS rockyard_all)
set_target_properties(rockyard_all PROPERTIES EXPORT_NAME rockyard)
target_link_libraries(rockyard_all INTERFACE ${targets})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rockyard)
install(TARGETS ${targets} rockyard_all EXPORT rockyardTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT rockyardTargets NAMESPACE rockyard:: DESTINATION ${package_dir})
if(TARGET rockyard)  # the command, with the scenarios that it finds by name, completion for bash and man pages
  set_target_properties(rockyard PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  install(TARGETS rockyard RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/rockyard)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/results/reference
          DESTINATION ${CMAKE_INSTALL_DATADIR}/rockyard/results)
  set(completion ${PROJECT_BINARY_DIR}/completion)
  install(CODE "file(MAKE_DIRECTORY ${completion})
    execute_process(COMMAND $<TARGET_FILE:rockyard> completion bash OUTPUT_FILE ${completion}/rockyard
                    COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${completion}/rockyard DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  set(man ${PROJECT_BINARY_DIR}/man)
  install(CODE "execute_process(COMMAND $<TARGET_FILE:rockyard> help --format man --out ${man}
                                ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)")
  install(DIRECTORY ${man}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1")
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
        FILES_MATCHING PATTERN "*.md")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
foreach(module ${modules})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/${module}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rockyard FILES_MATCHING PATTERN "*.h")
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rockyardConfig.cmake.in
  ${PROJECT_BINARY_DIR}/rockyardConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rockyardConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rockyardConfig.cmake
              ${PROJECT_BINARY_DIR}/rockyardConfigVersion.cmake DESTINATION ${package_dir})

# `cpack --config <build>/CPackConfig.cmake`: a Debian package of all that is installed.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the rockyard developers <rockyard@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(ROCKYARD_GDAL AND GDAL_FOUND)  # loaded when a planetary image is read, so that no link asks for it
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS libgdal32)
endif()
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
include(CPack)
