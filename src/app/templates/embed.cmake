# Writes OUT, a C++ file that holds the templates in FOLDER (*.in) and the client of processes, CLIENT, as literals:
# cmake -DFOLDER=... -DCLIENT=... -DOUT=... -P

set(delimiter rockyard_file)

function(append_template NAME FILE)
  file(READ ${FILE} text)
  string(FIND "${text}" ")${delimiter}\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${FILE} holds the end of a C++ literal")
  endif()
  file(APPEND ${OUT} "    {\"${NAME}\", R\"${delimiter}(${text})${delimiter}\"},\n")
endfunction()

file(WRITE ${OUT} "// Written by src/app/templates/embed.cmake.\n#include \"app/new_files.h\"\n\n"
                  "namespace rockyard::app {\nnamespace {\n\nconstexpr Template kTemplates[] = {\n")
file(GLOB_RECURSE names RELATIVE ${FOLDER} ${FOLDER}/*.in)
foreach(name ${names})
  append_template(${name} ${FOLDER}/${name})
endforeach()
append_template(process/rockyard_navigator.py ${CLIENT})
file(APPEND ${OUT} "};\n\n}  // namespace\n\n"
                   "std::span<const Template> Templates() { return kTemplates; }\n\n"
                   "}  // namespace rockyard::app\n")
