# What rossmarie_add_guard() does for either build system. Both packages install this file.

# Generate the node of some rules into a folder of the build, as a part of this package, whenever
# cmake configures it. cmake configures again when a file that the rules rest on has changed.
#
# Sets ROSSMARIE_FOLDER, ROSSMARIE_HOOKS and ROSSMARIE_PARAMETERS for the generated guard.cmake.
macro(_rossmarie_generate target name rules)
  cmake_parse_arguments(_rossmarie "" "HOOKS;PARAMETERS" "SYSTEM;MESSAGES" ${ARGN})
  if(_rossmarie_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR
      "rossmarie_add_guard(${name}): unknown arguments: ${_rossmarie_UNPARSED_ARGUMENTS}. It takes "
      "rossmarie_add_guard(NAME RULES [HOOKS FILE] [PARAMETERS FILE] [SYSTEM FILE...] "
      "[MESSAGES FOLDER...])")
  endif()
  if(TARGET ${name}_safety_core)
    message(FATAL_ERROR
      "rossmarie_add_guard(${name}): there is a guard of this name; give this one another name")
  endif()

  find_program(ROSSMARIE_EXECUTABLE rossmarie)
  if(NOT ROSSMARIE_EXECUTABLE)
    message(FATAL_ERROR
      "rossmarie_add_guard(${name}): the program rossmarie is not on the PATH. Install it, or name "
      "it by -DROSSMARIE_EXECUTABLE=/path/to/rossmarie")
  endif()

  set(ROSSMARIE_FOLDER ${CMAKE_CURRENT_BINARY_DIR}/rossmarie/${name})
  set(_rossmarie_sources ${CMAKE_CURRENT_BINARY_DIR}/rossmarie/${name}.sources)
  get_filename_component(_rossmarie_rules ${rules} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${_rossmarie_rules})
  set(_rossmarie_options "")
  foreach(_rossmarie_file IN LISTS _rossmarie_SYSTEM)
    get_filename_component(_rossmarie_file ${_rossmarie_file} ABSOLUTE)
    list(APPEND _rossmarie_options --system ${_rossmarie_file})
  endforeach()
  foreach(_rossmarie_file IN LISTS _rossmarie_MESSAGES)
    get_filename_component(_rossmarie_file ${_rossmarie_file} ABSOLUTE)
    list(APPEND _rossmarie_options --messages ${_rossmarie_file})
  endforeach()

  # Python packages of ROS are no concern of the program, which has its own.
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env --unset=PYTHONPATH --unset=PYTHONHOME
      ${ROSSMARIE_EXECUTABLE} build ${_rossmarie_rules} --target ${target}
      --part-of ${PROJECT_NAME} --name ${name} --out ${ROSSMARIE_FOLDER}
      --sources ${_rossmarie_sources} ${_rossmarie_options}
    RESULT_VARIABLE _rossmarie_result
    OUTPUT_VARIABLE _rossmarie_output
    ERROR_VARIABLE _rossmarie_output)
  if(NOT _rossmarie_result EQUAL 0)
    message("${_rossmarie_output}")
    message(FATAL_ERROR
      "rossmarie_add_guard(${name}): ${rules} cannot be built; the reason is above")
  endif()
  if(_rossmarie_output MATCHES "warning\\[")
    message("${_rossmarie_output}")
  endif()
  file(STRINGS ${_rossmarie_sources} _rossmarie_files REGEX "^[^#]")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${_rossmarie_files})

  set(ROSSMARIE_HOOKS "")
  if(_rossmarie_HOOKS)
    get_filename_component(ROSSMARIE_HOOKS ${_rossmarie_HOOKS} ABSOLUTE)
  endif()
  set(ROSSMARIE_PARAMETERS "")
  if(_rossmarie_PARAMETERS)
    get_filename_component(ROSSMARIE_PARAMETERS ${_rossmarie_PARAMETERS} ABSOLUTE)
  endif()
endmacro()

# Refuse a package.xml that lacks what the generated node needs; else it would depend on chance
# whether that is built before. ARGN are further elements that every guard needs, such as
# exec_depend:launch_ros. Refuse rules whose hooks nobody defines.
macro(_rossmarie_check name)
  include(${ROSSMARIE_FOLDER}/needs.cmake)
  set(_rossmarie_lacking "")
  foreach(_rossmarie_used IN LISTS _guard_uses)
    if(NOT _rossmarie_used IN_LIST ${PROJECT_NAME}_BUILD_DEPENDS
        OR NOT _rossmarie_used IN_LIST ${PROJECT_NAME}_EXEC_DEPENDS)
      string(APPEND _rossmarie_lacking "  <depend>${_rossmarie_used}</depend>\n")
    endif()
  endforeach()
  foreach(_rossmarie_used ${ARGN})
    string(REPLACE ":" ";" _rossmarie_used "${_rossmarie_used}")
    list(GET _rossmarie_used 0 _rossmarie_kind)
    list(GET _rossmarie_used 1 _rossmarie_package)
    string(TOUPPER ${_rossmarie_kind} _rossmarie_upper)
    if(NOT _rossmarie_package IN_LIST ${PROJECT_NAME}_${_rossmarie_upper}S
        AND NOT _rossmarie_package IN_LIST ${PROJECT_NAME}_BUILDTOOL_DEPENDS)
      string(APPEND _rossmarie_lacking
        "  <${_rossmarie_kind}>${_rossmarie_package}</${_rossmarie_kind}>\n")
    endif()
  endforeach()
  if(_rossmarie_lacking)
    message(FATAL_ERROR
      "rossmarie_add_guard(${name}): package.xml of ${PROJECT_NAME} lacks what the node needs. "
      "Add these lines:\n${_rossmarie_lacking}")
  endif()
  if(_guard_hook_functions AND NOT ROSSMARIE_HOOKS)
    string(REPLACE ";" ", " _rossmarie_called "${_guard_hook_functions}")
    message(FATAL_ERROR
      "rossmarie_add_guard(${name}): the rules call hooks (${_rossmarie_called}). Name the file that "
      "defines them: HOOKS src/hooks.cpp. To begin, copy ${ROSSMARIE_FOLDER}/src/hooks.cpp")
  endif()
endmacro()
