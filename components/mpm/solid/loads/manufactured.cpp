#include "components/mpm/solid/loads/manufactured.hpp"

#include <cmath>
#include <numbers>

#include "components/mpm/solid/constitutive/cnh_mms.hpp"

namespace tushar::mpm::solid {

namespace {

constexpr double pi = std::numbers::pi;

using BodyForce = std::function<Vec3(const Vec3& start)>;

double barSpeed(const Elastic& e) { return std::sqrt(e.young / e.density); }

/// The motion u_i = A sin(pi X_i) sin(pi (phi_i + c t)). The axes are independent of one another, and the sides of the
/// unit cube do not move.
class AxisAligned : public Manufactured {
 public:
  double farthestAtStart() const override { return amplitude; }
  Vec3 displacement(const Elastic& e, const Vec3& start, double time) const override {
    Vec3 u;
    for (int d = 0; d < 3; ++d) u[d] = amplitude * std::sin(pi * start[d]) * std::sin(phase(e, d, time));
    return u;
  }
  Vec3 velocity(const Elastic& e, const Vec3& start, double time) const override {
    Vec3 v;
    for (int d = 0; d < 3; ++d)
      v[d] = amplitude * pi * barSpeed(e) * std::sin(pi * start[d]) * std::cos(phase(e, d, time));
    return v;
  }
  Matrix3 deformationGradient(const Elastic& e, const Vec3& start, double time) const override {
    Matrix3 f = Matrix3::Identity();
    for (int d = 0; d < 3; ++d) f(d, d) += amplitude * pi * std::cos(pi * start[d]) * std::sin(phase(e, d, time));
    return f;
  }
  BodyForce bodyForce(const Elastic& e, double time) const override {
    const Vec3 swing(std::sin(phase(e, 0, time)), std::sin(phase(e, 1, time)), std::sin(phase(e, 2, time)));
    return [e, swing, c = barSpeed(e)](const Vec3& start) {
      Vec3 u, f, b;
      for (int d = 0; d < 3; ++d) {
        u[d] = amplitude * std::sin(pi * start[d]) * swing[d];
        f[d] = 1 + amplitude * pi * std::cos(pi * start[d]) * swing[d];
      }
      const double pull = e.lambda * (std::log(f.prod()) - 1) - e.shear;
      for (int d = 0; d < 3; ++d) b[d] = pi * pi * u[d] * ((e.shear - pull / (f[d] * f[d])) / e.density - c * c);
      return b;
    };
  }

 private:
  static constexpr double amplitude = 0.05;
  static double phase(const Elastic& e, int d, double time) { return pi * (2.0 / 3.0 * d + barSpeed(e) * time); }
};

/// A ring from R = .4 to .6 that expands and contracts: x = X (1 + A s(t) g(R)), s = sin(pi c t / (2 R_b)), with no
/// traction on either side.
class ExpandingRing : public Manufactured {
 public:
  Vec3 displacement(const Elastic& e, const Vec3& start, double time) const override {
    return amplitude * swing(e, time) * g(start) * flat(start);
  }
  Vec3 velocity(const Elastic& e, const Vec3& start, double time) const override {
    return amplitude * rate(e) * std::cos(rate(e) * time) * g(start) * flat(start);
  }
  Matrix3 deformationGradient(const Elastic& e, const Vec3& start, double time) const override {
    const double r = radius(start), a = amplitude * swing(e, time);
    const Vec3 out = flat(start) / r;
    Matrix3 f = Matrix3::Identity() + a * r * slope(r) * out * out.transpose();
    f(0, 0) += a * g(start);
    f(1, 1) += a * g(start);
    return f;
  }
  BodyForce bodyForce(const Elastic& e, double time) const override {
    return [e, time](const Vec3& start) -> Vec3 {
      const double r = radius(start), a = amplitude * swing(e, time);
      const double hoop = 1 + a * g(start), radial = hoop + a * r * slope(r);
      const double hoopChange = a * slope(r), radialChange = a * (2 * slope(r) + r * 2 * c3);
      const double pull = e.lambda * std::log(radial * hoop) - e.shear;
      const auto stress = [&](double f) { return pull / f + e.shear * f; };
      const double change = e.lambda * (radialChange / radial + hoopChange / hoop) / radial -
                            pull * radialChange / (radial * radial) + e.shear * radialChange;
      const double divergence = change + (stress(radial) - stress(hoop)) / r;
      const double acceleration = -a * rate(e) * rate(e) * g(start) * r;
      return (acceleration - divergence / e.density) / r * flat(start);
    };
  }

