#include "core/data/warehouse.hpp"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <limits>

#include "core/base/mpi.hpp"
#include "core/data/page_size.hpp"
#include "core/data/views.hpp"

namespace tushar::data {

std::string VariableTable::key(std::string_view name, int material) {
  return std::string(name) + "#" + std::to_string(material);
}

int VariableTable::number(const Label& label, int material) {
  const auto [entry, added] = numbers_.try_emplace(key(label.name, material), size());
  if (added) {
    names_.push_back({&label, material});
    ghosts_.push_back(0);
  }
  return entry->second;
}

int VariableTable::find(std::string_view name, int material) const {
  const auto entry = numbers_.find(key(name, material));
  return entry == numbers_.end() ? -1 : entry->second;
}

void VariableTable::widen(int number, int ghost) {
  const std::size_t at = number;
  ghosts_[at] = std::max(ghosts_[at], ghost);
  if (names_[at].label->centring != Centring::particle) return;
  const std::size_t material = names_[at].material;
  if (reaches_.size() <= material) reaches_.resize(material + 1, 0);
  reaches_[material] = std::max(reaches_[material], ghost);
}

void VariableTable::join(std::shared_ptr<const JointInterpolation> how) {
  Joint joint{{}, {}, std::move(how)};
  for (const VariableName& name : joint.how->variables()) {
    joint.variables.push_back(number(*name.label, name.material));
    joint.labels.push_back(name.label);
  }
  joints_.push_back(std::move(joint));
}

void VariableTable::widenJoints() {
  for (const Joint& joint : joints_) {
    int widest = 0;
    for (const int number : joint.variables) widest = std::max(widest, ghost(number));
    for (const int number : joint.variables) widen(number, widest);
  }
}

Warehouse::Warehouse(const grid::Grid& grid, VariableTable& table)
    : Warehouse(grid, table, mpi::Communicator::alone()) {}

void Warehouse::grow(int materials) {
  const auto variables = static_cast<std::size_t>(table_->size()), many = static_cast<std::size_t>(materials);
  reductions_.resize(std::max(reductions_.size(), variables));
  for (State* state : {&old_, &fresh_}) {
    state->storages.resize(std::max(state->storages.size(), variables));
    state->layouts.resize(std::max(state->layouts.size(), many));
    state->sets.resize(std::max(state->sets.size(), place(materials, grid_->firstPatch())));
  }
}

void Warehouse::startAnew(int materials) {
  for (State* state : {&old_, &fresh_}) {
    for (Storage& storage : state->storages) pool_.takeBack(storage.memory);  // for the values on the new patches
    *state = State();
  }
  grid_slots_.clear();
  grow(materials);
}

ReductionSlot& Warehouse::slot(int number) {
  auto& slot = reductions_[number];
  if (!slot) {
    slot = (*table_)[number].label->makeReduction();
    takeRestored(number);
  }
  return *slot;
}

void Warehouse::resetReduction(int number) {
  if (auto& slot = reductions_[number])
    slot->reset();
  else
    restored_.erase(number);
}

std::vector<double> Warehouse::reductionValues(int number) const {
  const auto& slot = reductions_[number];
  return slot ? slot->values() : std::vector<double>{};
}

std::span<const std::byte> Warehouse::reductionBytes(int number) const {
  if (const auto& slot = reductions_[number]) return slot->bytes();
  const auto restored = restored_.find(number);
  return restored == restored_.end() ? std::span<const std::byte>{} : std::span<const std::byte>(restored->second);
}

void Warehouse::restoreReduction(int number, std::vector<std::byte> bytes) {
  restored_[number] = std::move(bytes);
  if (reductions_[number]) takeRestored(number);
}

void Warehouse::takeRestored(int number) {
  const auto restored = restored_.find(number);
  if (restored == restored_.end()) return;
  const std::span<std::byte> bytes = reductions_[number]->bytes();
  if (bytes.size() != restored->second.size())
    throw AccessError(fmt::format("{} was restored from a different type", (*table_)[number].label->name));
  std::copy(restored->second.begin(), restored->second.end(), bytes.begin());
  restored_.erase(restored);
}

Variable Warehouse::variable(Generation generation, int number, int patch) {
  Storage& held = storage(generation, number);
  if (!held.held) return {};
  const std::size_t at = placeOf(patch);
  const std::size_t bytes = (*table_)[number].label->bytes;
  const grid::Box stored = held.slots->stored.empty() ? grid::Box{} : held.slots->stored[at];
  return {held.memory.data() + held.slots->first[at] * bytes, stored, true};
}

void Warehouse::allocate(Storage& storage, const Label& label, const SharedSlots& slots, std::size_t values) {
  storage.held = true;
  if (storage.slots != slots) storage.slots = slots;
  pool_.reserve(storage.memory, values * label.bytes);
  if (!checked || label.number != Number::real) return;
  std::fill_n(reinterpret_cast<double*>(storage.memory.data()), values * label.bytes / sizeof(double),
              std::numeric_limits<double>::quiet_NaN());
}

void Warehouse::allocateGrid(Generation generation, int number) {
  const Label& label = *(*table_)[number].label;
  SharedSlots& slots = grid_slots_[{label.centring, table_->ghost(number)}];
  if (!slots) slots = slotsOfGrid(*grid_, label, table_->ghost(number));
  Storage& values = storage(generation, number);
  allocate(values, label, slots, slots->end);
  constexpr std::size_t mapped = std::size_t{1} << 21;  // smaller memory may be from the heap
  if (label.counts == Counts::nearParticles && values.memory.capacity() > mapped)
    adviseSmallPages(values.memory.data(), values.memory.capacity());
}

void Warehouse::clear(Generation generation, int number) {
  Storage& cleared = storage(generation, number);
  std::fill_n(cleared.memory.data(), cleared.slots->end * (*table_)[number].label->bytes, std::byte{0});
}

void Warehouse::allocateRims(Generation generation, int number) {
  SharedSlots& slots = grid_slots_[{Centring::rim, 0}];
  if (!slots) slots = slotsOfRims(*grid_);
  Storage& rims = storage(generation, number);
  const Label& label = *(*table_)[number].label;
  allocate(rims, label, slots, slots->end);
  std::fill_n(reinterpret_cast<double*>(rims.memory.data()), slots->end * label.bytes / sizeof(double), 0.0);
}

void Warehouse::allocateParticles(Generation generation, int number, Generation set) {
  const auto [label, material] = (*table_)[number];
  if (!layout(set, material).slots) layOut(set, material, set);
  const Layout& where = layout(set, material);
  allocate(storage(generation, number), *label, where.slots, valuesWithCopies(where, number));
}

/// Number of values of a variable for which memory is needed, including ghost copies. A variable that is read outside
/// its patches keeps space for the largest number of ghost copies so far.
std::size_t Warehouse::valuesWithCopies(const Layout& layout, int number) const {
  return layout.slots->end + (table_->ghost(number) > 0 ? layout.mostCopies : 0);
}

/// Releases the memory of a variable, unless the buffer is small: releasing and finding a small buffer again takes
/// longer than using it. The slots stay with the memory.
void Warehouse::free(Generation generation, int number) {
  constexpr std::size_t little = std::size_t{1} << 13;
  Storage& freed = storage(generation, number);
  freed.held = false;
  if (freed.memory.capacity() <= little) return;
  freed.slots.reset();
  pool_.takeBack(freed.memory);
}

void Warehouse::layOut(Generation generation, int material, Generation base) {
  std::vector<std::size_t> counts;
  for (const grid::Patch& patch : grid_->patches())
    counts.push_back(particles(generation, material, patch.id()).owned());
  Layout& where = layout(generation, material);
  where.slots = slotsThatFit(layout(base, material).slots, counts);
  where.mostCopies = std::max(where.mostCopies, layout(base, material).mostCopies);
  where.copies = 0;
}

Buffer Warehouse::follow(Generation generation, int number, Generation set) {
  const auto [label, material] = (*table_)[number];
  Storage& moved = storage(generation, number);
  const Layout& where = layout(set, material);
  if (moved.held && moved.slots == where.slots) return {};
  if (moved.held && where.slots->extends(*moved.slots)) {
    pool_.reserve(moved.memory, where.slots->end * label->bytes, moved.slots->end * label->bytes);
    moved.slots = where.slots;
    return {};
  }
  return renew(generation, number, set);
}

Buffer Warehouse::renew(Generation generation, int number, Generation set) {
  Buffer before = std::exchange(storage(generation, number).memory, Buffer());
  allocateParticles(generation, number, set);
  return before;
}

const SharedSlots& Warehouse::slots(Generation generation, int number) const {
  return (generation == Generation::old ? old_ : fresh_).storages[number].slots;
}

int Warehouse::distance(Generation set, int material, int from, int to) {
  const std::vector<std::size_t>& first = layout(set, material).slots->first;
  return static_cast<int>(first[placeOf(to)]) - static_cast<int>(first[placeOf(from)]);
}

int Warehouse::placeCopies(Generation set, int material, int patch, int count) {
  Layout& where = layout(set, material);
  const std::size_t first = where.slots->end + where.copies;
  where.copies += count;
  where.mostCopies = std::max(where.mostCopies, where.copies);
  return static_cast<int>(first) - static_cast<int>(where.slots->first[placeOf(patch)]);
}

void Warehouse::reserveCopies(Generation generation, int number, Generation set) {
  const auto [label, material] = (*table_)[number];
  const Layout& where = layout(set, material);
  Buffer& memory = storage(generation, number).memory;
  pool_.reserve(memory, (where.slots->end + where.copies) * label->bytes, memory.capacity());
}

void Warehouse::releaseFreeMemory() {
  pool_.release();
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

void Warehouse::beginStep() { pool_.beginStep(); }

bool Warehouse::isHeld(Generation generation, int number) {
  return ranks_->any(!grid_->patches().empty() && storage(generation, number).held);
}

void Warehouse::makeOld(int number) {
  std::swap(storage(Generation::old, number), storage(Generation::fresh, number));
  free(Generation::fresh, number);
}

void Warehouse::swapSets(int material) {
  std::swap(layout(Generation::old, material), layout(Generation::fresh, material));
  for (const grid::Patch& patch : grid_->patches())
    std::swap(particles(Generation::old, material, patch.id()), particles(Generation::fresh, material, patch.id()));
}

void Warehouse::forgetGhosts() {
  for (State* state : {&old_, &fresh_}) {
    for (Layout& where : state->layouts) where.copies = 0;
    for (ParticleSet& set : state->sets) set.forgetGhosts();
  }
}

}  // namespace tushar::data
