#include "cases/write_case.hpp"

#include "cases/format/schema.hpp"
#include "cases/format/text_fields.hpp"

namespace puffin::cases {
namespace {

std::string body_of(const Case& c, const std::map<std::string, ValueSource>& sources) {
  Case copy = c;  // the schema fills and prints through the same non-const references
  format::TextFields fields("", "", sources);
  format::describe(fields, copy);
  return fields.text();
}

}  // namespace

std::string write_resolved(const Case& c) {
  return "# The case as it was run. Behind each value: given, default, derived: how, or assumed: why.\n" +
         body_of(c, c.provenance);
}

std::vector<std::string> assumptions(const Case& c) {
  std::vector<std::string> list;
  for (const auto& [key, source] : c.provenance)
    if (source.origin == Origin::assumed) list.push_back(key + (source.note.empty() ? "" : ": " + source.note));
  return list;
}

}  // namespace puffin::cases
