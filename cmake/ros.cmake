# The ROS room: messages, the cosserat_cable_ros library, one executable per src/apps/*.cpp.

# catkin keeps the environment of the tests as it is when the project is configured, and leaves folders
# out that are not there yet: without this, a first build's tests do not find the messages' Python.
if(NOT DEFINED CATKIN_DEVEL_PREFIX)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages)
else()
  file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib/python3/dist-packages)
endif()
find_package(catkin REQUIRED COMPONENTS
  diagnostic_msgs
  geometry_msgs
  message_generation
  rosbag_storage
  roscpp
  roslz4
  sensor_msgs
  std_msgs
  tf2_msgs
  visualization_msgs
)

find_package(BZip2 REQUIRED)

add_message_files(DIRECTORY msg FILES ApexTelemetry.msg)
generate_messages(DEPENDENCIES std_msgs)

set(rooms
  cosserat_cable_ros
  cosserat_cable_vehicle
  cosserat_cable_identification
  cosserat_cable_measurement
  cosserat_cable_cable
  cosserat_cable_contact
  cosserat_cable_rod
  cosserat_cable_input
  cosserat_cable_console
  cosserat_cable_math
)
catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${rooms}
  CATKIN_DEPENDS diagnostic_msgs geometry_msgs message_runtime rosbag_storage roscpp
    roslz4 sensor_msgs std_msgs tf2_msgs visualization_msgs
  DEPENDS EIGEN3
)

file(GLOB ros_sources CONFIGURE_DEPENDS src/ros/*.cpp)
add_library(cosserat_cable_ros STATIC ${ros_sources})
add_dependencies(cosserat_cable_ros ${PROJECT_NAME}_generate_messages_cpp)
target_include_directories(cosserat_cable_ros PUBLIC include)
# Not ours: a warning in a message header is no reason to stop.
target_include_directories(cosserat_cable_ros SYSTEM PUBLIC
  ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION} ${catkin_INCLUDE_DIRS})
target_link_libraries(cosserat_cable_ros PUBLIC cosserat_cable_console cosserat_cable_cable cosserat_cable_vehicle
  ${catkin_LIBRARIES} BZip2::BZip2 TBB::tbb Threads::Threads)

foreach(room ${rooms})
  get_target_property(type ${room} TYPE)
  if(NOT type STREQUAL INTERFACE_LIBRARY)
    set_target_properties(${room} PROPERTIES
      ARCHIVE_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION})
    install(TARGETS ${room} ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
  endif()
endforeach()

# apex_check is a gtest program so that a .test file of any package can run it; it is built and
# installed where gtest is there.
find_package(GTest QUIET)
file(GLOB apps CONFIGURE_DEPENDS src/apps/*.cpp)
foreach(app ${apps})
  get_filename_component(name ${app} NAME_WE)
  if(name STREQUAL apex_check AND NOT GTest_FOUND)
    continue()
  endif()
  if(NOT TARGET ${name})
    add_executable(${name} ${app})
    target_link_libraries(${name} cosserat_cable_ros CLI11::CLI11)
  endif()
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  if(name STREQUAL apex_check)
    target_link_libraries(${name} GTest::gtest)
  endif()
  install(TARGETS ${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()

install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
foreach(folder launch config urdf)
  if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${folder} DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
  endif()
endforeach()

# The tools in Python find their shared code beside them.
catkin_install_python(PROGRAMS scripts/travel_to_bag scripts/bag_to_set scripts/plot_apex
  scripts/plot_modes scripts/identification_report scripts/diagnosis_report
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY scripts/pylib DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})

if(CATKIN_ENABLE_TESTING)
  find_package(GTest REQUIRED)
  find_package(rostest REQUIRED)
  find_package(tf2 REQUIRED)
  set(tools ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})

  file(GLOB sources CONFIGURE_DEPENDS test/ros/*_test.cpp)
  if(sources)
    add_executable(ros_test EXCLUDE_FROM_ALL ${sources})
    target_include_directories(ros_test PRIVATE test)
    target_compile_definitions(ros_test PRIVATE
      COSSERAT_CABLE_SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}")
    target_include_directories(ros_test SYSTEM PRIVATE ${tf2_INCLUDE_DIRS})
    target_link_libraries(ros_test cosserat_cable_ros ${tf2_LIBRARIES} GTest::gtest_main)
    add_test(NAME ros_test COMMAND ros_test)
    add_dependencies(tests ros_test)
  endif()

  foreach(name cli modes_cli options recordings_cli failures_cli streams_cli numbers_cli
    apex_check_cli damaged_bags_cli large_inputs_cli outputs_cli meshes_cli rviz)
    add_test(NAME ${name}_test
      COMMAND ${CATKIN_ENV} ${PYTHON_EXECUTABLE}
        ${CMAKE_CURRENT_SOURCE_DIR}/test/ros/${name}_test.py)
    set_tests_properties(${name}_test PROPERTIES ENVIRONMENT
      "COSSERAT_CABLE_SOURCE_DIR=${CMAKE_CURRENT_SOURCE_DIR};COSSERAT_CABLE_TOOLS_DIR=${tools}")
  endforeach()

  file(GLOB rostests CONFIGURE_DEPENDS test/ros/*.test)
  foreach(file ${rostests})
    add_rostest(${file} DEPENDENCIES cable_node cable_replay apex_check)
  endforeach()
  # What runs in real time has the machine to itself.
  get_property(all DIRECTORY PROPERTY TESTS)
  list(FILTER all INCLUDE REGEX "rostest|rviz_test")
  set_tests_properties(${all} PROPERTIES RUN_SERIAL TRUE)
endif()
