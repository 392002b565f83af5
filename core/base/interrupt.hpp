#pragma once

namespace tushar {

/// From now on the first Ctrl-C or SIGTERM ends the run after the current step, and the second ends it at once. SIGUSR1
/// requests that the state be saved after the step. A file that grows beyond `ulimit -f` is an error, not a kill.
void catchInterrupts();
/// Whether Ctrl-C or SIGTERM has arrived.
bool isInterrupted();
/// Whether SIGUSR1 has arrived since the last call.
bool takeSaveSignal();

}  // namespace tushar
