# Writes OUT, a header with the commit of SOURCES, "-dirty" where what programs are made of differs from it,
# "unknown" outside of git; left as it is where it says so already: cmake -DSOURCES=... -DOUT=... -P

set(made_of src terrain CMakeLists.txt CMakePresets.json scripts/cmake)

set(commit unknown)
find_program(git git)
if(git)
  execute_process(COMMAND ${git} rev-parse --short=12 HEAD WORKING_DIRECTORY ${SOURCES}
    OUTPUT_VARIABLE head RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    execute_process(COMMAND ${git} diff --quiet HEAD -- ${made_of} WORKING_DIRECTORY ${SOURCES}
      RESULT_VARIABLE differs ERROR_QUIET)
    set(commit ${head})
    if(differs)
      string(APPEND commit -dirty)
    endif()
  endif()
endif()
configure_file(${SOURCES}/src/core/build_commit.h.in ${OUT} @ONLY)
