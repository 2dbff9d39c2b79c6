#include "coupling/fines.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupling/first_motion.hpp"

namespace puffin::coupling {

Fines::Fines(const dem::Carriers& carriers, double fines_each, std::size_t triangles)
    : initial(id_range(carriers), 0.0), emitted(initial.size(), 0), stuck(triangles, 0.0) {
  if (!(fines_each >= 0.0)) throw std::invalid_argument("the number of fines a carrier must be 0 or more");
  lbm::CompensatedSum sum;
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    initial[carriers.id[i]] = fines_each * carriers.carriers[i];
    sum.add(initial[carriers.id[i]]);
  }
  left = initial;
  slip = SlipHistory(initial.size());
  loaded = sum.value();
}

Taken take(double to_air, double to_wall, double& left) {
  const double before = left;
  left = std::max(0.0, before - (to_air + to_wall));
  const double taken = before - left;
  const double wall = std::min(to_wall, taken);
  return {taken - wall, wall};
}

void mark_emitted(std::span<const std::int64_t> ids, Fines& fines) {
  for (const std::int64_t id : ids) fines.emitted.at(id) = 1;
}

double Ledger::error() const {
  if (!(loaded > 0.0)) return 0.0;
  lbm::CompensatedSum sum;
  for (const double fines : {on_carriers, on_emitted_carriers, on_walls, in_air, emitted}) sum.add(fines);
  sum.add(-loaded);
  return sum.value() / loaded;
}

namespace {

double sum_over_patches(const std::vector<lbm::CompensatedSum>& patches) {
  lbm::CompensatedSum sum;
  for (const auto& patch : patches) sum.add(patch.value());
  return sum.value();
}

}  // namespace

Ledger ledger(const Fines& fines, const lbm::ScalarFields& fields, const lbm::ScalarBudget& budget, int set) {
  Ledger books;
  lbm::CompensatedSum inside, outside, walls, loaded;
  loaded.add(fines.loaded);
  if (set < static_cast<int>(fines.placed.size())) loaded.add(fines.placed[set]);
  for (std::size_t id = 0; id < fines.left.size(); ++id) (fines.emitted[id] ? outside : inside).add(fines.left[id]);
  books.on_carriers = inside.value();
  books.on_emitted_carriers = outside.value();
  walls.add(fines.to_wall.value());
  walls.add(-fines.picked_up.value());
  for (int m = 0; m < mechanisms; ++m) {
    const int scalar = scalar_index(set, static_cast<Mechanism>(m));
    const double deposited = lbm::absorbed(budget, scalar);
    Ledger::Shares& shares = books.by_mechanism[m];
    shares.released = fines.to_air[m].value();
    shares.in_air = lbm::total(fields, scalar);
    shares.emitted = sum_over_patches(budget.left.at(scalar));
    shares.deposited = deposited;
    shares.regained = fines.regained[m].value();
    loaded.add(sum_over_patches(budget.entered.at(scalar)));
    walls.add(deposited);
    books.in_air += shares.in_air;
    books.emitted += shares.emitted;
  }
  books.on_walls = walls.value();
  books.loaded = loaded.value();
  return books;
}

std::vector<double> wall_map(const Fines& fines, const lbm::ScalarBudget& budget, int set,
                             std::span<const int> triangle_of_slot) {
  std::vector<double> map = fines.stuck;
  for (int m = 0; m < mechanisms; ++m) {
    const auto& absorbed = budget.absorbed_at[scalar_index(set, static_cast<Mechanism>(m))];
    for (std::size_t slot = 0; slot < absorbed.size(); ++slot) {
      if (absorbed[slot] == 0.0) continue;
      const int triangle = slot < triangle_of_slot.size() ? triangle_of_slot[slot] : -1;
      if (triangle < 0)
        throw std::invalid_argument("fines were deposited in a cell that no triangle of the wall is assigned to");
      map.at(triangle) += absorbed[slot];
    }
  }
  return map;
}

}  // namespace puffin::coupling
