# Copies the headers of SOURCE to OUT, as they are installed: what they include of
# each other is named "halfstep/wpg/…" there, since "wpg/…" and "opt/…" may be other people's, too.
file(REMOVE_RECURSE ${OUT})
function(stage path name)
  file(READ ${path} text)
  string(REGEX REPLACE "#include \"(wpg|opt|planner|smoothing|experiments)/"
    "#include \"halfstep/\\1/" text "${text}")
  file(WRITE ${OUT}/${name} "${text}")
endfunction()
foreach(folder wpg planner opt smoothing experiments)
  file(GLOB_RECURSE headers RELATIVE ${SOURCE} ${SOURCE}/${folder}/*.h)
  foreach(header ${headers})
    if(NOT header MATCHES "^experiments/(examples|python|schema|report/node_modules)/" AND
        NOT header STREQUAL "smoothing/methods/accepted_in_parts.h" AND  # no way around Propose()
        NOT header STREQUAL "wpg/files/json_instances.h")  # of our precompiled headers alone
      stage(${SOURCE}/${header} ${header})
    endif()
  endforeach()
endforeach()
