#include "components/reference/sedov.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tushar::reference {

namespace {

/// The table ends where gamma w - 1 has decreased by a factor of about exp(-kDepth), where the density is negligible.
constexpr double kDepth = 60;
constexpr int kSteps = 16000;

}  // namespace

Sedov::Sedov(const SedovProblem& problem) : RadialReference(problem.centre, problem.round), problem_(problem) {
  requireRadialFlow("A blast", problem.density, "energy", problem.energy, problem.pressure, problem.gamma);
  if (dimension() == 3 && problem.gamma >= 7)
    throw std::invalid_argument(
        fmt::format("A blast in three dimensions leaves a void at its centre if gamma is 7 or more, but gamma is {}.",
                    problem.gamma));
  tabulate();
  alpha_ = findAlpha();
}

/// d ln y / d ln lambda = gamma N / M and d ln G / d ln lambda = (w' + d w) / (1 - w) with y = gamma w - 1, N = w/2 (d
/// + 2 - (2 + d (gamma-1)) w) and M = gamma (gamma-1)/2 w² - (1-w) y. These are the equations of mass and momentum,
/// with the pressure from the energy integral.
Sedov::Shape Sedov::slope(const Shape& at) const {
  const double gamma = problem_.gamma, d = dimension();
  const double y = std::exp(at.y), w = (1 + y) / gamma;
  const double n = 0.5 * w * (d + 2 - (2 + d * (gamma - 1)) * w);
  const double m = 0.5 * gamma * (gamma - 1) * w * w - (1 - w) * y;
  return {gamma * n / m, (y * n / m + d * w) / (1 - w)};
}

/// Tabulates the solution by the classical Runge-Kutta method.
void Sedov::tabulate() {
  const double gamma = problem_.gamma;
  step_ = -kDepth / (2 + dimension() / (gamma - 1)) / kSteps;
  Shape at{std::log((gamma - 1) / (gamma + 1)), std::log((gamma + 1) / (gamma - 1))};
  nodes_.push_back({at, slope(at)});
  const auto moved = [&](double part, const Shape& by) {
    return Shape{at.y + part * step_ * by.y, at.density + part * step_ * by.density};
  };
  while (nodes_.size() <= kSteps) {
    const Shape a = nodes_.back().slope, b = slope(moved(0.5, a)), c = slope(moved(0.5, b)), e = slope(moved(1, c));
    at = moved(1.0 / 6, {a.y + 2 * b.y + 2 * c.y + e.y, a.density + 2 * b.density + 2 * c.density + e.density});
    nodes_.push_back({at, slope(at)});
  }
}

/// Interpolates cubically between nodes. Further inwards than the last node, the values are constant.
Sedov::Shape Sedov::shapeAt(double logLambda) const {
  const double place = std::min(logLambda / step_, static_cast<double>(kSteps));
  const auto k = std::min(static_cast<std::size_t>(place), nodes_.size() - 2);
  const Node &a = nodes_[k], &b = nodes_[k + 1];
  const double s = place - static_cast<double>(k);
  const auto cubic = [&](double Shape::*what) {
    const double rise = b.value.*what - a.value.*what;
    const double left = step_ * a.slope.*what - rise, right = rise - step_ * b.slope.*what;
    return a.value.*what + s * (rise + (1 - s) * ((1 - s) * left + s * right));
  };
  return {cubic(&Shape::y), cubic(&Shape::density)};
}

/// The pressure p / (rho0 R'²) = lambda² G C.
double Sedov::pressureShape(double logLambda, const Shape& shape) const {
  const double gamma = problem_.gamma, w = (1 + std::exp(shape.y)) / gamma;
  return 0.5 * (gamma - 1) * w * w * (1 - w) * std::exp(2 * logLambda + shape.density - shape.y);
}

/// Computes alpha in E = alpha rho0 R^(d+2) / t²: alpha = A (2/(d+2))² int (G lambda² w² / 2 + p / (gamma-1)) lambda^d
/// d ln lambda, where A is the area of the unit sphere, by Simpson's rule. Further inwards than the last node, only the
/// pressure contributes.
double Sedov::findAlpha() const {
  const double gamma = problem_.gamma, d = dimension();
  const auto density = [&](int k) {
    const Shape& shape = nodes_[k].value;
    const double logLambda = k * step_, w = (1 + std::exp(shape.y)) / gamma;
    const double kinetic = 0.5 * w * w * std::exp(2 * logLambda + shape.density);
    return (kinetic + pressureShape(logLambda, shape) / (gamma - 1)) * std::exp(d * logLambda);
  };
  double sum = density(kSteps) / d;
  for (int k = 0; k < kSteps; k += 2) sum -= step_ / 3 * (density(k) + 4 * density(k + 1) + density(k + 2));
  const double area = d == 1 ? 2 : d == 2 ? 2 * M_PI : 4 * M_PI;
  return area * 4 / ((d + 2) * (d + 2)) * sum;
}

double Sedov::shockRadius(double t) const {
  return std::pow(problem_.energy * t * t / (alpha_ * problem_.density), 1.0 / (dimension() + 2));
}

RadialState Sedov::atRadius(double r, double t) const {
  const double radius = shockRadius(t), gamma = problem_.gamma;
  RadialState state{problem_.density, 0, problem_.pressure, 0};
  if (r < radius) {
    const double logLambda = std::max(std::log(r / radius), kSteps * step_);
    const double speed = 2.0 / (dimension() + 2) * radius / t;
    const Shape shape = shapeAt(logLambda);
    state.density = problem_.density * std::exp(shape.density);
    state.velocity = speed * r / radius * (1 + std::exp(shape.y)) / gamma;
    state.pressure = problem_.density * speed * speed * pressureShape(logLambda, shape);
  }
  state.energy = state.pressure / ((gamma - 1) * state.density);
  return state;
}

GasState Sedov::average(const Vec3& lower, const Vec3& upper, double t) const {
  GasState mean = RadialReference::average(lower, upper, t);
  mean.energy = mean.pressure / ((problem_.gamma - 1) * mean.density);
  return mean;
}

}  // namespace tushar::reference
