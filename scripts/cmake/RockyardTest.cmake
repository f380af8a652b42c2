# Tests and benchmarks.
#
# rockyard_test(NAME [UNIT file ...] [PROPERTY file ...] [PHYSICS file ...] [DIFFERENTIAL file ...]
#               [STATISTICAL file ...] [DETERMINISM file ...] [FUZZ file ...] [CLI file ...]
#               [SLOW file ...] [LONG file ...] [HELPERS file ...] [DEPENDS module ...]
#               [LIBRARIES target ...])
#   One GoogleTest executable of a folder of tests. ctest runs the tests of a file in one process, by the
#   file's path below tests/. Each file carries three labels: its kind, from the list that it stands in;
#   its tier, `full` where it is listed under SLOW too, `long` under LONG, `fast` where neither; and
#   its folder, as in tests/navigation. HELPERS are compiled but hold no tests.
#
# rockyard_test_helpers(NAME SOURCES file ... [DEPENDS module ...])
#   Helpers of several programs, compiled once and optimized (pictures that they paint take longer than what is
#   tested): an object library to name under their LIBRARIES.
#
# rockyard_command_test(NAME KIND TIER COMMAND...)
#   A test that is no GoogleTest, with the same labels: KIND in capitals, TIER is FAST, FULL or LONG.
#   The run records what it took (record_times.py).
#
# rockyard_tests_need_command()
#   The command is built with the tests of this folder.
#
# rockyard_benchmark(NAME SOURCES ... [DEPENDS module ...] [LIBRARIES target ...])
#   one Google Benchmark executable, which the target `benchmarks` builds, and no other; there is none
#   when ROCKYARD_BUILD_BENCHMARKS is off.

# Most of the time of a build goes into tests, and little of the time of tests into their own code: -Og
# compiles in three quarters of the time of -O1. With -O0, inline functions of tests replace those of the
# libraries when they are linked, and tests of rovers take eight times as long. Precompiled
# headers (GoogleTest, Eigen: 170 MB) save less here than reading them takes.
set(ROCKYARD_TEST_OPTIMIZATION $<$<CONFIG:Release>:-Og>)

# Files of tests are compiled in batches of this many (join_tests.py), for the headers that they share.
# 0: every file by itself, which is what one wants who works on one of them.
set(ROCKYARD_TEST_BATCH 40 CACHE STRING "Files of tests compiled together; 0: none")

set(ROCKYARD_TEST_KINDS UNIT PROPERTY PHYSICS DIFFERENTIAL STATISTICAL DETERMINISM FUZZ CLI)

# Sets VARIABLE to "tests/<folder>" of the folder that is being read.
function(rockyard_folder_label VARIABLE)
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME folder)
  set(${VARIABLE} tests/${folder} PARENT_SCOPE)
endfunction()

# Sets VARIABLE to what is compiled of the files of tests: batches, and files that stand alone because
# they define macros or have SKIP_UNITY_BUILD_INCLUSION.
function(rockyard_batches NAME FILES VARIABLE)
  set(alone)
  set(together)
  foreach(file ${FILES})
    get_source_file_property(skips ${file} SKIP_UNITY_BUILD_INCLUSION)
    file(STRINGS ${file} macros REGEX "^#define" LIMIT_COUNT 1)
    if(skips OR macros OR NOT ROCKYARD_TEST_BATCH GREATER 1)
      list(APPEND alone ${file})
    else()
      cmake_path(ABSOLUTE_PATH file NORMALIZE)
      list(APPEND together ${file})
    endif()
  endforeach()
  set(join ${PROJECT_SOURCE_DIR}/scripts/cmake/join_tests.py)
  set(number 0)
  while(together)
    list(SUBLIST together 0 ${ROCKYARD_TEST_BATCH} batch)
    list(REMOVE_ITEM together ${batch})
    list(LENGTH batch files)
    if(files EQUAL 1)
      list(APPEND alone ${batch})
      break()
    endif()
    set(joined ${CMAKE_CURRENT_BINARY_DIR}/${NAME}_batch_${number}.cc)
    add_custom_command(OUTPUT ${joined} DEPENDS ${batch} ${join} VERBATIM
      COMMAND Python3::Interpreter ${join} ${joined} ${batch})
    list(APPEND alone ${joined})
    math(EXPR number "${number} + 1")
  endwhile()
  set(${VARIABLE} ${alone} PARENT_SCOPE)
endfunction()

