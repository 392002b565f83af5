#pragma once

#include <memory>

#include "components/reference/gas_reference.hpp"

namespace tushar::reference {

/// A box [m].
struct Region {
  Vec3 lower, upper;
};

/// A reference restricted to a region. Its fields are unchanged, but errors are measured only in the region.
class Within : public GasReference {
 public:
  Within(std::shared_ptr<const GasReference> gas, const Region& region) : gas_(std::move(gas)), region_(region) {}

  GasState at(const Vec3& x, double t) const override { return gas_->at(x, t); }
  bool holdsAt(double t) const override { return gas_->holdsAt(t); }
  bool covers(const Vec3& x, double t) const override {
    return (x.array() >= region_.lower.array()).all() && (x.array() <= region_.upper.array()).all() &&
           gas_->covers(x, t);
  }
  GasState average(const Vec3& lower, const Vec3& upper, double t) const override {
    return gas_->average(lower, upper, t);
  }
  std::vector<double> breaks(int axis, double t) const override { return gas_->breaks(axis, t); }

 private:
  std::shared_ptr<const GasReference> gas_;
  Region region_;
};

}  // namespace tushar::reference
