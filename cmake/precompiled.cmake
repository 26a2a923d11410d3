# Headers that nearly every file reads, compiled once for all targets with the same flags: half of
# a build's time goes into reading them.
set(precompiled_headers <Eigen/Cholesky> <Eigen/Core> <Eigen/Geometry> <algorithm> <cmath>
  <functional> <map> <memory> <optional> <set> <sstream> <string> <vector>)

# The first target compiles them, the others have its flags and use them. Targets that do not exist
# are left out.
function(share_precompiled_headers first)
  target_precompile_headers(${first} PRIVATE ${precompiled_headers})
  foreach(target ${ARGN})
    if(TARGET ${target})
      target_precompile_headers(${target} REUSE_FROM ${first})
    endif()
  endforeach()
endfunction()
