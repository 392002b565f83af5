#include "components/mpm/solid/loads/prescribed_deformation.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "core/input/values.hpp"

namespace tushar::mpm::solid {

namespace {

using input::Diagnostics;

/// Number of values that describe a point in a file.
constexpr std::size_t pointSize = 14;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Matrix3 rotation(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(radians(angle), Eigen::Vector3d(axis)).toRotationMatrix();
}

/// The matrix W with W x = axis × x.
Matrix3 spin(const Vec3& axis) {
  Matrix3 w;
  w << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
  return w;
}

/// The numbers in a file, and the line of each.
struct Numbers {
  std::vector<double> values;
  std::vector<int> lines;

  int lineOf(std::size_t point) const { return lines[point * pointSize]; }
};

Numbers readNumbers(std::istream& file, const std::string& path, Diagnostics& diagnostics) {
  Numbers numbers;
  std::string line, word;
  for (int at = 1; std::getline(file, line); ++at) {
    std::istringstream words(line);
    while (words >> word) {
      const auto number = input::parse<double>(word).value;
      if (!number) diagnostics.error({path, at, 0}, {}, fmt::format("found '{}', expected a number", word));
      numbers.values.push_back(number.value_or(0));
      numbers.lines.push_back(at);
    }
  }
  return numbers;
}

PrescribedDeformation::Point pointOf(const double* n) {
  PrescribedDeformation::Point point{n[0], Eigen::Map<const Matrix3>(n + 1), n[10], {n[11], n[12], n[13]}};
  if (const double length = point.axis.norm(); length > 0) point.axis /= length;
  return point;
}

void checkPoint(const PrescribedDeformation::Point& point, const Location& where, Diagnostics& diagnostics) {
  if (const double j = point.deformation.determinant(); !(j > 0))
    diagnostics.error(where, {}, fmt::format("det F is {:g}, expected more than 0", j));
  if (point.angle != 0 && point.axis.isZero())
    diagnostics.error(where, {}, "a rotation needs an axis: its three components are 0");
}

void checkNumbers(const Numbers& numbers, const std::string& path, const Location& named, Diagnostics& diagnostics) {
  const std::size_t left = numbers.values.size() % pointSize, count = numbers.values.size() / pointSize;
  if (left > 0)
    diagnostics.error({path, numbers.lineOf(count), 0}, {},
                      fmt::format("found {} numbers, expected 14 per point: time, 9 components of F row by row, angle, "
                                  "3 components of the axis",
                                  left));
  else if (count < 2)
    diagnostics.error(named, "MPM/PrescribedDeformationFile",
                      fmt::format("'{}' has {} points in time, expected at least 2", path, count));
}

}  // namespace

PrescribedDeformation::PrescribedDeformation(std::vector<Point> points) : points_(std::move(points)) {
  Matrix3 turned = Matrix3::Identity();
  for (const Point& point : points_) turned_.push_back(turned = rotation(point.angle, point.axis) * turned);
}

/// The factors of F and of its rate at one time.
struct PrescribedDeformation::Moment {
  Matrix3 stretched, rate;  ///< F_s, and its time derivative [1/s]
  Matrix3 turned, now;      ///< Q_0 and Q
  Matrix3 spin;             ///< dQ/dt Q^T [1/s]
};

PrescribedDeformation::Moment PrescribedDeformation::at(double time) const {
  // A step that starts at a point, but for round-off, follows the path from there on.
  const double late = time + 1e-9 * (points_.back().time - points_.front().time);
  const auto isLater = [](double t, const Point& point) { return t < point.time; };
  const auto next = std::upper_bound(points_.begin() + 1, points_.end() - 1, late, isLater);
  const Point &a = *(next - 1), &b = *next;
  const double span = b.time - a.time, share = (time - a.time) / span;
  return {.stretched = (1 - share) * a.deformation + share * b.deformation,
          .rate = (b.deformation - a.deformation) / span,
          .turned = turned_[std::size_t(next - 1 - points_.begin())],
          .now = rotation(b.angle * share, b.axis),
          .spin = radians(b.angle) / span * solid::spin(b.axis)};
}

Matrix3 PrescribedDeformation::deformation(double time) const {
  const Moment m = at(time);
  return m.now * m.turned * m.stretched;
}

/// Computes L = dQ/dt Q^T + (Q Q_0) dF_s/dt F_s^-1 (Q Q_0)^T.
Matrix3 PrescribedDeformation::velocityGradient(double time) const {
  const Moment m = at(time);
  const Matrix3 turned = m.now * m.turned;
  return m.spin + turned * m.rate * m.stretched.inverse() * turned.transpose();
}

std::optional<PrescribedDeformation> readPrescribedDeformation(const std::string& path, const Location& named,
                                                               Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    diagnostics.error(named, "MPM/PrescribedDeformationFile", fmt::format("'{}': there is no such file", path));
    return {};
  }
  const Numbers numbers = readNumbers(file, path, diagnostics);
  checkNumbers(numbers, path, named, diagnostics);
  std::vector<PrescribedDeformation::Point> points;
  for (std::size_t k = 0; k < numbers.values.size() / pointSize; ++k) {
    const Location where{path, numbers.lineOf(k), 1};
    points.push_back(pointOf(&numbers.values[k * pointSize]));
    checkPoint(points.back(), where, diagnostics);
    if (k > 0 && points[k].time <= points[k - 1].time)
      diagnostics.error(where, {}, "its time is not after that of the previous point");
  }
  if (diagnostics.size() > before) return {};
  return PrescribedDeformation(std::move(points));
}

}  // namespace tushar::mpm::solid
