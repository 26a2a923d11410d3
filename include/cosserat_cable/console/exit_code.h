// What a tool's exit code says; the same for all tools.
#pragma once

namespace cosserat_cable {

enum ExitCode {
  kExitDone = 0,
  kExitBadInput = 2,      ///< every problem was listed, nothing was written
  kExitFailed = 3,        ///< the simulation failed for at least one cable; what exists was kept
  kExitFileTrouble = 4,   ///< a file could not be read or written whole; what exists was kept
  kExitInterrupted = 130  ///< by SIGINT, SIGTERM or SIGHUP; what exists was kept
};

}  // namespace cosserat_cable
