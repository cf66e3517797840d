# Included at each project() of a workspace: the programs and components of generated nodes are compiled
# with sanitizers. Libraries of messages are not: Python loads them, and was not.
function(rossmarie_sanitize)
  if(NOT PROJECT_NAME MATCHES "_safety$")
    return()
  endif()
  get_property(targets DIRECTORY PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(NOT type MATCHES "EXECUTABLE|SHARED_LIBRARY|STATIC_LIBRARY" OR target MATCHES "__")
      continue()
    endif()
    target_compile_options(${target} PRIVATE
      -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined)
    target_link_options(${target} PRIVATE -fsanitize=address,undefined)
  endforeach()
endfunction()
cmake_language(DEFER CALL rossmarie_sanitize)
