#include "coupling/replay_fines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace puffin::coupling {
namespace {

/// Demand of the drag law by carrier, for the time between two of its contacts.
class DragDemand {
 public:
  DragDemand(const FinesRecord& record, const micromodels::FinesModels& models)
      : record_(record), total_(record.carriers.size(), 0.0), since_(record.carriers.size(), 0.0) {
    if (!models.drag_detach) return;
    acts_ = true;
    own_ = !record.rates.empty() && sample_rates(*models.drag_detach) == record.rates;
    if (own_) return;
    for (const auto& s : record.slip)
      if (s.seconds > 0.0)
        total_.at(s.carrier) +=
            rate(*models.drag_detach, s.metres / s.seconds) * s.seconds * record.carriers[s.carrier].initial;
  }
  /// `recorded`: what the run's own law asked for.
  double until(std::int64_t id, double time, double recorded) {
    if (!acts_ || own_) return acts_ ? recorded : 0.0;
    const double part = record_.end > 0.0 ? (time - since_[id]) / record_.end : 0.0;
    since_[id] = time;
    return std::max(0.0, part) * total_[id];
  }

 private:
  const FinesRecord& record_;
  std::vector<double> total_, since_;
  bool acts_ = false, own_ = false;
};

/// Of the dose: of less, much may have rested where it was released (lbm::ScalarOptions::negligible), so the run does
/// not say where it would have gone.
constexpr double known_part = 1e-5;

/// Empty if no more than `least` of the kind was released. Rounding may have left a little more than that emitted or on
/// the walls.
std::optional<FinesRecord::Share> fate(const std::array<FinesRecord::Share, mechanisms>& shares, int only,
                                       double least) {
  FinesRecord::Share sum;
  for (int m = 0; m < mechanisms; ++m) {
    if (only >= 0 && m != only) continue;
    sum.released += shares[m].released;
    sum.emitted += shares[m].emitted;
    sum.deposited += shares[m].deposited;
  }
  if (!(sum.released > least)) return {};
  const double emitted = std::clamp(sum.emitted / sum.released, 0.0, 1.0);
  return FinesRecord::Share{1.0, 0.0, emitted, std::clamp(sum.deposited / sum.released, 0.0, 1.0 - emitted)};
}

Ledger books(const Replayed& replayed, const FinesRecord& record, const std::vector<double>& left,
             const std::array<FinesRecord::Share, mechanisms>& shares) {
  Ledger ledger;
  lbm::CompensatedSum loaded, inside, outside;
  for (std::size_t id = 0; id < left.size(); ++id) {
    loaded.add(record.carriers[id].initial);
    (record.carriers[id].emitted ? outside : inside).add(left[id]);
  }
  ledger.loaded = loaded.value();
  ledger.on_carriers = inside.value();
  ledger.on_emitted_carriers = outside.value();
  ledger.on_walls = replayed.to_wall;
  for (int m = 0; m < mechanisms; ++m) {
    auto went = fate(shares, m, known_part * ledger.loaded);
    if (!went) went = fate(shares, -1, 0.0);
    const FinesRecord::Share share = went.value_or(FinesRecord::Share{});
    Ledger::Shares& mine = ledger.by_mechanism[m];
    mine.released = replayed.to_air[m];
    mine.emitted = share.emitted * mine.released;
    const double deposited = share.deposited * mine.released;
    mine.in_air = mine.released - mine.emitted - deposited;
    ledger.on_walls += deposited;
    ledger.in_air += mine.in_air;
    ledger.emitted += mine.emitted;
  }
  return ledger;
}

}  // namespace

Replayed replay(const FinesRecord& record, const micromodels::FinesModels& models) {
  micromodels::check(models);
  std::vector<double> left;
  for (const auto& carrier : record.carriers) left.push_back(carrier.initial);
  std::array<lbm::CompensatedSum, mechanisms> to_air;
  lbm::CompensatedSum to_wall;
  DragDemand drag(record, models);
  const auto blow = [&](std::int64_t id, double time, double recorded) {
    if (id < 0 || id >= static_cast<std::int64_t>(left.size()))
      throw std::invalid_argument("a contact names carrier " + std::to_string(id) + ", which the run did not have");
    to_air[static_cast<int>(Mechanism::drag)].add(take(drag.until(id, time, recorded), 0.0, left[id]).air);
  };
  const auto lose = [&](std::int64_t id, Mechanism mechanism, const micromodels::Taken& asked) {
    const Taken taken = take(asked.to_air, asked.to_wall, left[id]);
    to_air[static_cast<int>(mechanism)].add(taken.air);
    to_wall.add(taken.wall);
  };
  for (const auto& c : record.contacts) {
    if (c.a_loses) blow(c.a, c.time, c.drag_a);
    if (c.b < 0) {
      if (c.a_loses)
        lose(c.a, Mechanism::wall,
             impact_on_wall(models, c.normal_speed, c.angle, record.carriers[c.a].initial, left[c.a]));
      continue;
    }
    if (c.b_loses) blow(c.b, c.time, c.drag_b);
    const double speed = std::hypot(c.normal_speed, c.tangential_speed);
    for (const auto& [id, loses] : {std::pair{c.a, c.a_loses}, std::pair{c.b, c.b_loses}})
      if (loses)
        lose(id, Mechanism::particle, impact_on_carrier(models, speed, c.angle, record.carriers[id].initial, left[id]));
  }
  for (std::size_t id = 0; id < left.size(); ++id)
    blow(static_cast<std::int64_t>(id), record.end, record.carriers[id].drag_rest);

  Replayed result;
  for (int m = 0; m < mechanisms; ++m) result.to_air[m] = to_air[m].value();
  result.to_wall = to_wall.value();
  for (const auto& shares : record.sets) result.sets.push_back(books(result, record, left, shares));
  return result;
}

}  // namespace puffin::coupling
