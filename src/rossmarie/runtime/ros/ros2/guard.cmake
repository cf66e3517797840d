# Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
#
# Builds and installs the node that needs.cmake describes, as a part of the package that includes
# this file.
include(${CMAKE_CURRENT_LIST_DIR}/../core.cmake)

find_package(rosidl_default_generators REQUIRED)
foreach(_guard_used IN LISTS _guard_uses)
  find_package(${_guard_used} REQUIRED)
endforeach()

# All guards have the same messages, so the guards of one package share them.
if(NOT _guard_interfaces)
  rosidl_generate_interfaces(${PROJECT_NAME}
    ${_guard_folder}:msg/State.msg
    ${_guard_folder}:msg/TaskState.msg
    ${_guard_folder}:msg/Value.msg
    ${_guard_folder}:msg/Verdict.msg
    ${_guard_folder}:srv/Exempt.srv
    ${_guard_folder}:srv/Reset.srv
    ${_guard_folder}:srv/Why.srv
    DEPENDENCIES builtin_interfaces)
  rosidl_get_typesupport_target(_guard_interfaces ${PROJECT_NAME} rosidl_typesupport_cpp)
endif()

add_library(${_guard_node}_node SHARED
  ${_guard_folder}/src/component.cpp
  ${_guard_sources})
target_compile_options(${_guard_node}_node PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic)
set_target_properties(${_guard_node}_node PROPERTIES
  CXX_STANDARD 17
  CXX_STANDARD_REQUIRED ON
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON)
target_include_directories(${_guard_node}_node PRIVATE
  ${_guard_folder}/runtime/ros2 ${_guard_includes})
ament_target_dependencies(${_guard_node}_node SYSTEM ${_guard_uses})
target_link_libraries(${_guard_node}_node ${_guard_node}_core ${_guard_interfaces} m)
rclcpp_components_register_node(${_guard_node}_node
  PLUGIN "${_guard_node}::SafetyNode" EXECUTABLE ${_guard_executable})

install(TARGETS ${_guard_node}_node
  ARCHIVE DESTINATION lib LIBRARY DESTINATION lib RUNTIME DESTINATION bin)
install(FILES ${_guard_folder}/launch/${_guard_node}.launch.py
  DESTINATION share/${PROJECT_NAME}/launch)
install(FILES ${_guard_parameters}
  DESTINATION share/${PROJECT_NAME}/config RENAME ${_guard_settings})
install(FILES ${_guard_folder}/security/policy.xml
  DESTINATION share/${PROJECT_NAME}/security RENAME ${_guard_policy})

if(BUILD_TESTING)
  _guard_add_test()
endif()
