# Build the safety node of some rules as a part of this package:
#
#   rossmarie_add_guard(NAME RULES [HOOKS FILE] [PARAMETERS FILE] [SYSTEM FILE...] [MESSAGES FOLDER...])
#
# The node, its launch file and its settings are called NAME_safety. HOOKS is a C++ source that
# defines the hooks of the rules; PARAMETERS is a settings file that replaces the generated one. SYSTEM
# and MESSAGES are options of `rossmarie build`. Call it once for each node, before catkin_package().
macro(rossmarie_add_guard name rules)
  if(${PROJECT_NAME}_CATKIN_PACKAGE)
    message(FATAL_ERROR "rossmarie_add_guard(${name}) must be called before catkin_package()")
  endif()
  if(${PROJECT_NAME}_GENERATE_MESSAGES AND NOT _guard_has_messages)
    message(FATAL_ERROR
      "rossmarie_add_guard(${name}): ${PROJECT_NAME} has called generate_messages(), and catkin "
      "allows that once. A guard generates messages: put the rules into another package")
  endif()
  find_package(catkin REQUIRED)
  if(NOT _CATKIN_CURRENT_PACKAGE)
    catkin_package_xml()
  endif()
  _rossmarie_generate(ros1 ${name} ${rules} ${ARGN})
  _rossmarie_check(${name} build_depend:message_generation exec_depend:message_runtime)

  # What this package has found of catkin stays as it is.
  foreach(_rossmarie_kept INCLUDE_DIRS LIBRARIES LIBRARY_DIRS EXPORTED_TARGETS)
    set(_rossmarie_${_rossmarie_kept} ${catkin_${_rossmarie_kept}})
  endforeach()
  include(${ROSSMARIE_FOLDER}/runtime/ros1/guard.cmake)
  foreach(_rossmarie_kept INCLUDE_DIRS LIBRARIES LIBRARY_DIRS EXPORTED_TARGETS)
    set(catkin_${_rossmarie_kept} ${_rossmarie_${_rossmarie_kept}})
  endforeach()

  # In the devel space, launch files find these as those of the source folder.
  set(_rossmarie_share ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_SHARE_DESTINATION})
  configure_file(${ROSSMARIE_FOLDER}/launch/${_guard_node}.launch
    ${_rossmarie_share}/launch/${_guard_node}.launch COPYONLY)
  configure_file(${ROSSMARIE_FOLDER}/launch/${_guard_node}_robot.launch
    ${_rossmarie_share}/launch/${_guard_node}_robot.launch COPYONLY)
  configure_file(${_guard_parameters} ${_rossmarie_share}/config/${_guard_settings} COPYONLY)
endmacro()
