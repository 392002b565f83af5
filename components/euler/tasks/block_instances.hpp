#pragma once

#include "components/euler/mixture.hpp"
#include "components/euler/tasks/advance_patch.hpp"

// The functions for blocks of cells that other components call, for each number of dimensions, law of a gas and kind of
// face values. TUSHAR_BLOCK_INSTANCES(, D) compiles them; TUSHAR_BLOCK_INSTANCES(extern, D) says that they are compiled
// elsewhere.

#define TUSHAR_BLOCK_FLUXES(WORD, D, AXIS, K)                                                                   \
  WORD template void addFluxes<D, AXIS, K>(double, const Box&, const ViewsOf<D, K, const double>&, Rows<D, K>&, \
                                           const ViewsOf<D, K, double>&, bool);
#define TUSHAR_BLOCK_AXIS(WORD, D, AXIS, SHAPE, G)                                                     \
  WORD template void computeFluxes<D, Hllc, SHAPE, AXIS, G>(const G&, const Box&, Work<D, kGases<G>>&, \
                                                            Rows<D, kGases<G>>&);

#define TUSHAR_BLOCK_AXES_1(WORD, MACRO, ...) MACRO(WORD, 1, 0, __VA_ARGS__)
#define TUSHAR_BLOCK_AXES_2(WORD, MACRO, ...) MACRO(WORD, 2, 0, __VA_ARGS__) MACRO(WORD, 2, 1, __VA_ARGS__)
#define TUSHAR_BLOCK_AXES_3(WORD, MACRO, ...) \
  MACRO(WORD, 3, 0, __VA_ARGS__) MACRO(WORD, 3, 1, __VA_ARGS__) MACRO(WORD, 3, 2, __VA_ARGS__)

#define TUSHAR_BLOCK_SHAPE(WORD, D, SHAPE, G)                                                                          \
  WORD template void advanceBlock<D, Hllc, SHAPE, G>(const G&, const Level&, const GhostRules<D>&, const Box&, double, \
                                                     const ViewsOf<D, kGases<G>, const double>&, Work<D, kGases<G>>&,  \
                                                     const ViewsOf<D, kGases<G>, double>&, const RimFluxes<D>&);       \
  TUSHAR_BLOCK_AXES_##D(WORD, TUSHAR_BLOCK_AXIS, SHAPE, G)

#define TUSHAR_BLOCK_LAW(WORD, D, G)                                                                               \
  TUSHAR_BLOCK_SHAPE(WORD, D, Constant, G)                                                                         \
  TUSHAR_BLOCK_SHAPE(WORD, D, Sloped<VanLeer>, G)                                                                  \
  WORD template void recover<D, G>(const G&, const Level&, const Box&, const ViewsOf<D, kGases<G>, const double>&, \
                                   Rows<D, kGases<G>>&);                                                           \
  WORD template void predict<D, VanLeer, G>(const G&, const Level&, const Box&, double, Work<D, kGases<G>>&,       \
                                            Sloped<VanLeer>);

#define TUSHAR_BLOCK_INSTANCES(WORD, D)                                                                   \
  TUSHAR_BLOCK_LAW(WORD, D, StiffenedGas)                                                                 \
  TUSHAR_BLOCK_LAW(WORD, D, Gas)                                                                          \
  TUSHAR_BLOCK_LAW(WORD, D, Mixture<2>)                                                                   \
  TUSHAR_BLOCK_LAW(WORD, D, Mixture<3>)                                                                   \
  TUSHAR_BLOCK_AXES_##D(WORD, TUSHAR_BLOCK_FLUXES, 1) TUSHAR_BLOCK_AXES_##D(WORD, TUSHAR_BLOCK_FLUXES, 2) \
      TUSHAR_BLOCK_AXES_##D(WORD, TUSHAR_BLOCK_FLUXES, 3)
