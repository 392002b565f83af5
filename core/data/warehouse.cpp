#include "core/data/warehouse.hpp"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <limits>

#include "core/base/mpi.hpp"
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
  const auto at = static_cast<std::size_t>(number);
  ghosts_[at] = std::max(ghosts_[at], ghost);
  if (names_[at].label->centring != Centring::particle) return;
  const auto material = static_cast<std::size_t>(names_[at].material);
  if (reaches_.size() <= material) reaches_.resize(material + 1, 0);
  reaches_[material] = std::max(reaches_[material], ghost);
}

Warehouse::Warehouse(const grid::Level& level, VariableTable& table)
    : Warehouse(level, table, mpi::Communicator::alone()) {}

void Warehouse::grow(int materials) {
  const std::size_t places = place(table_->size(), level_->firstPatch());
  old_.resize(std::max(old_.size(), places));
  fresh_.resize(std::max(fresh_.size(), places));
  reductions_.resize(std::max(reductions_.size(), static_cast<std::size_t>(table_->size())));
  for (std::deque<Variable>* variables : {&old_, &fresh_})
    for (std::size_t k = 0; k < variables->size(); ++k) (*variables)[k].pool = static_cast<int>(k % level_->patches().size());
  pools_.resize(level_->patches().size());
  const std::size_t sets = place(materials, level_->firstPatch());
  old_sets_.resize(std::max(old_sets_.size(), sets));
  fresh_sets_.resize(std::max(fresh_sets_.size(), sets));
}

void Warehouse::startAnew(int materials) {
  old_.clear();
  fresh_.clear();
  old_sets_.clear();
  fresh_sets_.clear();
  pools_.clear();
  grow(materials);
}

ReductionSlot& Warehouse::slot(int number) {
  auto& slot = reductions_[static_cast<std::size_t>(number)];
  if (!slot) {
    slot = (*table_)[number].label->makeReduction();
    takeRestored(number);
  }
  return *slot;
}

void Warehouse::resetReduction(int number) {
  if (auto& slot = reductions_[static_cast<std::size_t>(number)])
    slot->reset();
  else
    restored_.erase(number);
}

std::vector<double> Warehouse::reductionValues(int number) const {
  const auto& slot = reductions_[static_cast<std::size_t>(number)];
  return slot ? slot->values() : std::vector<double>{};
}

std::span<const std::byte> Warehouse::reductionBytes(int number) const {
  if (const auto& slot = reductions_[static_cast<std::size_t>(number)]) return slot->bytes();
  const auto restored = restored_.find(number);
  return restored == restored_.end() ? std::span<const std::byte>{} : std::span<const std::byte>(restored->second);
}

void Warehouse::restoreReduction(int number, std::vector<std::byte> bytes) {
  restored_[number] = std::move(bytes);
  if (reductions_[static_cast<std::size_t>(number)]) takeRestored(number);
}

void Warehouse::takeRestored(int number) {
  const auto restored = restored_.find(number);
  if (restored == restored_.end()) return;
  const std::span<std::byte> bytes = reductions_[static_cast<std::size_t>(number)]->bytes();
  if (bytes.size() != restored->second.size())
    throw AccessError(fmt::format("{} was restored from another type", (*table_)[number].label->name));
  std::copy(restored->second.begin(), restored->second.end(), bytes.begin());
  restored_.erase(restored);
}

namespace {
void fillWithNaN(Buffer& buffer, const Label& label, std::size_t fromByte, std::size_t toByte) {
  if (!checked || label.number != Number::real) return;
  auto* values = reinterpret_cast<double*>(buffer.data());
  std::fill(values + fromByte / sizeof(double), values + toByte / sizeof(double),
            std::numeric_limits<double>::quiet_NaN());
}
}  // namespace

void Warehouse::allocateGrid(Variable& variable, int number, const grid::Patch& patch) {
  const Label& label = *(*table_)[number].label;
  const int ghost = table_->ghost(number);
  variable.stored = label.centring == Centring::node ? patch.nodesWithin(ghost) : patch.cellsWithin(ghost);
  const std::size_t bytes = variable.stored.size() * label.bytes;
  variable.held = true;
  pools_[static_cast<std::size_t>(variable.pool)].reserve(variable.values, bytes);
  fillWithNaN(variable.values, label, 0, bytes);
}

void Warehouse::allocateParticles(Variable& variable, const Label& label, int count, int keep) {
  const std::size_t kept = static_cast<std::size_t>(keep) * label.bytes;
  const std::size_t bytes = static_cast<std::size_t>(count) * label.bytes;
  variable.held = true;
  pools_[static_cast<std::size_t>(variable.pool)].reserve(variable.values, bytes, kept);
  fillWithNaN(variable.values, label, kept, bytes);
}

void Warehouse::free(Variable& variable) {
  variable.held = false;
  pools_[static_cast<std::size_t>(variable.pool)].takeBack(variable.values);
}

void Warehouse::releaseFreeMemory() {
  for (BufferPool& pool : pools_) pool.release();
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

std::size_t Warehouse::allocations() const {
  std::size_t all = 0;
  for (const BufferPool& pool : pools_) all += pool.allocations();
  return all;
}

bool Warehouse::isHeld(Generation generation, int number) {
  const auto& patches = level_->patches();
  return ranks_->any(!patches.empty() && variable(generation, number, patches.front().id()).held);
}

void Warehouse::makeOld(int number) {
  for (const grid::Patch& patch : level_->patches()) {
    std::swap(old_[place(number, patch.id())], fresh_[place(number, patch.id())]);
    free(fresh_[place(number, patch.id())]);
  }
}

void Warehouse::swapSets(int material) {
  for (const grid::Patch& patch : level_->patches())
    std::swap(old_sets_[place(material, patch.id())], fresh_sets_[place(material, patch.id())]);
}

void Warehouse::forgetGhosts() {
  for (std::deque<ParticleSet>* sets : {&old_sets_, &fresh_sets_})
    for (ParticleSet& set : *sets) set.forgetGhosts();
}

}  // namespace tushar::data
