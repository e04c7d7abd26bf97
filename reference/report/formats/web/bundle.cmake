# cmake -DSOURCE=... -DWORK=... -DOUT=... -DMODE=ON|AUTO -P bundle.cmake
# Works in a copy, so that the source folder stays as it is. AUTO: where the bundler fails (no
# network for `npm ci`), the program is built without the page, with a warning.
function(fall_back what)
  if(MODE STREQUAL "ON")
    message(FATAL_ERROR "HTML report: ${what}")
  endif()
  message(WARNING "HTML report: ${what} The program is built without it: reports are Markdown, CSV "
                  "and SVG. To try again, build after: cmake -E rm \"${OUT}\"")
  file(COPY_FILE ${SOURCE}/no_template.cpp ${OUT})
endfunction()

file(MAKE_DIRECTORY ${WORK})
file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/tsconfig.json
     ${SOURCE}/build.mjs ${SOURCE}/template.html DESTINATION ${WORK})
file(REMOVE_RECURSE ${WORK}/src)
file(COPY ${SOURCE}/src DESTINATION ${WORK})

file(SHA256 ${WORK}/package-lock.json lock)
if(NOT EXISTS ${WORK}/node_modules/.${lock})
  execute_process(COMMAND ${NPM} ci --no-audit --no-fund --ignore-scripts --loglevel=error
                  WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed OUTPUT_QUIET)
  if(failed)
    fall_back("`npm ci` failed.")
    return()
  endif()
  file(TOUCH ${WORK}/node_modules/.${lock})
endif()
execute_process(COMMAND ${NPM} run --silent check WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "HTML report: the type checker found a mistake in ${SOURCE}/src.")
endif()
execute_process(COMMAND ${NPM} run --silent build -- ${OUT} ${WORK}/page.html
                WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "HTML report: the bundler failed.")
endif()
