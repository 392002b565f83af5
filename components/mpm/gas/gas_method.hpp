#pragma once

#include "components/mpm/gas/material.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::mpm::gas {

/// A particle method for gases, and its settings.
template <class Method>
class GasMethod : public Component, public reference::GasSolution {
 public:
  GasMethod(const Method& method, std::vector<Gas> materials) : method_(method), materials_(std::move(materials)) {}

  const Method& method() const { return method_; }
  const std::vector<Gas>& materials() const { return materials_; }
  std::vector<reference::GasLaw> gases() const override { return lawsOf(materials_); }
  std::string whyOneLevel() const override {
    return "its gas fills the grid, but particles are allowed only on the finest level";
  }

 protected:
  Method method_;
  std::vector<Gas> materials_;
};

}  // namespace tushar::mpm::gas
