# One folder of src/ is one namespace and one static library.
#
# rockyard_module(NAME [SOURCES ...] [DEPENDS module ...] [PRIVATE_LIBRARIES target ...])
#   NAME              folder below src/, also the namespace: rockyard::NAME
#   SOURCES           .cc files; a module without any is header-only
#   DEPENDS           modules whose headers this one may include (the table in src/README.md)
#   PRIVATE_LIBRARIES third-party targets used in .cc files only
#
# rockyard_test(NAME LABELS label ... SOURCES ... [DEPENDS module ...] [LIBRARIES target ...])
#   one GoogleTest executable; every test of it carries the labels.

include(GoogleTest)

set(ROCKYARD_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wimplicit-fallthrough -Werror)
# Bit-for-bit reproducibility across optimization levels: no fused multiply-add, no fast math.
set(ROCKYARD_FLOATING_POINT -ffp-contract=off -fno-fast-math)

function(rockyard_module NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_LIBRARIES" ${ARGN})
  set(target rockyard_${NAME})
  list(TRANSFORM ARG_DEPENDS PREPEND rockyard_ OUTPUT_VARIABLE dependencies)
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_compile_options(${target} PRIVATE ${ROCKYARD_WARNINGS})
    target_compile_options(${target} PUBLIC ${ROCKYARD_FLOATING_POINT})
    target_link_libraries(${target} PRIVATE ${ARG_PRIVATE_LIBRARIES})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include/rockyard>)
  target_link_libraries(${target} ${scope} ${dependencies} Eigen3::Eigen)
  add_library(rockyard::${NAME} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY ROCKYARD_MODULES ${target})
endfunction()

function(rockyard_test NAME)
  cmake_parse_arguments(ARG "" "" "LABELS;SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  list(TRANSFORM ARG_DEPENDS PREPEND rockyard_ OUTPUT_VARIABLE dependencies)
  add_executable(${NAME} ${ARG_SOURCES})
  target_compile_options(${NAME} PRIVATE ${ROCKYARD_WARNINGS})
  target_include_directories(${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${NAME} PRIVATE ROCKYARD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${NAME} PRIVATE ${dependencies} ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${NAME} PROPERTIES LABELS "${ARG_LABELS}" DISCOVERY_TIMEOUT 60)
endfunction()
