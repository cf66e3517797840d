# Build the safety node of some rules as a part of this package:
#
#   rossmarie_add_guard(NAME RULES [HOOKS FILE] [PARAMETERS FILE] [SYSTEM FILE...] [MESSAGES FOLDER...])
#
# The node, its launch file and its settings are called NAME_safety. HOOKS is a C++ source that
# defines the hooks of the rules; PARAMETERS is a settings file that replaces the generated one. SYSTEM
# and MESSAGES are options of `rossmarie build`. Call it once for each node, before ament_package().
macro(rossmarie_add_guard name rules)
  if(_${PROJECT_NAME}_AMENT_PACKAGE)
    message(FATAL_ERROR "rossmarie_add_guard(${name}) must be called before ament_package()")
  endif()
  if(TARGET ${PROJECT_NAME} AND NOT _guard_interfaces)
    message(FATAL_ERROR
      "rossmarie_add_guard(${name}): ${PROJECT_NAME} has a target of its own name, such as its "
      "messages. A guard generates messages under that name: put the rules into another package")
  endif()
  find_package(ament_cmake REQUIRED)
  if(NOT _AMENT_PACKAGE_NAME)
    ament_package_xml()
  endif()
  _rossmarie_generate(ros2 ${name} ${rules} ${ARGN})
  _rossmarie_check(${name}
    build_depend:rosidl_default_generators
    exec_depend:rosidl_default_runtime
    exec_depend:launch_ros
    member_of_group:rosidl_interface_packages)
  include(${ROSSMARIE_FOLDER}/runtime/ros2/guard.cmake)
endmacro()
