include(${rossmarie_ament_DIR}/rossmarie_generate.cmake)
include(${rossmarie_ament_DIR}/rossmarie_add_guard.cmake)
