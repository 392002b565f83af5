#pragma once

#include <cstddef>

namespace tushar::data {

/// Requests large pages for a whole mapping, if the system provides them on request: fewer entries of page tables are
/// needed.
void adviseLargePages(void* memory, std::size_t bytes);

/// Requests small pages for memory of which few parts are used: large ones would take memory between them, too. Applies
/// to a whole mapping, which begins in the page of `memory`.
void adviseSmallPages(void* memory, std::size_t bytes);

}  // namespace tushar::data
