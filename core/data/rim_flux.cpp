#include "core/data/rim_flux.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace tushar::data {

namespace {

struct OwnedLabel {
  explicit OwnedLabel(const Label& of) : name(nameOf(of)), label(of) {
    label.name = name;
    label.description = "flux through faces where levels meet";
    label.centring = Centring::rim;
    label.bound = Bound::none;
  }
  static std::string nameOf(const Label& of) {
    constexpr std::string_view rim = "rim.";
    if (of.centring == Centring::rim) return "rim.sum." + std::string(of.name.substr(rim.size()));
    return std::string(rim) + std::string(of.name);
  }
  std::string name;
  Label label;
};

}  // namespace

const Label& rimLabelOf(const Label& label) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, std::size_t>, std::unique_ptr<OwnedLabel>> labels;  // c.velocity has 1 to 3
  const std::lock_guard<std::mutex> alone(mutex);
  std::unique_ptr<OwnedLabel>& owned = labels[{std::string(label.name), label.bytes}];
  if (!owned) owned = std::make_unique<OwnedLabel>(label);
  return owned->label;
}

}  // namespace tushar::data
