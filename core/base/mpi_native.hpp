#pragma once

// MPI's own types, for the few files that pass a communicator to a library.

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include "core/base/mpi.hpp"

namespace tushar::mpi {

struct Communicator::Native {
  MPI_Comm ranks = MPI_COMM_NULL;

  explicit Native(MPI_Comm all) : ranks(all) {}
  Native(const Native&) = delete;
  Native& operator=(const Native&) = delete;
  ~Native() {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (!finalized) MPI_Comm_free(&ranks);
  }
};

/// MPI's handle of the communicator. For a single rank, MPI must have been initialised.
inline MPI_Comm handleOf(const Communicator& ranks) { return ranks.native() ? ranks.native()->ranks : MPI_COMM_SELF; }

}  // namespace tushar::mpi
