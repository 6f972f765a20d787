execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE HALFSTEP_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT HALFSTEP_COMMIT)
  set(HALFSTEP_COMMIT "unknown")
endif()
configure_file(${IN} ${OUT} @ONLY)
