// What every program does around its own work: it ends with an exit code and a sentence, whatever
// happens to its streams and its memory.
#pragma once

#include <functional>

namespace cosserat_cable {

/// Runs a program's work and returns its exit code.
///
/// A closed pipe and a limit on the size of files end no run by a signal: what cannot be written is
/// reported where it is written. Where the standard output could not be written whole, a run that
/// was otherwise good ends with kExitFileTrouble. A standard stream that is closed is opened to
/// nowhere, so that no file of the run takes its number. An exception that nobody caught is a
/// sentence and kExitFailed.
int RunTool(const std::function<int()>& work);

}  // namespace cosserat_cable
