// The most that one core can do: independent fused multiply-adds in registers, of the widest
// vectors there are.
#pragma once

namespace cosserat_cable::bench {

/// Runs some; how many floating-point operations they were (two each).
double RunFma();

}  // namespace cosserat_cable::bench
