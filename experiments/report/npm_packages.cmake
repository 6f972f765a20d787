# halfstep_npm_packages(FROM TO RESULT): the packages that FROM/package-lock.json names, in the
# folder TO/node_modules; fetched once. RESULT: whether they are there.
find_program(HALFSTEP_NPM npm)

function(halfstep_npm_packages from to result)
  set(${result} FALSE PARENT_SCOPE)
  if(NOT HALFSTEP_NPM)
    return()
  endif()
  foreach(file package.json package-lock.json .npmrc)
    configure_file(${from}/${file} ${to}/${file} COPYONLY)  # configures again when it changes
  endforeach()
  file(SHA256 ${to}/package-lock.json lock)
  if(EXISTS ${to}/fetched)
    file(READ ${to}/fetched fetched)
  endif()
  if(NOT "${fetched}" STREQUAL "${lock}")
    message(STATUS "Fetching the npm packages of ${from}")
    execute_process(
      COMMAND ${HALFSTEP_NPM} ci --ignore-scripts --no-audit --no-fund
              --fetch-retry-mintimeout=1000 --fetch-retry-maxtimeout=3000
      WORKING_DIRECTORY ${to} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE reason)
    if(failed)
      message(STATUS "${reason}")
      return()
    endif()
    file(WRITE ${to}/fetched ${lock})
  endif()
  set(${result} TRUE PARENT_SCOPE)
endfunction()
