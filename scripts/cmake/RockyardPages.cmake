# The pages for a browser, bundled from npm packages that package-lock.json pins.
#
# rockyard_bundle_pages(SOURCE_VARIABLE)
#   Sets SOURCE_VARIABLE to the .cc file that holds the pages: the bundled ones, or, where npm is
#   missing or its packages cannot be fetched, no_pages.cc, and says what is then left out.
#
# ROCKYARD_PAGES: AUTO bundles where it can, ON insists, OFF leaves the pages out.

include(GNUInstallDirs)

set(ROCKYARD_PAGES AUTO CACHE STRING "Pages for a browser: AUTO, ON or OFF")
set_property(CACHE ROCKYARD_PAGES PROPERTY STRINGS AUTO ON OFF)

# Says why there are no pages; fatal where they were insisted on.
function(rockyard_without_pages reason)
  if(ROCKYARD_PAGES STREQUAL "AUTO")
    message(WARNING "Pages for a browser are left out (`rockyard report`, the 3-D page of "
                   "`rockyard replay`): ${reason}")
  else()
    message(FATAL_ERROR "ROCKYARD_PAGES is ON, but ${reason}")
  endif()
endfunction()

# Installs the packages of the lock file below FOLDER, once for each lock file. Sets REASON_VARIABLE
# to why they are not there, or to nothing.
function(rockyard_install_npm_packages FOLDER REASON_VARIABLE)
  set(${REASON_VARIABLE} "" PARENT_SCOPE)
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
    set(${REASON_VARIABLE} "npm ci failed:\n${output}" PARENT_SCOPE)
    return()
  endif()
  file(WRITE ${stamp} ${wanted})
endfunction()

function(rockyard_bundle_pages SOURCE_VARIABLE)
  set(${SOURCE_VARIABLE} no_pages.cc PARENT_SCOPE)
  unset(ROCKYARD_PAGES_FOLDER CACHE)
  if(NOT ROCKYARD_PAGES MATCHES "^(AUTO|ON|OFF)$")
    message(FATAL_ERROR "ROCKYARD_PAGES is '${ROCKYARD_PAGES}': say AUTO, ON or OFF")
  elseif(ROCKYARD_PAGES STREQUAL "OFF")
    return()
  endif()
  find_program(ROCKYARD_NODE NAMES node nodejs)
  find_program(ROCKYARD_NPM npm)
  mark_as_advanced(ROCKYARD_NODE ROCKYARD_NPM)
  if(NOT ROCKYARD_NODE OR NOT ROCKYARD_NPM)
    rockyard_without_pages("nodejs and npm were not found (scripts/install_dependencies.sh pages)")
    return()
  endif()
  execute_process(COMMAND ${ROCKYARD_NODE} --version OUTPUT_VARIABLE version
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REGEX REPLACE "^v" "" version "${version}")
  if(version VERSION_LESS 18)
    rockyard_without_pages("node is of version ${version}, and the pages need 18 or later")
    return()
  endif()
  set(work ${PROJECT_BINARY_DIR}/web)
  rockyard_install_npm_packages(${work} reason)
  if(reason)
    rockyard_without_pages("${reason}")
    return()
  endif()

  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
    *.ts *.css *.html *.mjs tsconfig.json)
  list(FILTER sources EXCLUDE REGEX "node_modules")
  # Copies of files that are gone would still be checked and might be bundled.
  file(GLOB_RECURSE old RELATIVE ${work} ${work}/report/* ${work}/replay/* ${work}/shared/* ${work}/mcap/*)
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
  set(bundled ${pages}/bundled_pages.cc)
  add_custom_command(OUTPUT ${bundled} ${pages}/report.html ${pages}/replay.html ${pages}/trace_to_mcap.mjs
      ${pages}/THIRD_PARTY.txt
    DEPENDS ${copies} ${work}/installed.txt
    COMMAND ${ROCKYARD_NODE} build.mjs ${pages} WORKING_DIRECTORY ${work}
    COMMENT "Bundling the pages for a browser")
  # Compilers warn of literals of this length.
  set_source_files_properties(${bundled} PROPERTIES COMPILE_OPTIONS "-w")
  set(${SOURCE_VARIABLE} ${bundled} PARENT_SCOPE)
  install(FILES ${pages}/THIRD_PARTY.txt DESTINATION ${CMAKE_INSTALL_DOCDIR})
  set(ROCKYARD_PAGES_FOLDER ${work} CACHE INTERNAL "Where the npm packages of the pages are")
endfunction()
