// Which instructions a piece of code executes, and how often.
#pragma once

#include <cstdint>
#include <functional>
#include <map>

namespace cosserat_cable::bench {

/// Executions by address, of everything that `work` does after `prepare`, one instruction at a
/// time in a process of its own: slower by four orders of magnitude.
/// @throws std::runtime_error where the system does not let a process trace its child, or the
/// machine is none of x86-64
std::map<std::uint64_t, std::uint64_t> TraceInstructions(const std::function<void()>& prepare,
                                                         const std::function<void()>& work);

}  // namespace cosserat_cable::bench
