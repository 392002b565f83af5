#include "core/report/memory_use.hpp"

#include <array>

namespace tushar::report {

namespace {

using Numbers = std::array<double, 5>;

Numbers numbersOf(const MemoryUse& use) { return {use.peak, use.fields, use.particles, use.buffers, use.files}; }

MemoryUse useOf(const Numbers& numbers) { return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]}; }

}  // namespace

void addVariables(const data::Warehouse& warehouse, MemoryUse& use) {
  const data::VariableTable& table = warehouse.table();
  for (int number = 0; number < table.size(); ++number) {
    const data::Label& label = *table[number].label;
    if (label.centring == data::Centring::reduction) continue;
    double& sum = label.centring == data::Centring::particle ? use.particles : use.fields;
    for (const auto generation : {data::Generation::old, data::Generation::fresh})
      if (const data::SharedSlots& slots = warehouse.slots(generation, number))
        sum += static_cast<double>(slots->end * label.bytes);
  }
}

MemoryOfRanks ofRanks(const MemoryUse& mine, const mpi::Communicator& ranks) {
  Numbers most = numbersOf(mine), sum = most;
  ranks.max(most);
  for (double& number : sum) number = static_cast<double>(ranks.sum(static_cast<long>(number)));
  return {useOf(sum), useOf(most)};
}

}  // namespace tushar::report
