#pragma once

namespace tushar {

/// Installs the handlers of signals: the first Ctrl-C or SIGTERM ends the run after the current step, and the second
/// ends it immediately. SIGUSR1 requests that the state be saved after the current step. A file that exceeds the limit
/// of `ulimit -f` causes an error, but does not kill the process.
void catchInterrupts();
/// Whether Ctrl-C or SIGTERM has arrived.
bool isInterrupted();
/// Whether SIGUSR1 has arrived since the previous call.
bool takeSaveSignal();

}  // namespace tushar
