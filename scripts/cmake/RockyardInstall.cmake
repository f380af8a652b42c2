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
if(TARGET rockyard)  # the command
  set_target_properties(rockyard PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  install(TARGETS rockyard RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
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
