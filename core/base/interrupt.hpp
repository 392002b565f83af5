#pragma once

namespace tushar {

/// From now on Ctrl-C and SIGTERM only take note that the run is to end after the step; a second one ends it at once.
void catchInterrupts();
/// Whether one has come.
bool isInterrupted();

}  // namespace tushar
