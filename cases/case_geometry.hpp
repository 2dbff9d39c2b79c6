#pragma once
// [geometry]: the surface, generated or read, and its patches.

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "cases/case_values.hpp"

namespace puffin::cases {

struct Generated {
  std::string kind;                             // "l-bend", ...; the parameters not given keep the generator's defaults
  std::map<std::string, Parameter> parameters;  // [m], angles [rad]
  bool operator==(const Generated&) const = default;
};
struct StlFile {
  std::string file;    // path as it can be opened (a relative one is relative to the case file)
  double unit = 1e-3;  // [m] length of one unit of the file
  bool operator==(const StlFile&) const = default;
};
struct Patch {
  std::string name;
  std::string select;  // "solid:NAME", "plane:x-min", "near:[x,y,z]" [m]: checked, as lbm/geometry/patches.hpp reads it
  bool operator==(const Patch&) const = default;
};
struct Geometry {
  std::variant<Generated, StlFile> source;
  std::vector<Patch> patches;  // tagged by hand; a generator names its own patches
  bool operator==(const Geometry&) const = default;
};

}  // namespace puffin::cases
