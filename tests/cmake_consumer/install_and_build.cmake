# Installs BUILD_DIR into an empty prefix below WORK_DIR, then configures, builds and runs the
# project in CONSUMER_DIR against it, whose cheats must not compile; then configures SOURCE_DIR without tests and benchmarks. Any step
# that fails ends the script with an error.

file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)
if(SANITIZE)
  set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
                        -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
                        -DCMAKE_PREFIX_PATH=${prefix} ${flags}
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build COMMAND_ERROR_IS_FATAL ANY)
file(MAKE_DIRECTORY ${WORK_DIR}/campaign)
execute_process(COMMAND ${WORK_DIR}/build/consumer ${WORK_DIR}/campaign COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK_DIR}/build/own_navigator COMMAND_ERROR_IS_FATAL ANY)

# A plugin as `rockyard new` begins it, built by headers alone, and the same as a process.
set(new ${prefix}/bin/rockyard new navigator mine)
execute_process(COMMAND ${new} --out ${WORK_DIR}/plugin OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${new} --out ${WORK_DIR}/process --python OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK_DIR}/plugin -B ${WORK_DIR}/plugin/build -G ${GENERATOR}
                        -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_PREFIX_PATH=${prefix}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/plugin/build OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
foreach(form plugin process)
  execute_process(COMMAND ${prefix}/bin/rockyard run ${WORK_DIR}/${form}/mine.json --trials 2 --quiet
                          --set rover.fidelity=quasi_static --out ${WORK_DIR}/${form}/run
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()

# No other header than the listed ones is installed, each below the root of its side.
file(STRINGS ${SOURCE_DIR}/src/public_headers.txt listed REGEX "^[^#]")
list(TRANSFORM listed REPLACE " " "/")
file(GLOB_RECURSE installed RELATIVE ${prefix}/include/rockyard ${prefix}/include/*)
list(SORT listed)
list(SORT installed)
if(NOT listed STREQUAL installed)
  message(FATAL_ERROR "installed: ${installed}\nlisted: ${listed}")
endif()

# refuses(CHEAT HEADER): building CHEAT fails, as there is no such header.
function(refuses cheat header)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build --target ${cheat}
                  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result EQUAL 0)
    message(FATAL_ERROR "a navigator can include ${header} (${cheat})")
  elseif(NOT output MATCHES "${header}[^\n]*(No such file|file not found)")
    message(FATAL_ERROR "${cheat} fails for another reason than ${header}:\n${output}")
  endif()
endfunction()
foreach(side cheat cheat_plugin cheat_world)
  refuses(${side}_terrain terrain/terrain.h)
  refuses(${side}_rover_state truth/rover_state.h)
endforeach()
refuses(cheat_record truth/record.h)
refuses(cheat_plugin_record truth/record.h)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build --target control_record
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/plain -G ${GENERATOR}
                        -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON
                        -DCMAKE_DISABLE_FIND_PACKAGE_benchmark=ON -DROCKYARD_BUILD_TESTS=OFF
                        -DROCKYARD_BUILD_BENCHMARKS=OFF
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
