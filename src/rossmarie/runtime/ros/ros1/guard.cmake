# Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
#
# Builds and installs the node that needs.cmake describes, as a part of your package. Include this
# file before catkin_package().
include(${CMAKE_CURRENT_LIST_DIR}/../core.cmake)

find_package(catkin REQUIRED COMPONENTS message_generation ${_guard_uses})
find_package(Threads REQUIRED)
catkin_destinations()

# All guards have the same messages, so the guards of one package share them.
if(NOT _guard_has_messages)
  set(_guard_has_messages TRUE)
  set(_guard_services Exempt.srv Reset.srv Why.srv)
  add_message_files(BASE_DIR ${_guard_folder}/msg
    FILES State.msg TaskState.msg Value.msg Verdict.msg)
  # With an absolute folder, this macro would install the files in a wrong place.
  add_service_files(DIRECTORY ${_guard_folder}/srv FILES ${_guard_services} NOINSTALL)
  foreach(_guard_service IN LISTS _guard_services)
    list(APPEND ${PROJECT_NAME}_INSTALLED_SERVICE_FILES srv/${_guard_service})
    install(FILES ${_guard_folder}/srv/${_guard_service}
      DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/srv)
  endforeach()
  generate_messages(DEPENDENCIES std_msgs)
endif()

# SYSTEM suppresses warnings of -Wall in the headers of the system.
add_executable(${_guard_node}
  ${_guard_folder}/runtime/ros1/main.cpp
  ${_guard_sources})
add_dependencies(${_guard_node} ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
target_include_directories(${_guard_node} PRIVATE
  ${_guard_folder}/runtime/ros1 ${_guard_includes})
target_include_directories(${_guard_node} SYSTEM PRIVATE
  ${CATKIN_DEVEL_PREFIX}/include ${catkin_INCLUDE_DIRS})
target_compile_options(${_guard_node} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic)
set_target_properties(${_guard_node} PROPERTIES
  CXX_STANDARD 17
  CXX_STANDARD_REQUIRED ON
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
target_link_libraries(${_guard_node} ${_guard_node}_core ${catkin_LIBRARIES} Threads::Threads m)

# Run the test with: ctest --test-dir build/PACKAGE
if(CATKIN_ENABLE_TESTING)
  enable_testing()
  _guard_add_test()
endif()

install(TARGETS ${_guard_node} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(FILES
  ${_guard_folder}/launch/${_guard_node}.launch
  ${_guard_folder}/launch/${_guard_node}_robot.launch
  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/launch)
install(FILES ${_guard_parameters}
  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/config RENAME ${_guard_settings})
