#pragma once
// A sub-step of its own for each contact: see integrate() in cluster.hpp.

#include "dem/cluster.hpp"

namespace puffin::dem {

inline constexpr int most_ticks = 16;  // between two meetings of all levels, as planned

/// The ticks between two meetings of all levels.
struct Ticks {
  double length = 0.0;  // [s]
  double count = 1.0;   // that are left in the air step, a whole number
  int last = 1;         // until all levels meet again, a power of two
  int levels = 0;       // 2^levels = last
};

/// The shortest step that any touch asks for [s], at most `longest`.
double shortest_step(double longest, const Cluster& cluster);

/// How long the drag may be held constant [s], at most `longest`: a tenth of the response time.
double longest_meeting(double longest, const Cluster& cluster);

/// Divides `remaining` into ticks of at most `least`, the first of which end within `look`, and gives every touch its
/// level.
Ticks plan(double least, double remaining, double look, Cluster& cluster);

/// Opens the sub-steps of all touches at `time` and goes through all ticks, up to the drift of the last one. Drag and
/// steady forces act in every tick.
/// A contact that needs shorter ticks than planned halves them for all: `ticks` is then other than it was.
void run_levels(double time, double remaining, const Rules& rules, Ticks& ticks, Cluster& cluster);

/// Evaluates one touch h [s] after its last look and notes its step.
void look_at(std::size_t index, double h, double time, double horizon, const Rules& rules, Cluster& cluster);

/// Adds what the touch's force will have given its bodies at the end of its sub-step to their kick and twist.
void foresee(const Touch& touch, Cluster& cluster);

/// The touch's force acts on its bodies for the time h [s].
void kick(double h, const Touch& touch, Cluster& cluster);

}  // namespace puffin::dem