 private:
  static constexpr double amplitude = 0.1, inner = 0.4, outer = 0.6, middle = 0.5;
  static constexpr double c1 = -6 * inner / (outer * (outer - 3 * inner));
  static constexpr double c2 = 3 * (outer + inner) / (outer * outer * (outer - 3 * inner));
  static constexpr double c3 = -2 / (outer * outer * (outer - 3 * inner));
  static Vec3 flat(const Vec3& start) { return {start[0], start[1], 0}; }
  static double radius(const Vec3& start) { return std::hypot(start[0], start[1]); }
  static double g(const Vec3& start) { return c1 + radius(start) * (c2 + c3 * radius(start)); }
  static double slope(double r) { return c2 + 2 * c3 * r; }
  static double rate(const Elastic& e) { return pi * barSpeed(e) / (2 * middle); }
  static double swing(const Elastic& e, double time) { return std::sin(rate(e) * time); }
};

/// A ring from R = .75 to 1.25 whose circles rotate by alpha = sin(pi c t) h(R), at rest on both sides: large shear
/// without change of volume. The body force follows from P = G gamma (e_r E_theta + e_theta E_r), gamma = R dalpha/dR.
class GeneralizedVortex : public Manufactured {
 public:
  Vec3 displacement(const Elastic& e, const Vec3& start, double time) const override {
    return turned(start, angle(e, start, time)) - start;
  }
  Vec3 velocity(const Elastic& e, const Vec3& start, double time) const override {
    const Vec3 x = turned(start, angle(e, start, time));
    return pi * barSpeed(e) * std::cos(pi * barSpeed(e) * time) * h(radius(start)) * Vec3(-x[1], x[0], 0);
  }
  Matrix3 deformationGradient(const Elastic& e, const Vec3& start, double time) const override {
    const double r = radius(start), alpha = angle(e, start, time), slope = swing(e, time) * dh(r);
    const Vec3 x = turned(start, alpha);
    Matrix3 f = Matrix3::Identity();
    f.topLeftCorner<2, 2>() << std::cos(alpha), -std::sin(alpha), std::sin(alpha), std::cos(alpha);
    return f + slope / r * Vec3(-x[1], x[0], 0) * Vec3(start[0], start[1], 0).transpose();
  }
  BodyForce bodyForce(const Elastic& e, double time) const override {
    return [e, time](const Vec3& start) -> Vec3 {
      const double r = radius(start), w = pi * barSpeed(e), s = swing(e, time);
      const double speed = w * std::cos(w * time) * h(r), slope = s * dh(r), curve = s * d2h(r);
      const double radial = -r * speed * speed + e.shear * r * slope * slope / e.density;
      const double around = -r * w * w * s * h(r) - e.shear * (3 * slope + r * curve) / e.density;
      const Vec3 out = turned(start, angle(e, start, time)) / r;
      return radial * Vec3(out[0], out[1], 0) + around * Vec3(-out[1], out[0], 0);
    };
  }

 private:
  static double radius(const Vec3& start) { return std::hypot(start[0], start[1]); }
  static double h(double r) { return 1 - 32 * (r - 1) * (r - 1) + 256 * std::pow(r - 1, 4); }
  static double dh(double r) { return -64 * (r - 1) + 1024 * std::pow(r - 1, 3); }
  static double d2h(double r) { return -64 + 3072 * (r - 1) * (r - 1); }
  static double swing(const Elastic& e, double time) { return std::sin(pi * barSpeed(e) * time); }
  static double angle(const Elastic& e, const Vec3& start, double time) { return swing(e, time) * h(radius(start)); }
  static Vec3 turned(const Vec3& start, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * start[0] - s * start[1], s * start[0] + c * start[1], start[2]};
  }
};

}  // namespace

Elastic elasticOf(const Material& material) {
  const auto& model = dynamic_cast<const ModelOf<CnhMms>&>(*material.model).model();
  const double k = model.bulkModulus, g = model.shearModulus;
  return {model.lambda(), g, 9 * k * g / (3 * k + g), material.density};
}

std::shared_ptr<const Manufactured> makeManufactured(const std::string& name) {
  if (name == "AxisAligned") return std::make_shared<AxisAligned>();
  if (name == "ExpandingRing") return std::make_shared<ExpandingRing>();
  if (name == "GeneralizedVortex") return std::make_shared<GeneralizedVortex>();
  return nullptr;
}

}  // namespace tushar::mpm::solid
