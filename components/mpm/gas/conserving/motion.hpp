#pragma once

#include <algorithm>
#include <memory>

#include "components/mpm/gas/conserving/footprint.hpp"
#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/conserving/scheme.hpp"

namespace tushar::mpm::gas::conserving {

/// Views of the variables that updateParticles reads and writes.
template <int D>
struct ParticleUpdate {
  // Particles at the start of the step.
  ParticleView<const Vec<D>> x, edges, velocity;
  ParticleView<const Modes<D>> modes;
  ParticleView<const double> internalEnergy, affineEnergy;
  // The grid.
  NodeView<const Vec<D>> nodeVelocity, acceleration;
  NodeView<const double> relaxation;
  CellView<const double> work;
  // Particles at the end of the step.
  ParticleView<Vec<D>> newX, newEdges, newVelocity;
  ParticleView<Modes<D>> newModes;
  ParticleView<double> newInternalEnergy, newAffineEnergy;

  static ParticleUpdate from(auto& take) {
    constexpr int overhang = Footprint<D>::overhang;
    return {.x = take(requiresOld(p::x<D>)),
            .edges = take(requiresOld(p::edges<D>)),
            .velocity = take(requiresOld(p::velocity<D>)),
            .modes = take(requiresOld(p::modes<D>)),
            .internalEnergy = take(requiresOld(p::internalEnergy)),
            .affineEnergy = take(requiresOld(p::affineEnergy)),
            .nodeVelocity = take(requiresOld(g::velocity<D>, overhang)),
            .acceleration = take(requiresNew(g::acceleration<D>, overhang)),
            .relaxation = take(requiresNew(g::relaxation, overhang)),
            .work = take(requiresNew(c::work, overhang)),
            .newX = take(computes(p::x<D>)),
            .newEdges = take(computes(p::edges<D>)),
            .newVelocity = take(computes(p::velocity<D>)),
            .newModes = take(computes(p::modes<D>)),
            .newInternalEnergy = take(computes(p::internalEnergy)),
            .newAffineEnergy = take(computes(p::affineEnergy))};
  }
};

/// The sum of the squares of the components of vectors.
template <int D>
[[gnu::always_inline]] inline Lanes squareOf(const LanesVec<D>& v) {
  Lanes sum = v[0] * v[0];
  for (int d = 1; d < D; ++d) sum = multiplyAdd(v[d], v[d], sum);
  return sum;
}

/// Grid fields from which the particles of a slab of cells are updated: a plane of cells in three dimensions, a row in
/// two. Each slab needs few others of nodes and cells, which are computed in turn in the same memory, so that they stay
/// in the caches of the processor. Where the patch has no values, they are 0.
///
/// At nodes: v; y = v + dt a (apic) or dt a; |y|² or |dt a|²; without apic also v + faceTime dt a, beta, and
/// beta (2 - beta) / 2. In cells: f.
template <int D, bool apic>
class Motion {
 public:
  static constexpr std::size_t later = D, square = 2 * D, work = square + 1, moving = work + 1, beta = moving + D,
                               slip = beta + 1, fields = apic ? 2 * D + 2 : 3 * D + 4;

  Motion(const Patch& patch, const ParticleUpdate<D>& update, double dt)
      : update_(&update), dt_(dt), box_(patch.cells().grown(Footprint<D>::most, D)) {
    length_ = static_cast<std::size_t>(box_.extent(0) + 2 * Lanes::count);
    slab_ = fields * length_ * (D == 3 ? static_cast<std::size_t>(box_.extent(1)) : 1);
    values_ = AlignedNumbers(slots * slab_);
    for (std::size_t slot = 0; slot < slots; ++slot) clearRim(&values_[slot * slab_]);
    next_ = patch.cells().lower[D - 1] - Footprint<D>::overhang;
  }

  /// Computes the fields around the slab with this index along the last axis.
  void moveTo(int slab) {
    if constexpr (D == 1)
      compute(0, update_->nodeVelocity.box(), update_->work.box());
    else
      for (; next_ <= slab + Footprint<D>::overhang + 1; ++next_) {
        double* values = &values_[slotOf(next_) * slab_];
        if (!isIn(update_->work.box(), next_)) std::fill(values, values + slab_, 0);
        compute(slotOf(next_), slabOf(update_->nodeVelocity.box(), next_), slabOf(update_->work.box(), next_));
      }
  }
  /// Whether any beta around the slab is not 0.
  bool relaxes() const {
    return apic || std::any_of(relaxes_.begin(), relaxes_.end(), [](bool relaxes) { return relaxes; });
  }
  /// The address of the first field at a node or cell of a row that moveTo has computed.
  const double* addressOf(const Index<D>& index) const {
    return &values_[slotOf(index[D - 1]) * slab_ + placeIn(index)];
  }
  std::size_t length() const { return length_; }  ///< distance between fields of a row

 private:
  static constexpr std::size_t slots = D == 1 ? 1 : 4;  ///< number of slabs that a slab needs
  static_assert(D == 1 || Footprint<D>::most < 4);

