#include <algorithm>

#include "cases/format/read_fields.hpp"
#include "cases/spelling.hpp"
#include "cases/verification/ablation.hpp"
#include "cases/verification/overrides.hpp"

namespace puffin::cases {
namespace {

using format::Fields;
using format::otherwise;
using format::required;

void describe(Fields& io, AblationScene& s) {
  io.text("name", s.name, required);
  io.text("what", s.what, required);
  std::string file;
  io.file("case", file, {});
  s.case_file = file;
  s.quick_sets = overrides(io, "quick_set");
}

void describe(Fields& io, Ablation& a, const AblationList& list) {
  io.text("name", a.name, required);
  io.text("scene", a.scene, required);
  a.off = overrides(io, "off");
  if (a.off.empty()) io.problem("off", "name the settings that compute what is skipped");
  io.flag("exact", a.exact, otherwise(false));
  io.texts("answers", a.answers, otherwise(a.answers));
  std::vector<std::string> names;
  for (const AblationScene& s : list.scenes) names.push_back(s.name);
  if (std::find(names.begin(), names.end(), a.scene) == names.end())
    io.problem("scene", "there is no scene '" + a.scene + "'; the scenes are " + join(names));
}

}  // namespace

AblationList read_ablations(const std::filesystem::path& file) {
  AblationList list;
  format::read_fields(file, [&](Fields& io) {
    io.list("scene", list.scenes, [](Fields& f, AblationScene& s) { describe(f, s); });
    io.list("skip", list.skips, [&](Fields& f, Ablation& a) { describe(f, a, list); });
  });
  return list;
}

}  // namespace puffin::cases
