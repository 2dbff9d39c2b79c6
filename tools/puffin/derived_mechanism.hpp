#pragma once
// What `puffin micromodel derive` found of wall or carrier, and how it is written: comment, tables, JSON.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "micromodels/derivation/derive.hpp"
#include "micromodels/table_law.hpp"

namespace puffin::tools {

struct DerivedMechanism {
  micromodels::derivation::Scene scene;
  std::vector<micromodels::derivation::DerivedPoint> points;  // all angles
  std::vector<micromodels::derivation::DerivedPoint> fitted;  // head on, fines not crushed
  micromodels::derivation::PowerFit detach, attach;           // attach: walls alone
  double half = 0.0;                                          // half_predicts_half of them
};

/// Elastic overlaps beyond the fine's radius are no contacts any more; where walls yield, a fine can be pressed in
/// whole.
bool sound(const micromodels::derivation::DerivedPoint& p, const micromodels::derivation::Scene& s);

/// What stands above a law: how it was found, its constants with their intervals. impacts: asked for where it is steep.
std::string detach_comment(const DerivedMechanism& m, int impacts);
std::string attach_comment(const DerivedMechanism& m, int impacts);

/// Every point with all that was seen, as CSV.
void write_points(const std::filesystem::path& file, const DerivedMechanism& m);

/// A fraction of the points, with its error.
struct Fraction {
  double micromodels::derivation::DerivedPoint::*value;
  double micromodels::derivation::DerivedPoint::*error;
};

/// The points themselves as a law, with every angle; written to `file` too.
micromodels::TableLaw tabulate(const DerivedMechanism& m, std::vector<double> angles, const Fraction& fraction,
                               micromodels::Validity valid, const std::filesystem::path& file);

nlohmann::json as_json(const DerivedMechanism& m);

}  // namespace puffin::tools