  std::size_t slotOf(int slab) const { return D == 1 ? 0 : static_cast<std::size_t>(slab - box_.lower[D - 1]) % slots; }
  std::size_t placeIn(const Index<D>& index) const {
    const std::size_t along = static_cast<std::size_t>(index[0] - box_.lower[0]);
    return along + (D == 3 ? static_cast<std::size_t>(index[1] - box_.lower[1]) * fields * length_ : 0);
  }
  static bool isIn(const Box& box, int slab) { return slab >= box.lower[D - 1] && slab < box.upper[D - 1]; }
  static Box slabOf(Box box, int slab) {
    if (!isIn(box, slab)) return {};
    box.lower[D - 1] = slab;
    box.upper[D - 1] = slab + 1;
    return box;
  }
  /// Sets all values of a slab to 0 that compute does not set in each slab.
  void clearRim(double* values) const {
    const Box& cells = update_->work.box();
    forEachRow<D>(slabOf(box_, box_.lower[D - 1]), [&](const Index<D>& row, int) {
      bool isSet = true;
      for (int d = 1; d < D - 1; ++d) isSet = isSet && cells.lower[d] <= row[d] && row[d] < cells.upper[d];
      const auto place = [&](int at) { return isSet ? static_cast<std::size_t>(at - box_.lower[0]) : 0; };
      const std::size_t lower = place(cells.lower[0]), upper = place(cells.upper[0]);
      for (std::size_t field = 0; field < fields; ++field, values += length_) {
        std::fill(values, values + lower, 0);
        std::fill(values + upper, values + length_, 0);
      }
    });
  }
  void compute(std::size_t slot, const Box& ofNodes, const Box& ofCells) {
    constexpr double faceTime = apic ? Apic::faceTime : AffineFlip::faceTime;
    double* values = &values_[slot * slab_];
    Lanes greatestBeta = 0;
    forEachRowPart<D>(ofNodes, [&](const RowPart<D>& nodes) {
      double* to = values + placeIn(nodes.first);
      const LanesVec<D> v = load(update_->nodeVelocity, nodes), dv = dt_ * load(update_->acceleration, nodes);
      const LanesVec<D> y = apic ? LanesVec<D>(v + dv) : dv;
      put(to, 0, v);
      put(to, later, y);
      squareOf<D>(y).copyTo(to + square * length_);
      if constexpr (!apic) {
        const Lanes b = load(update_->relaxation, nodes);
        greatestBeta = max(greatestBeta, b);
        put(to, moving, v + faceTime * dv);
        b.copyTo(to + beta * length_);
        (0.5 * b * (2 - b)).copyTo(to + slip * length_);
      }
    });
    forEachRowPart<D>(ofCells, [&](const RowPart<D>& cells) {
      load(update_->work, cells).copyTo(values + placeIn(cells.first) + work * length_);
    });
    relaxes_[slot] = any(greatestBeta > 0);
  }
  /// Stores the components of a vector. Lanes beyond the end of a row are stored, too: behind a row is space that
  /// nothing else uses.
  void put(double* to, std::size_t field, const LanesVec<D>& vector) const {
    for (std::size_t d = 0; d < D; ++d) vector[static_cast<int>(d)].copyTo(to + (field + d) * length_);
  }

  const ParticleUpdate<D>* update_;
  double dt_;
  Box box_;                    ///< wide enough for any footprint
  std::size_t length_, slab_;  ///< numbers of a row and of a slab
  int next_;                   ///< the first slab that has not been computed
  std::array<bool, slots> relaxes_{};
  AlignedNumbers values_;
};

template <int D, class Scheme>
using MotionOf = Motion<D, Scheme::transfer == Transfer::apic>;

/// Reads the grid fields in a row of nodes or cells near a batch.
template <int D>
struct RowReader {
  const double* first;
  std::size_t size;  ///< distance between fields

  [[gnu::always_inline]] Lanes operator()(std::size_t field, int k) const {
    return Lanes::at(first + field * size + k);
  }
  [[gnu::always_inline]] LanesVec<D> vector(std::size_t field, int k) const {
    LanesVec<D> values;
    for (std::size_t d = 0; d < D; ++d) values[static_cast<int>(d)] = (*this)(field + d, k);
    return values;
  }
};

/// Reads the grid fields near a batch.
template <int D, class Fields>
struct Reader {
  std::array<const double*, Footprint<D>::most + 1> slab;  ///< the first row of each slab of a footprint
  std::size_t length;

  Reader(const Fields& motion, const Footprint<D>& footprint) : length(motion.length()) {
    Index<D> first = footprint.first();
    const int nodes = D == 1 ? 1 : footprint.along[D - 1].nodes();
    for (int k = 0; k < nodes; ++k, ++first[D - 1]) slab[static_cast<std::size_t>(k)] = motion.addressOf(first);
  }
  [[gnu::always_inline]] RowReader<D> row(const Index<D>& at) const {
    if constexpr (D == 1) return {slab[0], length};
    const double* first = slab[static_cast<std::size_t>(at[D - 1])];
    return {first + (D == 3 ? static_cast<std::size_t>(at[1]) * Fields::fields * length : 0), length};
  }
};

}  // namespace tushar::mpm::gas::conserving
