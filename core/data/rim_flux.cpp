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

template <int D>
void forEachRimFace(std::span<const grid::RimPiece> pieces, const grid::Box& faces, int axis,
                    FunctionRef<void(const Index<D>& face, std::size_t place)> visit) {
  for (const grid::RimPiece& piece : pieces) {
    if (piece.axis != axis) continue;
    const grid::Box all = piece.cells.shifted(piece.side == 0 ? Index3{} : Index3::unit(axis));
    grid::forEach<D>(all.intersect(faces), [&](const Index<D>& face) {
      Index3 at;
      for (int d = 0; d < D; ++d) at[d] = face[d];
      visit(face, piece.first + all.offset(at));
    });
  }
}
template void forEachRimFace(std::span<const grid::RimPiece>, const grid::Box&, int,
                             FunctionRef<void(const Index<1>&, std::size_t)>);
template void forEachRimFace(std::span<const grid::RimPiece>, const grid::Box&, int,
                             FunctionRef<void(const Index<2>&, std::size_t)>);
template void forEachRimFace(std::span<const grid::RimPiece>, const grid::Box&, int,
                             FunctionRef<void(const Index<3>&, std::size_t)>);

}  // namespace tushar::data
