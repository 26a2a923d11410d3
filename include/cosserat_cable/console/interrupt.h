// SIGINT, SIGTERM and SIGHUP as a flag that is asked for between two messages, so that files can be
// closed.
#pragma once

namespace cosserat_cable {

/// From now on the signals only set the flag.
void CatchInterrupts();
bool Interrupted();

}  // namespace cosserat_cable
