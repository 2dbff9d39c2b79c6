#pragma once
// What a case file says, in SI units, checked: one struct per table of the file, one member per key. A Case that
// `read_case` returned has no unset required value and no contradiction; what needs the geometry (areas, volumes)
// is resolved later by the builder.

#include <map>
#include <optional>
#include <string>

#include "cases/case_air.hpp"
#include "cases/case_carriers.hpp"
#include "cases/case_fines.hpp"
#include "cases/case_geometry.hpp"
#include "cases/case_numerics.hpp"
#include "cases/case_output.hpp"
#include "cases/case_values.hpp"

namespace puffin::cases {

/// Where a value came from. assumed: given, and the line's comment says "assumed: why".
enum class Origin { given, defaulted, derived, assumed };
struct ValueSource {
  Origin origin = Origin::given;
  std::string note;  // the reason of an assumption, the formula of a derived value
  bool operator==(const ValueSource&) const = default;
};

/// Where each key stands in the file, for errors that only the geometry brings to light; no part of what a case says.
struct KeyPlace {
  std::string file;
  int line = 0, column = 0;
};
struct KeyPlaces {
  std::map<std::string, KeyPlace> of;  // by dotted key
  bool operator==(const KeyPlaces&) const { return true; }
};

struct Case {
  std::string name;
  Geometry geometry;
  Air air;
  Numerics numerics;
  std::optional<Carriers> carriers;
  std::optional<Fines> fines;
  Stop stop;
  Output output;
  std::map<std::string, Parameter> reference;
  std::map<std::string, ValueSource> provenance;  // by dotted key, "air.boundary[0].flow_rate"
  KeyPlaces places;
  bool operator==(const Case&) const = default;
};

}  // namespace puffin::cases
