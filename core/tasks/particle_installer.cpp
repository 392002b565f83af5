#include "core/tasks/particle_installer.hpp"

#include <algorithm>
#include <cstring>

namespace tushar::tasks {

using data::Generation;
using data::ParticleSet;

ParticleInstaller::ParticleInstaller(data::Warehouse& warehouse, int material, const std::vector<ParticleMaker>& makers)
    : warehouse_(&warehouse),
      material_(material),
      keeps_all_(std::all_of(makers.begin(), makers.end(), [](const ParticleMaker& one) { return one.keepsAll(); })) {}

void ParticleInstaller::makeSets(const OnPatches& onPatches) {
  onPatches([&](const grid::Patch& patch, ParticleMaker& maker) {
    ParticleSet& set = warehouse_->particles(Generation::fresh, material_, patch.id());
    if (maker.keepsAll()) return set.forgetGhosts();
    const ParticleId* ids = nullptr;
    if (maker.keepsSome())
      ids = reinterpret_cast<const ParticleId*>(
          warehouse_->variable(Generation::fresh, numberOfIds(), patch.id()).values);
    maker.makeSet(set, patch, warehouse_->table().reach(material_), ids);
  });
  warehouse_->layOut(Generation::fresh, material_, Generation::fresh);
}

template <class WriteOne>
void ParticleInstaller::writeEach(int number, const OnPatches& onPatches, const WriteOne& writeOne) {
  const data::SharedSlots before = warehouse_->slots(Generation::fresh, number);
  data::Buffer outgrown = warehouse_->follow(Generation::fresh, number, Generation::fresh);
  const std::size_t bytes = warehouse_->table()[number].label->bytes;
  const std::byte* memory = outgrown.capacity() > 0 ? outgrown.data() : warehouse_->memory(Generation::fresh, number);
  onPatches([&](const grid::Patch& patch, ParticleMaker& maker) {
    std::byte* to = warehouse_->variable(Generation::fresh, number, patch.id()).values;
    const bool keeps = maker.keepsAll() || maker.keepsSome();  // perhaps from another place in the same memory
    const std::byte* from = keeps ? memory + before->first[placeOf(patch)] * bytes : nullptr;
    if (!maker.keepsAll()) return writeOne(maker, from, to);
    const int owned = warehouse_->particles(Generation::fresh, material_, patch.id()).owned();
    if (owned > 0 && from != to) std::memcpy(to, from, static_cast<std::size_t>(owned) * bytes);
  });
  warehouse_->takeBack(outgrown);
}

void ParticleInstaller::write(int number, std::size_t access, bool isRead, const OnPatches& onPatches) {
  const data::Label& label = *warehouse_->table()[number].label;
  if (isRead)
    writeEach(number, onPatches, [&](ParticleMaker& maker, const std::byte* from, std::byte* to) {
      if (maker.creates(access)) maker.write(access, label, from, to);
    });
  else
    onPatches([&](const grid::Patch&, ParticleMaker& maker) {
      if (maker.creates(access)) maker.drop(access, label);
    });
  const bool isStart = !warehouse_->slots(Generation::old, numberOfIds());  // of values that outlive each step
  if (isStart) warehouse_->releaseFreeMemory();  // of the values in the maker, which is larger than that of any step
}

void ParticleInstaller::writeIds(const OnPatches& onPatches) {
  writeEach(numberOfIds(), onPatches, [](ParticleMaker& maker, const std::byte* from, std::byte* to) {
    maker.writeIds(reinterpret_cast<const ParticleId*>(from), reinterpret_cast<ParticleId*>(to));
  });
}

int ParticleInstaller::numberOfIds() const { return warehouse_->table().find(data::particleId.name, material_); }

}  // namespace tushar::tasks
