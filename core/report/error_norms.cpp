#include "core/report/error_norms.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace tushar::report {

namespace {

constexpr std::array<std::string_view, 4> order{"L1", "L2", "max", "relative"};  // of the values of data::Norm

/// Whether an error was measured at no place: then the maximum is -infinity and the mean is NaN.
bool isOfNothing(const std::vector<double>& values) {
  if (values.size() == 1) return values[0] == -std::numeric_limits<double>::infinity();
  return values.empty() || (std::isnan(values[0]) && values[2] == 0);
}

double valueOf(const std::string& norm, const std::vector<double>& values) {
  if (values.size() == 1) return values[0];
  return values[std::find(order.begin(), order.end() - 1, norm) - order.begin()];
}

}  // namespace

ErrorNorms normsOf(const MeasuredError& error, const std::vector<double>& values) {
  ErrorNorms result{error.field, error.place, {}, std::string(error.label->unit)};
  if (isOfNothing(values)) return result;
  for (const std::string& norm : error.norms) {
    const double value = valueOf(norm, values);
    if (norm != "relative" || std::isfinite(value)) result.norms[norm] = value;
  }
  return result;
}

std::optional<std::string> unmeasurable(const std::vector<ErrorNorms>& errors) {
  for (const ErrorNorms& error : errors)
    for (const auto& [norm, value] : error.norms)
      if (!std::isfinite(value))
        return fmt::format(
            "the report has no errors at the end of the run, because the {} norm of the error of {}, {}, is not finite",
            norm, error.field, error.place);
  return std::nullopt;
}

}  // namespace tushar::report
