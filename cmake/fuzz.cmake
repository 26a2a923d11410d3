# One libFuzzer program for each reader of what users name; scripts/fuzz builds and runs them.

set(fuzz_set ${CMAKE_CURRENT_SOURCE_DIR}/config/sets/template)
function(add_fuzz name)
  add_executable(${name}_fuzz test/fuzz/${name}_fuzz.cpp)
  target_include_directories(${name}_fuzz PRIVATE test/fuzz)
  target_compile_definitions(${name}_fuzz PRIVATE COSSERAT_CABLE_FUZZ_SET="${fuzz_set}")
  target_link_libraries(${name}_fuzz ${ARGN})
  target_link_options(${name}_fuzz PRIVATE -fsanitize=fuzzer)
endfunction()

add_fuzz(cable_file cosserat_cable_causes)
add_fuzz(measurement_set cosserat_cable_measurement)
add_fuzz(csv cosserat_cable_measurement)
add_fuzz(urdf cosserat_cable_vehicle)
add_fuzz(mesh cosserat_cable_contact)

# Of the ROS room the bag reader alone, which needs no messages of this package.
find_package(catkin QUIET COMPONENTS roscpp roslz4 sensor_msgs tf2_msgs)
find_package(BZip2 QUIET)
if(catkin_FOUND AND BZIP2_FOUND)
  add_fuzz(bag cosserat_cable_input ${catkin_LIBRARIES} BZip2::BZip2)
  set(sources bag_file bag_reader bag_records bag_message_sizes motion_topics conversions)
  list(TRANSFORM sources REPLACE "(.+)" "src/ros/\\1.cpp")
  target_sources(bag_fuzz PRIVATE ${sources})
  target_include_directories(bag_fuzz PRIVATE src/ros)
  target_include_directories(bag_fuzz SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
endif()
