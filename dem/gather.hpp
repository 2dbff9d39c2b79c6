#pragma once
// Who may meet whom within one air step: the guess of clusters, its check, and what comes of it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/cluster.hpp"
#include "dem/state.hpp"

namespace puffin::dem {

/// Scratch of one air step; kept between steps for its memory alone.
struct Gathering {
  std::vector<std::int32_t> awake;                 // places, ascending
  std::vector<Eigen::Vector3d> acceleration;       // by load, drag and gravity, of each carrier that is awake [m/s^2]
  std::vector<double> margin;                      // how far a carrier may leave its straight course in this step [m]
  std::vector<std::uint8_t> at_wall;               // may touch a wall in this step
  std::vector<std::array<std::int32_t, 2>> pairs;  // may touch each other in this step; the first is awake
  std::vector<std::vector<std::array<std::int32_t, 2>>> part_pairs;  // found by each part of the awake carriers
  std::vector<double> blows;                        // how far each pair's meeting may change both courses together [m]
  std::vector<std::int32_t> parent;                 // union-find
  std::vector<std::int32_t> cluster_of;             // -1: free flight
  std::vector<std::int32_t> local_of;               // place in its cluster
  std::vector<std::int32_t> member_begin, members;  // of each cluster: its awake carriers, ascending
  std::vector<std::int32_t> pair_begin, pair_order;
  std::vector<Cluster> clusters;  // the first `used` hold this step
  std::size_t used = 0;
};

/// Lists the awake carriers, their accelerations, first margins and the walls they may touch.
void predict(double duration, const Rules& rules, const Walls& walls, std::span<const Load> loads, State& state,
             Gathering& gathering);

/// True if the neighbour list is complete for every awake carrier's way in this step.
bool neighbours_suffice(double duration, const State& state, const Gathering& gathering);

/// Gives each carrier a budget for eight steps at its speed, fewer where the lists would grow too long (fines at 30 m/s
/// travel 34 of their diameters between two exchanges), and builds the list.
void renew_neighbours(double duration, const Rules& rules, const Gathering& gathering, State& state);

/// Finds the pairs that may touch and unites them, live contacts and walls into clusters.
void find_clusters(double duration, const Rules& rules, const State& state, Gathering& gathering);

/// Empties the clusters that keep memory for many times the carriers they are about to hold: clusters are numbered by
/// their first carrier, so that a bed of thousands is now this one, now that one, and each would keep room for all of
/// it.
void give_back(Gathering& gathering);

/// Copies the carriers, contacts and candidates of cluster `index` out of `state`.
void fill(std::size_t index, double time, const Rules& rules, std::span<const Load> loads, const State& state,
          Gathering& gathering);

/// Compares the computed step with the guess. False if carriers left their margins so far that a pair outside the
/// clusters may have met (margins are enlarged then), left their budget (the list is then invalid), or pushed a sleeper
/// beyond its limit (it is then awake): the step must be gathered and computed again.
bool guess_held(double duration, State& state, Gathering& gathering);

}  // namespace puffin::dem
