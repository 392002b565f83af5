#include "core/solvers/box_delivery.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace tushar::solvers {

namespace {

// A letter consists of the number of rows, the rows, and for each row its numbers: diagonal, right, guess and links.
std::size_t headBytes(std::size_t rows) { return sizeof(std::uint64_t) + rows * sizeof(BoxCells); }

std::vector<BoxCells> rowsIn(const mpi::Bytes& letter) {
  std::uint64_t count = 0;
  std::memcpy(&count, letter.data(), sizeof(count));
  std::vector<BoxCells> rows(count);
  std::memcpy(rows.data(), letter.data() + sizeof(count), count * sizeof(BoxCells));
  return rows;
}

std::ptrdiff_t offsetIn(const BoxShape& shape, const BoxCells& row) {
  return shape.offset(row.first[0], row.first[1], row.first[2] - shape.slabs().first());
}

}  // namespace

BoxDelivery::BoxDelivery(const mpi::Communicator& ranks, std::vector<int> borders, std::vector<int> axes,
                         std::vector<BoxCells> rows)
    : ranks_(ranks),
      borders_(std::move(borders)),
      axes_(std::move(axes)),
      rows_(std::move(rows)),
      of_(borders_.size() - 1),
      outbox_(ranks) {
  static_assert(sizeof(BoxCells) == 4 * sizeof(int));
  for (std::size_t k = 0; k < rows_.size(); ++k) of_[ownerOf(rows_[k])].push_back(k);
  places_.resize(rows_.size());
  for (const std::vector<std::size_t>& rowsOf : of_) {
    std::size_t place = headBytes(rowsOf.size());
    for (const std::size_t k : rowsOf) {
      places_[k] = place;
      place += (3 + axes_.size()) * std::size_t(rows_[k].count) * sizeof(double);
    }
    mpi::Bytes& letter = letters_.emplace_back(rowsOf.empty() ? 0 : place);
    if (rowsOf.empty()) continue;
    const std::uint64_t count = rowsOf.size();
    std::memcpy(letter.data(), &count, sizeof(count));
    for (std::size_t k = 0; k < rowsOf.size(); ++k)
      std::memcpy(letter.data() + headBytes(k), &rows_[rowsOf[k]], sizeof(BoxCells));
  }
}

int BoxDelivery::ownerOf(const BoxCells& row) const {
  return static_cast<int>(std::ranges::upper_bound(borders_, row.first[2]) - borders_.begin()) - 1;
}

BoxDelivery::Numbers BoxDelivery::numbersOf(std::size_t row) {
  auto* first = reinterpret_cast<double*>(letters_[ownerOf(rows_[row])].data() + places_[row]);
  const std::ptrdiff_t count = rows_[row].count;
  return {first, first + count, first + 2 * count, first + 3 * count};
}

void BoxDelivery::take(int from, const mpi::Bytes& bytes, BoxSystem& system) {
  Received& received = received_.emplace_back(from, rowsIn(bytes));
  const auto* numbers = reinterpret_cast<const double*>(bytes.data() + headBytes(received.rows.size()));
  for (const BoxCells& row : received.rows) {
    const std::ptrdiff_t at = offsetIn(system.matrix.shape, row);
    const auto takeInto = [&](std::vector<double>& values) {
      std::copy_n(numbers, row.count, values.begin() + at);
      numbers += row.count;
    };
    takeInto(system.matrix.diagonal);
    takeInto(system.b);
    takeInto(system.x);
    for (const int axis : axes_) takeInto(system.matrix.links[axis]);
  }
}

void BoxDelivery::deliver(BoxSystem* system) {
  std::vector<mpi::Letter> others;
  for (std::size_t rank = 0; rank < letters_.size(); ++rank) {
    if (letters_[rank].empty()) continue;
    if (static_cast<int>(rank) == ranks_.rank())
      take(ranks_.rank(), letters_[rank], *system);
    else
      others.push_back({static_cast<int>(rank), std::move(letters_[rank])});
  }
  letters_.clear();
  mpi::exchange(ranks_, outbox_, std::move(others),
                [&](int from, const mpi::Bytes& bytes) { take(from, bytes, *system); });
}

std::vector<double> BoxDelivery::fetch(const BoxSystem* system) {
  std::vector<std::size_t> starts(rows_.size() + 1, 0);
  for (std::size_t k = 0; k < rows_.size(); ++k) starts[k + 1] = starts[k] + std::size_t(rows_[k].count);
  std::vector<double> solution(starts.back());
  const auto takeFrom = [&](int owner, const mpi::Bytes& bytes) {
    const std::byte* from = bytes.data();
    for (const std::size_t k : of_[owner]) {
      const std::size_t length = std::size_t(rows_[k].count) * sizeof(double);
      std::memcpy(solution.data() + starts[k], from, length);
      from += length;
    }
  };
  std::vector<mpi::Letter> others;
  for (const Received& received : received_) {
    mpi::Bytes bytes;
    for (const BoxCells& row : received.rows)
      mpi::append(bytes, system->x.data() + offsetIn(system->matrix.shape, row),
                  std::size_t(row.count) * sizeof(double));
    if (received.from == ranks_.rank())
      takeFrom(received.from, bytes);
    else
      others.push_back({received.from, std::move(bytes)});
  }
  mpi::exchange(ranks_, outbox_, std::move(others), takeFrom);
  return solution;
}

std::optional<Outcome> broadcast(const mpi::Communicator& ranks, const std::optional<Outcome>& outcome) {
  struct Numbers {
    bool exists = false, converged = false;
    int iterations = 0, worst = -1;
    double setup = 0, solve = 0, unbalanced = 0, loads = 0;
  } numbers;
  mpi::Bytes residuals;
  if (outcome) {
    numbers = {true,           outcome->converged, outcome->krylovIterations, outcome->worst,
               outcome->setup, outcome->solve,     outcome->unbalanced,       outcome->loads};
    mpi::append(residuals, outcome->residuals.data(), outcome->residuals.size() * sizeof(double));
  }
  numbers = ranks.broadcast(numbers);
  if (!numbers.exists) return std::nullopt;
  Outcome all;
  all.converged = numbers.converged;
  all.krylovIterations = numbers.iterations;
  all.worst = numbers.worst;
  all.setup = numbers.setup;
  all.solve = numbers.solve;
  all.unbalanced = numbers.unbalanced;
  all.loads = numbers.loads;
  all.reason = ranks.broadcast(outcome ? outcome->reason : std::string());
  residuals = ranks.broadcast(std::move(residuals));
  all.residuals.resize(residuals.size() / sizeof(double));
  std::memcpy(all.residuals.data(), residuals.data(), residuals.size());
  return all;
}

}  // namespace tushar::solvers
