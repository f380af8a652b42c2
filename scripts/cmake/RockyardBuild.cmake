# Build-wide choices: build type, compiler cache, sanitizers.

get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT multi_config AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# The Python module holds the same archives as the command. No function is replaced when it is loaded, so
# that the compiler may inline as it does in a program.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
add_compile_options(-fno-semantic-interposition)

# GCC looks for garbage from 128 MB on, which takes a tenth of its time: from 1 GB on.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=ggc-min-heapsize=1048576)
endif()

find_program(ROCKYARD_CCACHE ccache)
mark_as_advanced(ROCKYARD_CCACHE)
if(ROCKYARD_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ROCKYARD_CCACHE})
endif()

if(ROCKYARD_SANITIZE)
  if(ROCKYARD_SANITIZE MATCHES "thread" AND NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # gcc's OpenMP runtime is not instrumented, so every parallel loop looks like a race. Clang's
    # runtime tells the sanitizer about its threads (libarcher). The preset tsan selects clang.
    message(FATAL_ERROR "ROCKYARD_SANITIZE=thread needs clang with libomp (preset tsan)")
  endif()
  # Types of objects (vptr) are looked at through pipes, which a process that may open no more files
  # does not have: what it says of such a process is wrong.
  set(sanitizer_flags -fsanitize=${ROCKYARD_SANITIZE} -fno-sanitize=vptr
      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_options(${sanitizer_flags})
  # The standard library checks its own preconditions too: what no optional holds lies in memory
  # that no sanitizer minds.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_link_options(${sanitizer_flags})
endif()

# Sources of one target are compiled in batches of about equal length, none longer than this, because most
# of the time goes into the headers that they share. 0: every file by itself.
set(ROCKYARD_UNITY_BATCH 32 CACHE STRING "Sources compiled together; 0: none")

function(rockyard_set_unity target)
  get_target_property(type ${target} TYPE)
  if(ROCKYARD_UNITY_BATCH GREATER 1 AND NOT type STREQUAL "INTERFACE_LIBRARY")
    get_target_property(sources ${target} SOURCES)
    list(LENGTH sources count)
    math(EXPR batches "(${count} + ${ROCKYARD_UNITY_BATCH} - 1) / ${ROCKYARD_UNITY_BATCH}")
    math(EXPR length "(${count} + ${batches} - 1) / ${batches}")
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE BATCH
      UNITY_BUILD_BATCH_SIZE ${length})
  endif()
endfunction()
