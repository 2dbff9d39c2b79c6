#pragma once
// Diameters of carriers that differ.

#include <cstdint>
#include <vector>

#include "cases/case.hpp"

namespace puffin::cases {

/// A distribution as a table: a share of the number of carriers for each of many diameters, ascending.
struct SizeTable {
  std::vector<double> diameter;    // [m]
  std::vector<double> cumulative;  // share of the number up to and with it; the last is 1
};

/// Resolves a distribution between its cuts (log-normal and Rosin-Rammler without cuts: where all but 1e-3 of the
/// volume lies on either side). Shares of volume become shares of number by d^-3, in 2,000 classes.
/// Sources: Hatch & Choate, J. Franklin Inst. 207, 369 (1929); Rosin & Rammler, J. Inst. Fuel 7, 29 (1933).
/// Throws std::runtime_error naming file and line of a bad table, std::invalid_argument if the cuts leave nothing.
SizeTable size_table(const SizeDistribution& distribution);

/// Diameter of a carrier of mean volume [m]: number times its mass is the mass of all.
double mean_volume_diameter(const SizeTable& table);

/// `count` diameters [m], one from each of `count` equal shares of the number, so that few carriers have the
/// distribution's mass too; in an order that follows from the seed.
std::vector<double> draw_diameters(const SizeTable& table, std::int64_t count, std::uint64_t seed);

}  // namespace puffin::cases
