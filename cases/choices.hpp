#pragma once
// The closed lists of the case file: the words of every enum, and which of them this version offers.

#include <span>
#include <string_view>

#include "cases/case.hpp"

namespace puffin::cases {

struct Choice {
  int value;              // the enumerator
  std::string_view name;  // as written in the file
  bool offered;           // false: a word of the interface that this version refuses
};

/// The words of an enum of case.hpp; specialised for each in choices.cpp.
template <class Enum>
std::span<const Choice> choices();

/// The word of an enumerator.
template <class Enum>
std::string_view name_of(Enum value) {
  for (const Choice& c : choices<Enum>())
    if (c.value == static_cast<int>(value)) return c.name;
  return "?";
}

/// The kinds of frozen field, in the order of FrozenField; the kind is a word ("uniform") or the key of a table.
std::span<const Choice> frozen_field_kinds();

/// Features that are switched on by a value instead of a word.
struct Features {
  bool wall_model;         // numerics.wall_model = true
  bool inlet_turbulence;   // air.boundary.turbulence > 0
  bool body_force_file;    // air.body_force = { file }
  bool velocity_friction;  // carriers.contact.friction = { law = "velocity" }
  bool rolling_friction;   // carriers.contact.rolling_friction > 0
  bool fixed_values;       // [[fines.boundary]]
};
extern const Features features;

}  // namespace puffin::cases
