#include "cases/derived.hpp"
#include "cases/format/schema.hpp"
#include "cases/search_path.hpp"

namespace puffin::cases::format {

void describe(Fields& io, Fines& fines, const std::optional<Carriers>& carriers) {
  if (io.has("micromodels", !fines.micromodels.empty()))
    io.file("micromodels", fines.micromodels, micromodel_directories());
  io.choice("wall_deposition", fines.wall_deposition, otherwise(WallDeposition::none));
  io.number("turbulent_schmidt", fines.turbulent_schmidt, unit::number, Range::non_negative, otherwise(0.0));
  io.number("reattachment", fines.reattachment, unit::number, Range::fraction, otherwise(0.0));
  io.number("pick_up", fines.pick_up, unit::number, Range::fraction, otherwise(0.0));
  const bool drift = fines.wall_deposition != WallDeposition::none;
  if (drift)
    io.vector("gravity", fines.gravity, unit::acceleration,
              otherwise(carriers ? carriers->gravity : Vec3(0, 0, -9.81)));
  const bool listed = carriers && !carriers->list.empty();
  if (drift || carriers || io.has("density", fines.density > 0.0))
    io.number("density", fines.density, unit::density, Range::positive,
              !carriers                 ? Fallback<double>{}
              : carriers->density > 0.0 ? derived(carriers->density, "carriers.density")
              : listed                  ? derived(carriers->list.front().density, "the first of carriers.list")
                                        : Fallback<double>{});
  if (drift || carriers || io.has("diameter", fines.diameter > 0.0)) {
    Fallback<double> diameter;
    if (carriers && (carriers->diameter > 0.0 || listed) && fines.density > 0.0)
      diameter =
          derived(fines_diameter(*carriers, fines.density), "sphere of fine_mass_ratio times the carrier's mass");
    io.number("diameter", fines.diameter, unit::length, Range::positive, diameter);
  }
  io.list("scalar", fines.scalars, [](Fields& f, Scalar& s) {
    f.text("name", s.name, required);
    f.number("diffusion", s.diffusion, unit::diffusion, Range::non_negative, otherwise(1e-6));
    f.choice("scheme", s.scheme, otherwise(ScalarScheme::mc));
    f.choice("wall", s.wall, otherwise(ScalarWall::reflect));
    if (!f.has("initial", s.initial.has_value())) return;
    if (f.reading()) s.initial.emplace();
    f.section("initial", [&](Fields& i) {
      std::string shape = "gaussian";
      i.text("shape", shape, required);
      if (shape != "gaussian") i.problem("shape", "the only shape is \"gaussian\"");
      i.vector("center", s.initial->center, unit::length, required);
      i.number("sigma", s.initial->sigma, unit::length, Range::positive, required);
      i.number("amount", s.initial->amount, unit::number, Range::positive, required);
    });
  });
  for (const auto& [key, value] : {std::pair{"reattachment", fines.reattachment}, {"pick_up", fines.pick_up}})
    if (value > 0.0 && !carriers)
      io.problem(key, "fines can come back only to carriers: give [carriers], or leave it out");
    else if (value > 0.0 && fines.scalars.size() > 1)
      io.problem(key, "with several [[fines.scalar]] carriers would regain other fines for each: keep one of them");
  if (fines.scalars.empty()) io.problem("scalar", "fines need at least one [[fines.scalar]] to travel in");
  io.list("boundary", fines.boundaries, [](Fields& f, ScalarBoundary& b) {
    f.text("patch", b.patch, required);
    f.text("scalar", b.scalar, required);
    f.number("value", b.value, unit::number_density, Range::non_negative, required);
  });
  if (!fines.boundaries.empty() && !features.fixed_values)
    io.problem("boundary", "fixed values of a scalar on a patch are not part of this version");
}

}  // namespace puffin::cases::format
