# `cmake --install` and cpack run this file. It checks that the script which makes reports interactive exists. If the
# script is missing or older than its sources, npm builds it, after any build of it by ./skein has ended. Without the
# script, the installation fails, unless SKEIN_WITHOUT_WEB=1 is in the environment: a user must decide to have static
# reports. SKEIN_ROOT: the source tree.
set(bundle ${SKEIN_ROOT}/build/web/report.js)
if("$ENV{SKEIN_WITHOUT_WEB}")
  if(NOT EXISTS ${bundle})
    message(STATUS "SKEIN_WITHOUT_WEB: ${bundle} is missing, so reports will not be interactive")
  endif()
  return()
endif()

file(GLOB_RECURSE sources ${SKEIN_ROOT}/web/src/*)
list(APPEND sources ${SKEIN_ROOT}/web/package-lock.json)
set(wanted OFF)
foreach(source ${sources})
  if(${source} IS_NEWER_THAN ${bundle})  # also true if there is no bundle
    set(wanted ON)
  endif()
endforeach()
find_program(npm npm)
find_program(flock flock)
if(wanted AND npm AND flock)
  message(STATUS "building ${bundle}")
  file(MAKE_DIRECTORY ${SKEIN_ROOT}/build/web)
  execute_process(
    COMMAND ${flock} ${SKEIN_ROOT}/build/web/lock
            sh -c "npm ci --ignore-scripts --no-audit --no-fund && npm run build"
    WORKING_DIRECTORY ${SKEIN_ROOT}/web OUTPUT_FILE ${SKEIN_ROOT}/build/web/build.log
    ERROR_FILE ${SKEIN_ROOT}/build/web/build.log RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "npm could not build ${bundle}: see ${SKEIN_ROOT}/build/web/build.log. "
                        "SKEIN_WITHOUT_WEB=1 installs without; reports are then not interactive")
  endif()
elseif(NOT EXISTS ${bundle})
  message(FATAL_ERROR "${bundle} is missing, and there is no npm to build it: install npm and Node.js 18 or newer. "
                      "SKEIN_WITHOUT_WEB=1 installs without; reports are then not interactive")
endif()
