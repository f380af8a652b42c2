# The pages for a browser. They lie bundled in src/web/built, so that neither a build nor a run needs
# npm; with ROCKYARD_PAGE_TOOLS they are bundled anew from the sources, and the tests demand that these
# are the same bytes.
#
# rockyard_embed_pages(SOURCE_VARIABLE)
#   Sets SOURCE_VARIABLE to the .cc file that holds the pages as literals: with the page tools those
#   just bundled, else those in src/web/built.
#
# The target `ship_pages` copies what was bundled anew to src/web/built.

include(GNUInstallDirs)

option(ROCKYARD_PAGE_TOOLS
       "Install the npm packages with which pages are bundled and tested (needs node, npm)" OFF)

set(ROCKYARD_PAGE_FILES report.html replay.html bench.html THIRD_PARTY.txt)

# Installs the packages of the lock file below FOLDER, once for each lock file.
function(rockyard_install_npm_packages FOLDER)
  file(MAKE_DIRECTORY ${FOLDER})
  foreach(file package.json package-lock.json)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    configure_file(${file} ${FOLDER}/${file} COPYONLY)
  endforeach()
  file(SHA256 ${FOLDER}/package-lock.json wanted)
  set(stamp ${FOLDER}/installed.txt)
  if(EXISTS ${stamp})
    file(READ ${stamp} installed)
    if(installed STREQUAL wanted)
      return()
    endif()
  endif()
  message(STATUS "Installing the npm packages of the pages")
  file(REMOVE ${stamp})  # npm ci begins by removing what the stamp vouches for
  # No package needs its install script, and none may run one.
  execute_process(COMMAND ${ROCKYARD_NPM} ci --ignore-scripts --no-audit --no-fund
            --fetch-retries=1
    WORKING_DIRECTORY ${FOLDER} TIMEOUT 300 RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "ROCKYARD_PAGE_TOOLS is ON, but npm ci failed:\n${output}")
  endif()
  file(WRITE ${stamp} ${wanted})
endfunction()

function(rockyard_find_node)
  find_program(ROCKYARD_NODE NAMES node nodejs)
  find_program(ROCKYARD_NPM npm)
  mark_as_advanced(ROCKYARD_NODE ROCKYARD_NPM)
  if(NOT ROCKYARD_NODE OR NOT ROCKYARD_NPM)
    message(FATAL_ERROR "ROCKYARD_PAGE_TOOLS is ON, but nodejs and npm were not found "
                        "(scripts/install_dependencies.sh pages)")
  endif()
  execute_process(COMMAND ${ROCKYARD_NODE} --version OUTPUT_VARIABLE version
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REGEX REPLACE "^v" "" version "${version}")
  if(version VERSION_LESS 18)
    message(FATAL_ERROR "node is of version ${version}, and the pages need 18 or later")
  endif()
endfunction()

# Bundles the pages below the build folder; sets FOLDER_VARIABLE to where they are.
function(rockyard_bundle_pages FOLDER_VARIABLE)
  rockyard_find_node()
  set(work ${PROJECT_BINARY_DIR}/web)
  rockyard_install_npm_packages(${work})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
    *.ts *.css *.mjs page.html tsconfig.json)
  list(FILTER sources EXCLUDE REGEX "^(built|node_modules)/")
  # Copies of files that are gone would still be checked and might be bundled.
  file(GLOB_RECURSE old RELATIVE ${work} ${work}/report/* ${work}/replay/* ${work}/bench/* ${work}/shared/*)
  list(REMOVE_ITEM old ${sources})
  foreach(file ${old})
    file(REMOVE ${work}/${file})
  endforeach()
  # Bundled from copies beside node_modules, so that nothing is installed into the source tree.
  set(copies)
  foreach(file ${sources})
    add_custom_command(OUTPUT ${work}/${file} DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file}
      COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_CURRENT_SOURCE_DIR}/${file} ${work}/${file})
    list(APPEND copies ${work}/${file})
  endforeach()
  set(pages ${work}/pages)
  list(TRANSFORM ROCKYARD_PAGE_FILES PREPEND ${pages}/ OUTPUT_VARIABLE files)
  add_custom_command(OUTPUT ${files} DEPENDS ${copies} ${work}/installed.txt
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}  # what is bundled no more
    COMMAND ${ROCKYARD_NODE} build.mjs ${pages} WORKING_DIRECTORY ${work}
    COMMENT "Bundling the pages for a browser")
  add_custom_target(ship_pages DEPENDS ${files}
    COMMAND ${CMAKE_COMMAND} -E copy ${files} ${CMAKE_CURRENT_SOURCE_DIR}/built
    COMMENT "Copying the pages to src/web/built")
  set(${FOLDER_VARIABLE} ${pages} PARENT_SCOPE)
endfunction()

function(rockyard_embed_pages SOURCE_VARIABLE)
  set(pages ${CMAKE_CURRENT_SOURCE_DIR}/built)
  unset(ROCKYARD_PAGES_FOLDER CACHE)
  if(ROCKYARD_PAGE_TOOLS)
    rockyard_bundle_pages(pages)
    set(ROCKYARD_PAGES_FOLDER ${PROJECT_BINARY_DIR}/web CACHE INTERNAL
        "Where the npm packages of the pages are")
  endif()
  set(script ${PROJECT_SOURCE_DIR}/scripts/cmake/embed_pages.cmake)
  set(ROCKYARD_EMBEDDED_PAGES ${pages} CACHE INTERNAL "The pages that the program holds")
  set(embedded ${PROJECT_BINARY_DIR}/embedded_pages.cc)
  add_custom_command(OUTPUT ${embedded} DEPENDS ${script} ${pages}/report.html ${pages}/replay.html ${pages}/bench.html
    COMMAND ${CMAKE_COMMAND} -DPAGES=${pages} -DOUT=${embedded} -P ${script}
    COMMENT "Embedding the pages for a browser")
  # Compilers warn of literals of this length.
  set_source_files_properties(${embedded} PROPERTIES COMPILE_OPTIONS "-w" SKIP_UNITY_BUILD_INCLUSION ON)
  set(${SOURCE_VARIABLE} ${embedded} PARENT_SCOPE)
  install(FILES built/THIRD_PARTY.txt DESTINATION ${CMAKE_INSTALL_DOCDIR})
endfunction()