function(rockyard_test NAME)
  cmake_parse_arguments(ARG "" "" "${ROCKYARD_TEST_KINDS};SLOW;LONG;HELPERS;DEPENDS;LIBRARIES" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rockyard_test(${NAME}): unknown arguments ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  rockyard_folder_label(folder)
  set(sources)
  set(labels)
  foreach(kind ${ROCKYARD_TEST_KINDS})
    string(TOLOWER ${kind} label)
    foreach(file ${ARG_${kind}})
      list(APPEND sources ${file})
      set(tier fast)
      if(file IN_LIST ARG_LONG)
        set(tier long)
      elseif(file IN_LIST ARG_SLOW)
        set(tier full)
      endif()
      cmake_path(ABSOLUTE_PATH file NORMALIZE)
      string(APPEND labels "${file}\t${label};${tier};${folder}\n")
    endforeach()
  endforeach()
  foreach(file ${ARG_SLOW} ${ARG_LONG})
    if(NOT file IN_LIST sources)
      message(FATAL_ERROR "rockyard_test(${NAME}): ${file} of SLOW or LONG is in no list of tests")
    endif()
  endforeach()
  set(labels_file ${CMAKE_CURRENT_BINARY_DIR}/${NAME}_labels.txt)
  file(CONFIGURE OUTPUT ${labels_file} CONTENT "${labels}" @ONLY)

  list(TRANSFORM ARG_DEPENDS PREPEND rockyard_ OUTPUT_VARIABLE dependencies)
  rockyard_batches(${NAME} "${sources}" compiled)
  add_executable(${NAME} ${compiled} ${ARG_HELPERS})
  set_source_files_properties(${compiled} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  rockyard_set_unity(${NAME})  # the helpers
  target_compile_options(${NAME} PRIVATE ${ROCKYARD_WARNINGS} ${ROCKYARD_TEST_OPTIMIZATION})
  target_include_directories(${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${NAME} PRIVATE ROCKYARD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${NAME} PRIVATE ${dependencies} ${ARG_LIBRARIES} rockyard_test_main)

  # The program itself knows its tests and the file of each.
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${NAME}_tests.cmake)
  set_property(TARGET ${NAME} APPEND PROPERTY LINK_DEPENDS ${labels_file})
  add_custom_command(TARGET ${NAME} POST_BUILD BYPRODUCTS ${list}
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/scripts/cmake/list_tests.py
            $<TARGET_FILE:${NAME}> ${labels_file} ${list} VERBATIM)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${NAME}_include.cmake)
  file(WRITE ${include} "if(EXISTS \"${list}\")\n  include(\"${list}\")\nelse()\n"
    "  add_test(${NAME}_NOT_BUILT ${NAME}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()

function(rockyard_test_helpers NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rockyard_test_helpers(${NAME}): unknown arguments ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  list(TRANSFORM ARG_DEPENDS PREPEND rockyard_ OUTPUT_VARIABLE dependencies)
  add_library(${NAME} OBJECT EXCLUDE_FROM_ALL ${ARG_SOURCES})
  target_compile_options(${NAME} PRIVATE ${ROCKYARD_WARNINGS})
  target_include_directories(${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${NAME} PRIVATE ${dependencies})
endfunction()

function(rockyard_command_test NAME KIND TIER PROGRAM)
  if(NOT TIER MATCHES "^(FAST|FULL|LONG)$")
    message(FATAL_ERROR "rockyard_command_test(${NAME}): no tier ${TIER}")
  endif()
  string(TOLOWER "${KIND};${TIER}" labels)
  rockyard_folder_label(folder)
  if(TARGET ${PROGRAM})
    set(PROGRAM $<TARGET_FILE:${PROGRAM}>)
  endif()
  add_test(NAME ${NAME} COMMAND Python3::Interpreter
    ${PROJECT_SOURCE_DIR}/scripts/cmake/record_times.py ${NAME} ${PROGRAM} ${ARGN})
  # The longest processes first, so that no processor is idle at the end.
  set_tests_properties(${NAME} PROPERTIES LABELS "${labels};${folder}" COST 1)
endfunction()

function(rockyard_tests_need_command)
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME folder)
  add_custom_target(${folder}_tests_need_command ALL)
  add_dependencies(${folder}_tests_need_command rockyard)
endfunction()

add_custom_target(benchmarks)

function(rockyard_benchmark NAME)
  if(NOT ROCKYARD_BUILD_BENCHMARKS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  list(TRANSFORM ARG_DEPENDS PREPEND rockyard_ OUTPUT_VARIABLE dependencies)
  add_executable(${NAME} EXCLUDE_FROM_ALL ${ARG_SOURCES})
  add_dependencies(benchmarks ${NAME})
  target_compile_options(${NAME} PRIVATE ${ROCKYARD_WARNINGS})
  target_include_directories(${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${NAME} PRIVATE ROCKYARD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${NAME} PRIVATE ${dependencies} ${ARG_LIBRARIES}
    benchmark::benchmark benchmark::benchmark_main)
endfunction()
