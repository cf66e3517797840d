# Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
#
# The sources of the node for ROS 1 and ROS 2. The guard.cmake of each generation includes this
# file. ROSSMARIE_HOOKS and ROSSMARIE_PARAMETERS may name files of the user that replace the two
# defaults.
get_filename_component(_guard_folder ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)
include(${_guard_folder}/needs.cmake)
set(_guard_hooks ${_guard_folder}/src/hooks.cpp)
set(_guard_parameters ${_guard_folder}/config/parameters.yaml)
if(ROSSMARIE_HOOKS)
  set(_guard_hooks ${ROSSMARIE_HOOKS})
endif()
if(ROSSMARIE_PARAMETERS)
  set(_guard_parameters ${ROSSMARIE_PARAMETERS})
endif()
set(_guard_sources
  ${_guard_folder}/runtime/guard.cpp
  ${_guard_folder}/runtime/operators.cpp
  ${_guard_folder}/runtime/reporting.cpp
  ${_guard_folder}/runtime/settings.cpp
  ${_guard_folder}/src/rules.cpp
  ${_guard_hooks})
set(_guard_includes ${_guard_folder} ${_guard_folder}/runtime ${_guard_folder}/src)

# The compiler must not change floating-point results: see the head of the monitor. One process may
# load several nodes, so each node hides its symbols.
add_library(${_guard_node}_core STATIC
  ${_guard_folder}/src/${_guard_code}_monitor.c
  ${_guard_folder}/src/${_guard_code}_reactor.c)
target_compile_options(${_guard_node}_core PRIVATE -ffp-contract=off -Wall -Wextra)
set_target_properties(${_guard_node}_core PROPERTIES
  C_STANDARD 99
  C_VISIBILITY_PRESET hidden
  POSITION_INDEPENDENT_CODE ON)

# Adds the test of the immediate reactions of the rules.
macro(_guard_add_test)
  add_executable(${_guard_node}_test_reactions
    ${_guard_folder}/test/test_reactions.c
    ${_guard_folder}/src/${_guard_code}_reactor.c)
  target_include_directories(${_guard_node}_test_reactions PRIVATE ${_guard_folder}/src)
  target_compile_options(${_guard_node}_test_reactions PRIVATE -ffp-contract=off -Wall -Wextra)
  set_target_properties(${_guard_node}_test_reactions PROPERTIES C_STANDARD 99)
  target_link_libraries(${_guard_node}_test_reactions m)
  add_test(NAME ${_guard_node}_reactions COMMAND ${_guard_node}_test_reactions)
endmacro()
