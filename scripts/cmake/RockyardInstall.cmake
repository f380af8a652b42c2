# rockyard::onboard and rockyard::rockyard, the two sides of the truth firewall, and their installation as a
# CMake package. What is installed of src/ stands in src/public_headers.txt, below one include root a side.
# The modules behind them are archives without headers.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(targets GLOBAL PROPERTY ROCKYARD_TARGETS)

# rockyard_side(SIDE NAME LINKS...): the target rockyard::NAME, which sees the headers of SIDE.
function(rockyard_side SIDE NAME)
  add_library(rockyard_side_${SIDE} INTERFACE)
  add_library(rockyard::${NAME} ALIAS rockyard_side_${SIDE})
  set_target_properties(rockyard_side_${SIDE} PROPERTIES EXPORT_NAME ${NAME})
  target_link_libraries(rockyard_side_${SIDE} INTERFACE ${ARGN})
  target_include_directories(rockyard_side_${SIDE} INTERFACE
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rockyard/${SIDE}>)
endfunction()

rockyard_side(onboard onboard
  rockyard_core rockyard_localization rockyard_math rockyard_messages rockyard_navigation rockyard_perception)
rockyard_side(world rockyard rockyard_side_onboard ${targets})

# rockyard::navigator_plugin: the headers of the side `onboard` alone, for plugins, which link nothing of rockyard.
# Exported apart from the modules, so that who builds a plugin needs none of their libraries but Eigen.
add_library(rockyard_navigator_plugin INTERFACE)
add_library(rockyard::navigator_plugin ALIAS rockyard_navigator_plugin)
set_target_properties(rockyard_navigator_plugin PROPERTIES EXPORT_NAME navigator_plugin)
target_compile_features(rockyard_navigator_plugin INTERFACE cxx_std_20)
target_compile_options(rockyard_navigator_plugin INTERFACE
  ${ROCKYARD_FLOATING_POINT} -fvisibility=hidden -fvisibility-inlines-hidden)
target_link_options(rockyard_navigator_plugin INTERFACE LINKER:--no-undefined)  # told here, not when it is loaded
target_link_libraries(rockyard_navigator_plugin INTERFACE Eigen3::Eigen)
target_include_directories(rockyard_navigator_plugin INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rockyard/onboard>)

set(public_headers ${PROJECT_SOURCE_DIR}/src/public_headers.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${public_headers})
file(STRINGS ${public_headers} lines REGEX "^[^#]")
foreach(line ${lines})
  string(REPLACE " " ";" words ${line})
  list(GET words 0 side)
  list(GET words 1 header)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rockyard/${side}/${folder})
endforeach()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rockyard)
install(TARGETS ${targets} rockyard_side_onboard rockyard_side_world EXPORT rockyardTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT rockyardTargets NAMESPACE rockyard:: DESTINATION ${package_dir})
install(TARGETS rockyard_navigator_plugin EXPORT rockyardPluginTargets)
install(EXPORT rockyardPluginTargets NAMESPACE rockyard:: DESTINATION ${package_dir})
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

# What pages link to beyond docs lies as far from them as in the project.
file(GLOB pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/commands/*.md)
set(linked)
foreach(page ${pages})
  file(READ ${PROJECT_SOURCE_DIR}/${page} text)
  string(REGEX MATCHALL "\\(\\.\\./[^)#]+" links "${text}")  # without the bracket before it, which lists do not split at
  cmake_path(GET page PARENT_PATH folder)
  foreach(link ${links})
    string(SUBSTRING "${link}" 1 -1 link)
    cmake_path(APPEND folder ${link} OUTPUT_VARIABLE target)
    cmake_path(NORMAL_PATH target)
    string(REGEX REPLACE "/$" "" target "${target}")
    list(APPEND linked "${target}")
  endforeach()
endforeach()
list(REMOVE_DUPLICATES linked)
list(FILTER linked EXCLUDE REGEX "^(docs|scenarios)(/|$)")
foreach(target ${linked})
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${target})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${target}/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/${target})
  else()
    cmake_path(GET target PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${target} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
  endif()
endforeach()
install(CODE "file(CREATE_LINK ../../rockyard/scenarios \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}/scenarios\" SYMBOLIC)")

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rockyardConfig.cmake.in
  ${PROJECT_BINARY_DIR}/rockyardConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rockyardConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rockyardConfig.cmake
              ${PROJECT_BINARY_DIR}/rockyardConfigVersion.cmake DESTINATION ${package_dir})

# `cpack --config <build>/CPackConfig.cmake`: Debian packages of all that is installed, rockyard and python3-rockyard.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME rockyard)
set(CPACK_DEBIAN_UNSPECIFIED_FILE_NAME DEB-DEFAULT)
if(TARGET rockyard_python_module)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rockyard)
  set(CPACK_DEBIAN_PYTHON_FILE_NAME DEB-DEFAULT)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")  # a module is of one version of Python
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "rockyard (= ${PROJECT_VERSION}), python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The package rockyard for Python")
endif()
set(CPACK_PACKAGE_CONTACT "the rockyard developers <rockyard@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(ROCKYARD_GDAL AND GDAL_FOUND)  # loaded when a planetary image or an elevation model is read, so that no link asks for it
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS libgdal32)
endif()
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
include(CPack)
