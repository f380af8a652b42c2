# Writes OUT, a C++ file with the pages of folder PAGES as literals: cmake -DPAGES=... -DOUT=... -P
# A cut may go through a character of several bytes, which the joined literal has whole again.

set(delimiter rockyard_page)
set(part_length 16000)  # compilers limit the length of one literal

function(append_page NAME FILE)
  file(READ ${FILE} page)
  string(FIND "${page}" ")${delimiter}\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${FILE} holds the end of a C++ literal")
  endif()
  string(LENGTH "${page}" length)
  file(APPEND ${OUT} "const std::string_view ${NAME} =")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${page}" ${at} ${part_length} part)
    file(APPEND ${OUT} "\nR\"${delimiter}(${part})${delimiter}\"")
    math(EXPR at "${at} + ${part_length}")
  endwhile()
  file(APPEND ${OUT} ";\n\n")
endfunction()

file(WRITE ${OUT} "// Written by scripts/cmake/embed_pages.cmake.\n#include \"web/page.h\"\n\n"
                  "namespace rockyard::web {\n\n")
append_page(kReportPage ${PAGES}/report.html)
append_page(kReplayPage ${PAGES}/replay.html)
append_page(kBenchPage ${PAGES}/bench.html)
file(APPEND ${OUT} "}  // namespace rockyard::web\n")
