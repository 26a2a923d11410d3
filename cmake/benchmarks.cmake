# The target `benchmarks`: the programs that scripts/bench and scripts/causes run. Two of them need
# Google Benchmark and MuJoCo, and are left out where those are not there.

if(NOT TARGET benchmarks)
  add_custom_target(benchmarks)
endif()

function(add_bench name)
  add_executable(${name} EXCLUDE_FROM_ALL ${ARGN})
  target_include_directories(${name} PRIVATE bench test)
  target_link_libraries(${name} cosserat_cable_rod)
  add_dependencies(benchmarks ${name})
endfunction()

add_bench(rod_steps bench/rod_steps.cpp bench/instruction_trace.cpp)
# At its own addresses, so that what is counted at an address can be looked up.
target_link_options(rod_steps PRIVATE -no-pie)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}" flags)
target_compile_definitions(rod_steps PRIVATE
  COSSERAT_CABLE_COMPILER="${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
  COSSERAT_CABLE_FLAGS="${flags}")

add_bench(cause_steps bench/cause_steps.cpp)
target_link_libraries(cause_steps cosserat_cable_measurement)

find_package(benchmark QUIET)
if(benchmark_FOUND)
  add_bench(rod_bench bench/rod_bench.cpp bench/fma_peak.cpp)
  target_link_libraries(rod_bench benchmark::benchmark)
endif()

# Not by its own CMake package: Debian's names a folder that nothing installs.
find_library(MUJOCO_LIBRARY mujoco)
find_path(MUJOCO_INCLUDE_DIR mujoco/mujoco.h)
if(MUJOCO_LIBRARY AND MUJOCO_INCLUDE_DIR)
  add_bench(mujoco_bench bench/mujoco_bench.cpp bench/mujoco_chain.cpp bench/peer_search.cpp)
  target_include_directories(mujoco_bench SYSTEM PRIVATE ${MUJOCO_INCLUDE_DIR})
  target_link_libraries(mujoco_bench ${MUJOCO_LIBRARY})
  # Measurement sets of another simulator, for cable_diagnose: docs/diagnosis.md.
  add_executable(mujoco_rig EXCLUDE_FROM_ALL test/peer/mujoco_rig.cpp
                 test/peer/mujoco_chain.cpp)
  target_include_directories(mujoco_rig SYSTEM PRIVATE ${MUJOCO_INCLUDE_DIR})
  target_link_libraries(mujoco_rig ${MUJOCO_LIBRARY} CLI11::CLI11)
  add_dependencies(benchmarks mujoco_rig)
endif()
