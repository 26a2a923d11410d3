# Headers that nearly every file reads, compiled once for all targets with the same flags: reading
# them takes some two seconds of each file's compilation.
set(precompiled_headers <Eigen/Cholesky> <Eigen/Core> <Eigen/Geometry> <algorithm> <cmath>
  <functional> <map> <memory> <optional> <set> <sstream> <string> <vector>)

# The first target compiles them, the others have its flags and use them.
function(share_precompiled_headers first)
  target_precompile_headers(${first} PRIVATE ${precompiled_headers})
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM ${first})
  endforeach()
endfunction()
