# Included at each project() of a workspace: the files of its program are compiled as one, so that
# the headers of roscpp are read once, and templates that several files use are made once.
function(rossmarie_unite)
  if(TARGET ${PROJECT_NAME})
    get_target_property(type ${PROJECT_NAME} TYPE)
    if(type STREQUAL "EXECUTABLE")
      set_target_properties(${PROJECT_NAME} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
  endif()
endfunction()
cmake_language(DEFER CALL rossmarie_unite)
