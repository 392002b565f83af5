#pragma once

namespace tushar {

/// What this process has in memory, bytes: now, and at most since it started. Zero where the system does not tell.
struct ResidentMemory {
  double now = 0, peak = 0;
};
ResidentMemory residentMemory();

}  // namespace tushar
