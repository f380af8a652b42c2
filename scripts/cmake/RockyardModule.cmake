# One folder of src/ is one namespace and one static library.
#
# rockyard_module(NAME [SOURCES ...] [DEPENDS module ...] [PARAMS_OF module ...]
#                 [PRIVATE_LIBRARIES target ...] [SELDOM_RUN])
#   NAME              folder below src/, also the namespace: rockyard::NAME
#   SOURCES           .cc files; a module without any is header-only
#   DEPENDS           modules whose headers this one may include (the table in src/README.md)
#   PARAMS_OF         modules whose *_params.h headers this one's own *_params files may include; of
#                     a module that DEPENDS does not name, nothing else may be included anywhere
#   PRIVATE_LIBRARIES third-party targets used in .cc files only
#   SELDOM_RUN        drives spend no time in it: -O1 where the others have -O3, as for all *_params,
#                     which saves a fifth of its compilation
#
# How a folder is kept from seeing another one: src/ itself is on no include path. Each module has
# its own include root in the build tree that holds one link,
#   <build>/include/NAME/NAME -> src/NAME
# and a target sees the roots of the modules that it links and no others, so that a header of any
# other module is "No such file". Modules with *_params.h have a second target, NAME_params, that
# holds the *_params.cc files and a root with links to those headers alone: whoever composes
# parameters links these and sees no more. Parameters may use core, math, messages and the parameters
# of the modules in PARAMS_OF.

include(GNUInstallDirs)

set(ROCKYARD_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wimplicit-fallthrough)
if(ROCKYARD_WARNINGS_AS_ERRORS)
  list(APPEND ROCKYARD_WARNINGS -Werror)
endif()
# Bit-for-bit reproducibility across optimization levels: no fused multiply-add, no fast math.
set(ROCKYARD_FLOATING_POINT -ffp-contract=off -fno-fast-math)

# Options of what no drive spends time in; results do not depend on them.
set(ROCKYARD_SELDOM_RUN $<$<CONFIG:Release>:-O1>)

# What every target of ours, header-only or not, has in common.
function(rockyard_configure_target target export_name include_root)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(scope INTERFACE)
  else()
    set(scope PUBLIC)
    target_compile_options(${target} PRIVATE ${ROCKYARD_WARNINGS}
      -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
  endif()
  target_compile_options(${target} ${scope} ${ROCKYARD_FLOATING_POINT}
    $<BUILD_INTERFACE:-fmacro-prefix-map=${include_root}/=src/>)
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${include_root}>)
  if(ROCKYARD_CONTRACTS)
    target_compile_definitions(${target} ${scope} ROCKYARD_CONTRACTS)
  endif()
  target_link_libraries(${target} ${scope} Eigen3::Eigen)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name})
  add_library(rockyard::${export_name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY ROCKYARD_TARGETS ${target})
endfunction()

# The include root of NAME: one link to the whole folder.
function(rockyard_link_folder NAME root)
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/${NAME} SYMBOLIC)
endfunction()

# The include root of NAME_params: one link per header, at its place below the folder, renewed so
# that none outlives its header.
function(rockyard_link_headers NAME root)
  file(REMOVE_RECURSE ${root})
  foreach(header ${ARGN})
    cmake_path(GET header PARENT_PATH subfolder)
    file(MAKE_DIRECTORY ${root}/${NAME}/${subfolder})
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${header} ${root}/${NAME}/${header} SYMBOLIC)
  endforeach()
endfunction()

function(rockyard_params_module NAME)
  cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES;DEPENDS" ${ARGN})
  set(target rockyard_${NAME}_params)
  set(root ${PROJECT_BINARY_DIR}/include/${NAME}_params)
  rockyard_link_headers(${NAME} ${root} ${ARG_HEADERS})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_compile_options(${target} PRIVATE ${ROCKYARD_SELDOM_RUN})
    set(scope PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  rockyard_configure_target(${target} ${NAME}_params ${root})
  rockyard_set_unity(${target})
  target_link_libraries(${target} ${scope} ${ARG_DEPENDS})
endfunction()

function(rockyard_module NAME)
  cmake_parse_arguments(ARG "SELDOM_RUN" "" "SOURCES;DEPENDS;PARAMS_OF;PRIVATE_LIBRARIES" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rockyard_module(${NAME}): unknown arguments ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  set(target rockyard_${NAME})
  list(TRANSFORM ARG_DEPENDS PREPEND rockyard_ OUTPUT_VARIABLE dependencies)
  list(TRANSFORM ARG_PARAMS_OF REPLACE "(.+)" "rockyard_\\1_params")
  list(APPEND dependencies ${ARG_PARAMS_OF})

  file(GLOB_RECURSE params_headers CONFIGURE_DEPENDS
    RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*_params.h)
  if(params_headers)
    set(params_sources ${ARG_SOURCES})
    list(FILTER params_sources INCLUDE REGEX "_params\\.cc$")
    list(FILTER ARG_SOURCES EXCLUDE REGEX "_params\\.cc$")
    set(params_depends ${ARG_DEPENDS})
    list(FILTER params_depends INCLUDE REGEX "^(core|math|messages)$")
    list(TRANSFORM params_depends PREPEND rockyard_)
    rockyard_params_module(${NAME} HEADERS ${params_headers} SOURCES ${params_sources}
      DEPENDS ${params_depends} ${ARG_PARAMS_OF})
    list(APPEND dependencies rockyard_${NAME}_params)
  endif()

  set(root ${PROJECT_BINARY_DIR}/include/${NAME})
  rockyard_link_folder(${NAME} ${root})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE ${ARG_PRIVATE_LIBRARIES})
    if(ARG_SELDOM_RUN)
      target_compile_options(${target} PRIVATE ${ROCKYARD_SELDOM_RUN})
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  rockyard_configure_target(${target} ${NAME} ${root})
  rockyard_set_unity(${target})
  target_link_libraries(${target} ${scope} ${dependencies})
  set_property(GLOBAL APPEND PROPERTY ROCKYARD_MODULES ${NAME})
endfunction()
