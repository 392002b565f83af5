#pragma once

#include "components/mpm/solid/transfer/transfer.hpp"
#include "core/data/particle_set.hpp"

namespace tushar::mpm::solid {

/// The rows of nodes, on and around the patch, to which the particles of a view contribute, including ghost particles.
template <int D>
const data::TouchedRows& touchedRows(const ParticleView<const Vec<D>>& particles, int ghostNodes) {
  return particles.set().touched(ghostNodes, D);
}

/// Calls `visit(node)` for each node of the box to which the particles of a view contribute.
template <int D, class Visit>
void forEachTouchedNode(const ParticleView<const Vec<D>>& particles, int ghostNodes, const Box& box,
                        const Visit& visit) {
  touchedRows<D>(particles, ghostNodes).forEachRow(box, [&](const Index3& first, int end) {
    Index<D> node;
    for (int d = 0; d < D; ++d) node[d] = first[d];
    for (; node[0] < end; ++node[0]) visit(node);
  });
}

/// Access to records relative to the node `first`, whose own record need not be stored.
template <class Record, int D>
NodeWindow<Record, D> windowFrom(const NodeView<Record>& records, const Index<D>& first) {
  const Box& stored = records.stored();
  NodeWindow<Record, D> window;
  std::ptrdiff_t at = 0, stride = 1;
  for (int d = 0; d < D; ++d) {
    window.stride[d] = stride;
    at += (first[d] - stored.lower[d]) * stride;
    stride *= stored.extent(d);
  }
  window.origin = records.values() + at;
  return window;
}

/// Access to the records of a stencil's nodes. Throws AccessError in the dev preset if some are not stored.
template <class Record, class Stencil, int D = Stencil::dimension>
NodeWindow<Record, D> windowOf(const NodeView<Record>& records, const Stencil& stencil) {
  const Box& stored = records.stored();
  if constexpr (data::checked) {
    Index<D> last = stencil.first;
    for (int d = 0; d < D; ++d) last[d] += Stencil::nodes - 1;
    if (!stored.contains(stencil.first) || !stored.contains(last))
      throw data::AccessError("a particle touches nodes outside those that are stored");
  }
  return windowFrom(records, stencil.first);
}

}  // namespace tushar::mpm::solid
