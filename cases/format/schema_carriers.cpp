#include <cmath>
#include <numbers>

#include "cases/derived.hpp"
#include "cases/format/schema.hpp"
#include "cases/size_distribution.hpp"

namespace puffin::cases::format {
namespace {

constexpr const char* as_carriers = "as between carriers";
constexpr double fastest = 1000.0;  // [m/s]

/// The default of a key, or, for the tables of [carriers.walls], the carriers' own value.
template <class T>
Fallback<T> or_as(const T* base, T value) {
  return base ? derived(*base, as_carriers) : otherwise(value);
}

void describe_friction(Fields& io, Friction& friction, const Friction* base) {
  const Shape held = std::holds_alternative<double>(friction) ? Shape::number : Shape::table;
  Shape shape = io.shape("friction", held);
  if (shape == Shape::absent && base) {
    friction = *base;
    shape = std::holds_alternative<double>(friction) ? Shape::number : Shape::table;
  }
  if (shape != Shape::table) {
    if (io.reading() && !std::holds_alternative<double>(friction)) friction = 0.0;
    const double* number = base ? std::get_if<double>(base) : nullptr;
    io.number("friction", std::get<double>(friction), unit::number, Range::non_negative, or_as(number, 0.3));
    return;
  }
  VelocityFriction standard;
  const VelocityFriction* b = base ? std::get_if<VelocityFriction>(base) : nullptr;
  if (io.reading() && !std::holds_alternative<VelocityFriction>(friction)) friction = standard;
  auto& f = std::get<VelocityFriction>(friction);
  const auto fallback = [&](double VelocityFriction::*member) -> Fallback<double> {
    return b ? derived(b->*member, as_carriers) : Fallback<double>{};
  };
  io.section("friction", [&](Fields& t) {
    std::string law = "velocity";
    t.text("law", law, b ? derived<std::string>("velocity", as_carriers) : Fallback<std::string>{});
    if (law != "velocity") t.problem("law", "the only law is \"velocity\"; a constant is written friction = 0.3");
    t.number("stick", f.stick, unit::number, Range::non_negative, fallback(&VelocityFriction::stick));
    t.number("slip", f.slip, unit::number, Range::non_negative, fallback(&VelocityFriction::slip));
    t.number("slip_speed", f.slip_speed, unit::velocity, Range::positive, fallback(&VelocityFriction::slip_speed));
    t.number("limit", f.limit, unit::number, Range::non_negative, fallback(&VelocityFriction::limit));
    t.number("limit_speed", f.limit_speed, unit::velocity, Range::positive, fallback(&VelocityFriction::limit_speed));
    const bool said = b && b->limit_speed <= b->slip_speed;  // of the carriers, whose values these are
    if (f.limit_speed <= f.slip_speed && f.limit_speed > 0.0 && !said)
      t.problem("limit_speed", "must be above slip_speed: friction falls from 'slip' to 'limit' between the two");
  });
  if (!features.velocity_friction) io.problem("friction", "velocity-dependent friction is not part of this version");
}

void describe_contact(Fields& io, Contact& c, const Contact* base) {
  io.choice("model", c.model, or_as(base ? &base->model : nullptr, ContactModel::linear));
  if (!io.has("stiffness", true) && base && base->stiffness) {
    c.stiffness = *base->stiffness;
    io.number("stiffness", *c.stiffness, unit::stiffness, Range::positive, derived(*base->stiffness, as_carriers));
  } else if (io.word("stiffness", {"auto"}, c.stiffness ? -1 : 0, 0) < 0) {
    double value = c.stiffness.value_or(0.0);
    io.number("stiffness", value, unit::stiffness, Range::positive, required);
    c.stiffness = value;
  }
  io.number("max_overlap", c.max_overlap, unit::number, Range::positive,
            or_as(base ? &base->max_overlap : nullptr, 0.02));
  io.number("restitution", c.restitution, unit::number, Range::fraction,
            or_as(base ? &base->restitution : nullptr, 0.6));
  describe_friction(io, c.friction, base ? &base->friction : nullptr);
  io.number("rolling_friction", c.rolling_friction, unit::number, Range::non_negative,
            or_as(base ? &base->rolling_friction : nullptr, 0.0));
  if (c.rolling_friction > 0.0 && !features.rolling_friction)
    io.problem("rolling_friction", "rolling friction is not part of this version; give 0");
  const bool hertz = c.model == ContactModel::hertz;
  const auto elastic = [&](double Contact::*member) -> Fallback<double> {
    return base && base->*member > 0.0 ? derived(base->*member, as_carriers) : Fallback<double>{};
  };
  const auto inherits = [&](double Contact::*member) { return base && base->*member > 0.0; };
  if (hertz || inherits(&Contact::youngs_modulus) || io.has("youngs_modulus", c.youngs_modulus != 0.0))
    io.number("youngs_modulus", c.youngs_modulus, unit::pressure, Range::positive, elastic(&Contact::youngs_modulus));
  if (hertz || inherits(&Contact::poisson) || io.has("poisson", c.poisson != 0.0))
    io.number("poisson", c.poisson, unit::number, Range::fraction, elastic(&Contact::poisson));
  if (c.poisson > 0.5) io.problem("poisson", "must be at most 0.5, the value of a body that keeps its volume");
  io.choice("on_wall", c.on_wall, or_as(base ? &base->on_wall : nullptr, OnWall::bounce));
}

/// One value, or { median, sigma }: log-normal over the carriers.
void describe_surface_energy(Fields& io, Adhesion& a, Fallback<double> gamma, double base_sigma) {
  const Shape shape = io.shape("surface_energy", a.sigma > 0.0 ? Shape::table : Shape::number);
  const bool inherited = shape == Shape::absent && base_sigma > 0.0;  // a distribution, with the origin of both numbers
  if (shape != Shape::table && !inherited) {
    io.number("surface_energy", a.surface_energy, unit::surface_energy, Range::non_negative, gamma);
    if (io.reading()) a.sigma = 0.0;
    return;
  }
  Fallback<double> sigma;
  if (inherited) sigma = derived(base_sigma, as_carriers);
  io.section("surface_energy", [&](Fields& t) {
    t.number("median", a.surface_energy, unit::surface_energy, Range::positive, gamma);
    t.number("sigma", a.sigma, unit::number, Range::non_negative, sigma);
    if (a.sigma > 3.0) t.problem("sigma", "is the deviation of ln(surface_energy); at most 3, e.g. 0.5");
  });
}

void describe_adhesion(Fields& io, Adhesion& a, const Adhesion* base) {
  io.choice("model", a.model, or_as(base ? &base->model : nullptr, AdhesionModel::none));
  io.number("cutoff_gap", a.cutoff_gap, unit::length, Range::positive,
            or_as(base ? &base->cutoff_gap : nullptr, 0.4e-9));
  io.choice("parcel_scaling", a.parcel_scaling, or_as(base ? &base->parcel_scaling : nullptr, ParcelScaling::ddpm));
  const bool needed = a.model != AdhesionModel::none;
  const bool energy = io.has("surface_energy", needed || a.surface_energy != 0.0);
  const bool hamaker = io.has("hamaker", needed || a.hamaker != 0.0);
  const double factor = 24.0 * std::numbers::pi * a.cutoff_gap * a.cutoff_gap;  // H = factor gamma
  const bool from_base = base && !energy && !hamaker && base->surface_energy > 0.0;
  if (!energy && !hamaker && !from_base) {
    if (needed && !(base && base->model == a.model))  // what the walls inherit is reported where it is missing
      io.problem("surface_energy", "adhesion needs 'surface_energy' or 'hamaker'");
    return;
  }
  Fallback<double> gamma, h;
  if (from_base) gamma = derived(base->surface_energy, as_carriers);
  if (hamaker && !energy) {
    io.number("hamaker", a.hamaker, unit::energy, Range::non_negative, required);
    gamma = derived(a.hamaker / factor, "H / (24 pi d0^2)");
    io.number("surface_energy", a.surface_energy, unit::surface_energy, Range::non_negative, gamma);
  } else {
    describe_surface_energy(io, a, gamma, from_base ? base->sigma : 0.0);
    h = derived(factor * a.surface_energy, "24 pi gamma d0^2");
    if (from_base && base->cutoff_gap == a.cutoff_gap) h = derived(base->hamaker, as_carriers);
    io.number("hamaker", a.hamaker, unit::energy, Range::non_negative, h);
  }
}

void describe_fill(Fields& io, Fill& fill) {
  io.choice<FillShape>("shape", fill.shape, required);
  if (fill.shape == FillShape::file) {
    io.file("file", fill.file, {});
    return;
  }
  if (io.shape("at", std::holds_alternative<Vec3>(fill.at) ? Shape::array : Shape::text) == Shape::array) {
    if (io.reading()) fill.at = Vec3(Vec3::Zero());
    io.vector("at", std::get<Vec3>(fill.at), unit::length, required);
  } else {
    io.text("at", std::get<std::string>(fill.at), required);
  }
  if (fill.shape == FillShape::settled && io.has("bulk_density", fill.bulk_density.has_value())) {
    double value = fill.bulk_density.value_or(0.0);
    io.number("bulk_density", value, unit::density, Range::positive, required);
    fill.bulk_density = value;
  }
  io.number("gap", fill.gap, unit::number, Range::non_negative, otherwise(0.2));
  io.number("jitter", fill.jitter, unit::number, Range::fraction, otherwise(0.01));
  if (io.has("extent_of", fill.extent_of.has_value())) {
    std::vector<double> extent;
    if (fill.extent_of) extent = {double((*fill.extent_of)[0]), double((*fill.extent_of)[1])};
    io.numbers("extent_of", extent, 2, unit::number, required);
    if (extent.size() == 2) {
      for (const double n : extent)
        if (!(n >= 1.0 && n <= 1e9 && n == std::floor(n)))
          return io.problem("extent_of", "give [count, parcel], two whole numbers of at least 1");
      fill.extent_of = {static_cast<std::int64_t>(extent[0]), static_cast<std::int64_t>(extent[1])};
    }
  }
}

void describe_list(Fields& io, Carriers& c) {
  const auto common = [](double value, const char* what) -> Fallback<double> {
    return value > 0.0 ? derived(value, what) : Fallback<double>{};
  };
  io.list("list", c.list, [&](Fields& f, ListedCarrier& p) {
    f.vector("position", p.position, unit::length, required);
    f.vector("velocity", p.velocity, unit::velocity, otherwise(Vec3(0, 0, 0)));
    if (!(p.velocity.norm() <= fastest))
      f.problem("velocity",
                "is faster than " + format_quantity(fastest, unit::velocity) + ", which no carrier in air is");
    f.vector("spin", p.spin, unit::angular_velocity, otherwise(Vec3(0, 0, 0)));
    f.number("diameter", p.diameter, unit::length, Range::positive, common(c.diameter, "carriers.diameter"));
    f.number("density", p.density, unit::density, Range::positive, common(c.density, "carriers.density"));
  });
}

/// The diameter that stands for all.
void resolve_diameter(Fields& io, Carriers& c) {
  const SizeDistribution& d = *c.sizes;
  if (d.law == SizeLaw::log_normal && !(d.median > 0.0)) return;  // reported already
  if (d.law == SizeLaw::rosin_rammler && !(d.scale > 0.0 && d.exponent > 0.0)) return;
  if (d.law == SizeLaw::table && d.file.empty()) return;
  try {
    c.diameter = mean_volume_diameter(size_table(d));
  } catch (const std::exception& e) {
    io.problem("diameter", e.what());
  }
}

/// One value, or a table { law, ... }.
void describe_diameter(Fields& io, Carriers& c) {
  if (io.shape("diameter", c.sizes ? Shape::table : Shape::number) != Shape::table)
    return io.number("diameter", c.diameter, unit::length, Range::positive, required);
  if (io.reading()) c.sizes.emplace();
  SizeDistribution& d = *c.sizes;
  io.section("diameter", [&](Fields& t) {
    t.choice<SizeLaw>("law", d.law, required);
    if (d.law == SizeLaw::log_normal) {
      t.number("median", d.median, unit::length, Range::positive, required);
      t.number("sigma", d.sigma, unit::number, Range::non_negative, required);
      if (d.sigma > 1.0)
        t.problem("sigma",
                  "is the deviation of ln(diameter); at most 1, where one carrier in forty is 7 times the median");
    } else if (d.law == SizeLaw::rosin_rammler) {
      t.number("scale", d.scale, unit::length, Range::positive, required);
      t.number("exponent", d.exponent, unit::number, Range::positive, required);
    } else {
      t.file("file", d.file, {});
    }
    const int by = t.word("by", {"volume", "number"}, d.by_volume ? 0 : 1, 0);
    if (by < 0) t.problem("by", "must be \"volume\" or \"number\": what the shares are shares of");
    d.by_volume = by != 1;
    if (t.has("smallest", d.smallest > 0.0)) t.number("smallest", d.smallest, unit::length, Range::positive, required);
    if (t.has("largest", d.largest > 0.0)) t.number("largest", d.largest, unit::length, Range::positive, required);
    if (d.largest > 0.0 && d.smallest > d.largest) t.problem("largest", "must not be below 'smallest'");
  });
  if (io.reading()) resolve_diameter(io, c);
}

void describe_source(Fields& io, Carriers& c) {
  const bool listed = io.has("list", !c.list.empty());
  if (!listed || io.has("diameter", c.diameter > 0.0 || c.sizes)) describe_diameter(io, c);
  if (!listed || io.has("density", c.density > 0.0))
    io.number("density", c.density, unit::density, Range::positive, required);
  std::int64_t parcel = c.parcel;
  io.integer("parcel", parcel, Range::positive, otherwise<std::int64_t>(1));
  if (parcel > 1'000'000) io.problem("parcel", "at most a million carriers a parcel"), parcel = 1;
  c.parcel = static_cast<int>(parcel);
  const bool fill = io.has("fill", c.fill.has_value());
  if (listed && c.sizes) io.problem("diameter", "a list gives each carrier its own diameter");
  if (listed && fill) io.problem("fill", "give either 'fill' or 'list', not both");
  if (!listed && !fill) io.problem("fill", "say where the carriers start: 'fill' or 'list'");
  if (fill) {
    if (io.reading()) c.fill.emplace();
    io.section("fill", [&](Fields& f) { describe_fill(f, *c.fill); });
  }
  if (listed) describe_list(io, c);
  const std::int64_t in_list = static_cast<std::int64_t>(c.list.size()) * c.parcel;
  io.integer("count", c.count, Range::positive,
             listed ? derived(in_list, "the list's length times parcel") : Fallback<std::int64_t>{});
  if (listed && c.count != in_list) io.problem("count", "the list holds " + std::to_string(in_list) + " carriers");
}

}  // namespace

void describe(Fields& io, Carriers& c) {
  describe_source(io, c);
  io.number("fines_each", c.fines_each, unit::number, Range::non_negative, otherwise(0.0));
  if (c.fines_each > 1e12) io.problem("fines_each", "at most 10^12 fines a carrier"), c.fines_each = 0.0;
  io.number("fine_mass_ratio", c.fine_mass_ratio, unit::number, Range::positive, otherwise(2e-5));
  io.vector("gravity", c.gravity, unit::acceleration, otherwise(Vec3(0, 0, -9.81)));
  io.choice("drag", c.drag, otherwise(Drag::schiller_naumann));
  io.choice("volume_fraction", c.volume_fraction, otherwise(VolumeFraction::drag));
  io.choice("lift", c.lift, otherwise(Lift::none));
  io.flag("pressure_gradient", c.pressure_gradient, otherwise(false));
  io.flag("near_wall", c.near_wall, otherwise(false));
  io.flag("rotation", c.rotation, otherwise(true));
  io.flag("two_way", c.two_way, otherwise(true));
  io.number("start", c.start, unit::time, Range::non_negative, otherwise(0.0));
  io.choice("outside", c.outside, otherwise(Outside::remove));
  io.section("contact", [&](Fields& f) { describe_contact(f, c.contact, nullptr); });
  io.section("adhesion", [&](Fields& f) { describe_adhesion(f, c.adhesion, nullptr); });
  io.section("walls", [&](Fields& walls) {
    walls.section("contact", [&](Fields& f) { describe_contact(f, c.wall_contact, &c.contact); });
    walls.section("adhesion", [&](Fields& f) { describe_adhesion(f, c.wall_adhesion, &c.adhesion); });
  });
}

}  // namespace puffin::cases::format
