#include "core/tasks/between_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <tuple>

#include "core/data/views.hpp"

namespace tushar::tasks {

using data::Generation;
using data::ParticleRange;
using data::ParticleSet;
using grid::Patch;

namespace {

/// A particle of a new set, and where its values are.
struct Member {
  Index3 cell;
  std::size_t cellPlace;  ///< index of the cell on its patch
  ParticleId id;
  int material, place;  ///< previous material, and index among its particles on the patch
};

/// The particles of one material after the move.
struct Gathering {
  bool changes = false;
  std::vector<std::vector<Member>> members;  ///< for each patch of the rank
};

class Mover {
 public:
  Mover(data::Warehouse& warehouse, int materials, std::string_view destination)
      : warehouse_(warehouse), destination_(destination), gatherings_(materials) {}

  /// Finds the materials that particles leave or enter; returns the number of particles that move.
  long find() {
    long moving = 0;
    for (const Patch& patch : patches())
      for (int m = 0; m < materials(); ++m) {
        const int count = set(m, patch).owned();
        const int* to = count > 0 ? destinationsOf(m, patch) : nullptr;
        for (int p = 0; p < count; ++p) {
          if (to[p] == m) continue;
          check(to[p]);
          gatherings_[m].changes = gatherings_[to[p]].changes = true;
          ++moving;
        }
      }
    return moving;
  }

  /// Makes the new sets, which then have slots.
  void makeSets() {
    for (int m = 0; m < materials(); ++m)
      if (gatherings_[m].changes) gatherings_[m].members.resize(patches().size());
    for (std::size_t k = 0; k < patches().size(); ++k) gatherMembers(k);
    for (int m = 0; m < materials(); ++m) {
      if (!gatherings_[m].changes) continue;
      for (std::size_t k = 0; k < patches().size(); ++k) fillSet(m, patches()[k], gatherings_[m].members[k]);
      warehouse_.layOut(Generation::old, m, Generation::old);
    }
  }

  /// Moves a variable to the new sets.
  void carry(std::string_view name) {
    std::vector<int> numbers(gatherings_.size(), -1);
    for (int m = 0; m < materials(); ++m)
      if (gatherings_[m].changes) numbers[m] = warehouse_.table().find(name, m);
    if (std::all_of(numbers.begin(), numbers.end(), [](int number) { return number < 0; })) return;
    if (labelOf(numbers).centring != data::Centring::particle) return;
    std::vector<std::vector<std::byte>> gathered(gatherings_.size());
    for (std::size_t m = 0; m < gatherings_.size(); ++m)
      if (gatherings_[m].changes) gathered[m] = valuesOf(gatherings_[m], numbers);
    for (std::size_t m = 0; m < gatherings_.size(); ++m)
      if (gatherings_[m].changes) store(gatherings_[m], numbers[m], gathered[m]);
  }

 private:
  int materials() const { return static_cast<int>(gatherings_.size()); }
  const std::vector<Patch>& patches() const { return warehouse_.grid().patches(); }
  ParticleSet& set(int material, const Patch& patch) {
    return warehouse_.particles(Generation::old, material, patch.id());
  }
  template <class T>
  const T* values(Generation generation, int number, const Patch& patch) {
    return reinterpret_cast<const T*>(warehouse_.variable(generation, number, patch.id()).values);
  }
  const int* destinationsOf(int material, const Patch& patch) {
    return values<int>(Generation::fresh, warehouse_.table().find(destination_, material), patch);
  }
  const data::Label& labelOf(const std::vector<int>& numbers) const {
    return *warehouse_.table()[*std::max_element(numbers.begin(), numbers.end())].label;
  }
  void check(int material) const {
    if (material < 0 || material >= materials())
      throw data::AccessError(
          fmt::format("a particle cannot move to material {}: there are {}", material, materials()));
  }

  /// Assigns the particles of a patch to the new sets, sorted by (cell, id).
  void gatherMembers(std::size_t k) {
    const Patch& patch = patches()[k];
    for (int m = 0; m < materials(); ++m) {
      if (!gatherings_[m].changes || set(m, patch).owned() == 0) continue;
      const int* to = destinationsOf(m, patch);
      const int numberOfIds = warehouse_.table().find(data::particleId.name, m);
      const ParticleId* ids = values<ParticleId>(Generation::old, numberOfIds, patch);
      set(m, patch).forEachOccupied<3>(patch.cells(), [&](const Index3& cell, const ParticleRange& range) {
        for (const int p : range)
          gatherings_[to[p]].members[k].push_back({cell, patch.cells().offset(cell), ids[p], m, p});
      });
    }
    for (Gathering& gathering : gatherings_)
      if (gathering.changes)
        std::sort(gathering.members[k].begin(), gathering.members[k].end(), [](const Member& a, const Member& b) {
          return std::tie(a.cellPlace, a.id) < std::tie(b.cellPlace, b.id);
        });
  }

  void fillSet(int material, const Patch& patch, const std::vector<Member>& members) {
    ParticleSet& filled = set(material, patch);
    filled.reset(patch, warehouse_.table().reach(material));
    for (std::size_t first = 0, end = 0; first < members.size(); first = end) {
      for (end = first; end < members.size() && members[end].cellPlace == members[first].cellPlace;) ++end;
      filled.put(members[first].cell, {static_cast<int>(first), static_cast<int>(end)});
    }
    filled.setOwned(static_cast<int>(members.size()));
  }

  /// The values of a variable for the particles of a new set, patch by patch. `numbers` are those of the variable for
  /// the materials that change.
  std::vector<std::byte> valuesOf(const Gathering& gathering, const std::vector<int>& numbers) {
    const std::size_t bytes = labelOf(numbers).bytes;
    std::vector<std::byte> gathered;
    for (std::size_t k = 0; k < patches().size(); ++k)
      for (const Member& member : gathering.members[k]) {
        const int number = numbers[member.material];
        if (number < 0)
          throw data::AccessError(
              fmt::format("material {} lacks {}, which another one has", member.material, labelOf(numbers).name));
        const std::byte* from = values<std::byte>(Generation::old, number, patches()[k]);
        from += static_cast<std::size_t>(member.place) * bytes;
        gathered.insert(gathered.end(), from, from + bytes);
      }
    return gathered;
  }

  void store(const Gathering& gathering, int number, const std::vector<std::byte>& gathered) {
    if (number < 0) throw data::AccessError("a material lacks a variable that another one has");
    data::Buffer outgrown = warehouse_.follow(Generation::old, number, Generation::old);
    warehouse_.takeBack(outgrown);
    const std::size_t bytes = warehouse_.table()[number].label->bytes;
    const std::byte* from = gathered.data();
    for (std::size_t k = 0; k < patches().size(); ++k) {
      const std::size_t length = gathering.members[k].size() * bytes;
      if (length == 0) continue;
      std::memcpy(warehouse_.variable(Generation::old, number, patches()[k].id()).values, from, length);
      from += length;
    }
  }

  data::Warehouse& warehouse_;
  std::string_view destination_;
  std::vector<Gathering> gatherings_;
};

}  // namespace

long moveBetweenMaterials(data::Warehouse& warehouse, int materials, std::string_view destination,
                          const std::vector<std::string>& carried) {
  Mover mover(warehouse, materials, destination);
  const long moving = mover.find();
  if (moving == 0) return 0;
  mover.makeSets();
  for (const std::string& name : carried) mover.carry(name);
  if (std::find(carried.begin(), carried.end(), data::particleId.name) == carried.end())
    mover.carry(data::particleId.name);
  return moving;
}

}  // namespace tushar::tasks
