# Read by ctest: a test for each suite of an executable, in one process. A program starts once for
# a suite then, and what its tests share is made once. Needs EXECUTABLE and LIST, the file that
# --gtest_list_tests made; LONG: SUITE=SECONDS of those that are begun first, the longest before the
# others, so that none is left alone at the end.
cmake_policy(VERSION 3.25)
if(NOT EXISTS ${LIST})
  add_test(${EXECUTABLE}_NOT_BUILT ${EXECUTABLE}_NOT_BUILT)
  return()
endif()
file(STRINGS ${LIST} suites REGEX "^[A-Za-z0-9_/]+[.]")  # lines of tests are indented
foreach(suite ${suites})
  string(REGEX REPLACE "[.].*" "" suite ${suite})
  add_test(${suite} ${EXECUTABLE} --gtest_filter=${suite}.*)
  set_tests_properties(${suite} PROPERTIES TIMEOUT 960)
  if(";${LONG};" MATCHES ";${suite}=([0-9]+);")
    set_tests_properties(${suite} PROPERTIES COST ${CMAKE_MATCH_1})
  endif()
endforeach()
