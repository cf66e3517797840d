# Part of ROSSMARie, the same in each package: SHA256SUMS lists it. Change nothing here.
#
# Builds and installs the node of needs.cmake as a part of the package that includes this file. Two
# files may be the user's: those that ROSSMARIE_HOOKS and ROSSMARIE_PARAMETERS name.
get_filename_component(_guard_folder ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
include(${_guard_folder}/needs.cmake)
set(_guard_hooks ${_guard_folder}/src/hooks.cpp)
set(_guard_parameters ${_guard_folder}/config/parameters.yaml)
if(ROSSMARIE_HOOKS)
  set(_guard_hooks ${ROSSMARIE_HOOKS})
endif()
if(ROSSMARIE_PARAMETERS)
  set(_guard_parameters ${ROSSMARIE_PARAMETERS})
endif()

find_package(rosidl_default_generators REQUIRED)
foreach(_guard_used IN LISTS _guard_uses)
  find_package(${_guard_used} REQUIRED)
endforeach()

# The messages of all guards are the same, so those of one package share them.
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

# Numbers must come out as written: see the head of the monitor. Several of these components
# may be loaded into one process, so they hide their symbols.
add_library(${_guard_node}_core STATIC
  ${_guard_folder}/src/${_guard_code}_monitor.c
  ${_guard_folder}/src/${_guard_code}_reactor.c)
target_compile_options(${_guard_node}_core PRIVATE -ffp-contract=off -Wall -Wextra)
set_target_properties(${_guard_node}_core PROPERTIES
  C_STANDARD 99
  C_VISIBILITY_PRESET hidden
  POSITION_INDEPENDENT_CODE ON)

add_library(${_guard_node}_node SHARED
  ${_guard_folder}/runtime/guard.cpp
  ${_guard_folder}/runtime/operators.cpp
  ${_guard_folder}/runtime/telling.cpp
  ${_guard_folder}/runtime/settings.cpp
  ${_guard_folder}/src/component.cpp
  ${_guard_folder}/src/rules.cpp
  ${_guard_hooks})
target_compile_options(${_guard_node}_node PRIVATE -Wall -Wextra -Wpedantic)
set_target_properties(${_guard_node}_node PROPERTIES
  CXX_STANDARD 17
  CXX_STANDARD_REQUIRED ON
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON)
target_include_directories(${_guard_node}_node PRIVATE
  ${_guard_folder} ${_guard_folder}/runtime ${_guard_folder}/runtime/ros2 ${_guard_folder}/src)
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
  add_executable(${_guard_node}_test_reactions
    ${_guard_folder}/test/test_reactions.c
    ${_guard_folder}/src/${_guard_code}_reactor.c)
  target_include_directories(${_guard_node}_test_reactions PRIVATE ${_guard_folder}/src)
  target_compile_options(${_guard_node}_test_reactions PRIVATE -ffp-contract=off -Wall -Wextra)
  set_target_properties(${_guard_node}_test_reactions PROPERTIES C_STANDARD 99)
  target_link_libraries(${_guard_node}_test_reactions m)
  add_test(NAME ${_guard_node}_reactions COMMAND ${_guard_node}_test_reactions)
endif()
