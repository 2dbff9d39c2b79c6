#include <array>

#include "cases/format/phrases.hpp"
#include "cases/format/schema.hpp"

namespace puffin::cases::format {
namespace {

void refuse(Fields& io, std::string_view key, const std::string& what) {
  io.problem(key, what + " is not part of this version");
}

/// Only where it points is used, so it must point somewhere.
void describe_direction(Fields& io, const char* key, Vec3& v) {
  io.vector(key, v, unit::number, required);
  if (io.reading() && v.isZero(0.0)) io.problem(key, "points nowhere: give a vector other than zero");
}

/// field = "uniform" | "shear" | "solid-body" with sibling keys, or a table { file } or { run, at }.
void describe_frozen(Fields& io, FrozenField& field) {
  int kind = static_cast<int>(field.index());
  if (io.shape("field", kind < 3 ? Shape::text : Shape::table) == Shape::table) {
    io.section("field", [&](Fields& f) {
      const bool from_run = f.has("run", kind == 4);
      kind = from_run ? 4 : 3;
      if (io.reading() && from_run) field.emplace<RunField>();
      if (io.reading() && !from_run) field.emplace<FieldFile>();
      if (auto* run = std::get_if<RunField>(&field)) {
        static const std::array<std::string, 1> here{"."};  // runs are written below the folder one works in
        f.file("run", run->run, here);
        f.number("at", run->at, unit::time, Range::non_negative, required);
      } else {
        f.file("file", std::get<FieldFile>(field).file, {});
      }
    });
    if (!frozen_field_kinds()[kind].offered)
      refuse(io, "field", "a frozen field from a " + std::string(frozen_field_kinds()[kind].name));
    return;
  }
  kind = io.pick("field", frozen_field_kinds().first(3), kind, required);
  if (io.reading()) field = std::array<FrozenField, 3>{UniformField{}, ShearField{}, SolidBodyField{}}[kind];
  if (auto* u = std::get_if<UniformField>(&field)) {
    io.vector("velocity", u->velocity, unit::velocity, required);
  } else if (auto* shear = std::get_if<ShearField>(&field)) {
    io.vector("velocity", shear->velocity, unit::velocity, otherwise(Vec3(0, 0, 0)));
    io.number("gradient", shear->gradient, unit::rate, Range::any, required);
    describe_direction(io, "direction", shear->direction);
    describe_direction(io, "normal", shear->normal);
  } else if (auto* body = std::get_if<SolidBodyField>(&field)) {
    describe_direction(io, "axis", body->axis);
    io.vector("center", body->center, unit::length, otherwise(Vec3(0, 0, 0)));
    io.number("omega", body->omega, unit::angular_velocity, Range::any, required);
  }
}

void describe_body_force(Fields& io, Air& a) {
  if (io.shape("body_force", std::holds_alternative<ForceFile>(a.body_force) ? Shape::table : Shape::array) ==
      Shape::table) {
    if (io.reading()) a.body_force = ForceFile{};
    io.section("body_force", [&](Fields& f) { f.file("file", std::get<ForceFile>(a.body_force).file, {}); });
    if (!features.body_force_file) refuse(io, "body_force", "a body force from a file");
  } else {
    io.vector("body_force", std::get<Vec3>(a.body_force), unit::force_density, otherwise(Vec3(0, 0, 0)));
  }
}

void describe_initial(Fields& io, Air& a) {
  if (io.shape("initial", a.initial == InitialField::file ? Shape::table : Shape::text) == Shape::table) {
    a.initial = InitialField::file;
    io.section("initial", [&](Fields& f) { f.file("file", a.initial_file, {}); });
    if (!choices<InitialField>()[static_cast<int>(InitialField::file)].offered)
      refuse(io, "initial", "an initial field from a file");
  } else {
    io.choice("initial", a.initial, otherwise(InitialField::uniform));
    if (io.reading() && a.initial == InitialField::file)
      io.problem("initial", "name the file: initial = { file = \"field.csv\" }");
  }
  io.vector("initial_velocity", a.initial_velocity, unit::velocity, otherwise(Vec3(0, 0, 0)));
}

void describe_profile(Fields& io, Boundary& b) {
  if (io.shape("profile", b.profile == Profile::file ? Shape::table : Shape::text) == Shape::table) {
    b.profile = Profile::file;
    io.section("profile", [&](Fields& f) { f.file("file", b.profile_file, {}); });
    if (!choices<Profile>()[static_cast<int>(Profile::file)].offered) refuse(io, "profile", "a profile from a file");
  } else {
    io.choice("profile", b.profile, otherwise(Profile::plug));
    if (io.reading() && b.profile == Profile::file)
      io.problem("profile", "name the file: profile = { file = \"profile.csv\" }");
  }
}

void describe_inlet_flow(Fields& io, Boundary& b) {
  const bool rate = io.has("flow_rate", std::holds_alternative<FlowRate>(b.flow));
  const bool speed =
      io.has("velocity", std::holds_alternative<MeanSpeed>(b.flow) || std::holds_alternative<Velocity>(b.flow));
  if (rate && speed) io.problem("velocity", "give either 'flow_rate' or 'velocity', not both");
  if (rate) {
    if (io.reading()) b.flow = FlowRate{};
    io.time_table("flow_rate", std::get<FlowRate>(b.flow).table, unit::flow_rate);
  } else if (speed) {
    const Shape held = std::holds_alternative<Velocity>(b.flow) ? Shape::array : Shape::number;
    const bool vector = io.shape("velocity", held) == Shape::array;
    if (io.reading()) b.flow = vector ? BoundaryFlow(Velocity{}) : BoundaryFlow(MeanSpeed{});
    if (vector)
      io.vector("velocity", std::get<Velocity>(b.flow).value, unit::velocity, required);
    else
      io.number("velocity", std::get<MeanSpeed>(b.flow).value, unit::velocity, Range::any, required);
  } else if (b.profile != Profile::file) {
    io.problem("flow_rate", "a velocity-inlet needs 'flow_rate' or 'velocity'");
  }
}

void describe(Fields& io, Boundary& b) {
  io.text("patch", b.patch, required);
  io.choice<BoundaryType>("type", b.type, required);
  switch (b.type) {
    case BoundaryType::velocity_inlet:
      describe_profile(io, b);
      describe_inlet_flow(io, b);
      io.number("turbulence", b.turbulence, unit::number, Range::non_negative, otherwise(0.0));
      if (b.turbulence > 0.0 && !features.inlet_turbulence) refuse(io, "turbulence", "a turbulent inlet");
      break;
    case BoundaryType::pressure_outlet:
      io.number("pressure", b.pressure, unit::pressure, Range::any, otherwise(0.0));
      break;
    case BoundaryType::moving_wall:
      if (io.reading()) b.flow = Velocity{};
      io.vector("velocity", std::get<Velocity>(b.flow).value, unit::velocity, required);
      break;
    case BoundaryType::periodic:
      io.text("with", b.with, required);
      break;
    case BoundaryType::wall:
    case BoundaryType::slip:
      break;
  }
}

}  // namespace

void describe(Fields& io, Air& a) {
  io.choice("model", a.model, otherwise(AirModel::lbm));
  if (a.model == AirModel::frozen) describe_frozen(io, a.frozen);
  io.number("density", a.density, unit::density, Range::positive, otherwise(1.204));
  io.number("viscosity", a.viscosity, unit::viscosity, Range::non_negative, otherwise(1.82e-5));
  describe_body_force(io, a);
  describe_initial(io, a);
  io.list("boundary", a.boundaries, [](Fields& f, Boundary& b) { describe(f, b); });
}

void describe(Fields& io, Numerics& n, AirModel air) {
  const bool dx = io.has("dx", n.dx.has_value());
  const bool cells = io.has("cells", n.cells.has_value());
  if (dx && cells) io.problem("cells", "give either 'dx' or 'cells', not both");
  if (dx) {
    double value = n.dx.value_or(0.0);
    io.number("dx", value, unit::length, Range::positive, required);
    n.dx = value;
  } else if (cells) {
    std::int64_t value = n.cells.value_or(0);
    io.integer("cells", value, Range::positive, required);
    n.cells = value;
  } else if (air == AirModel::lbm) {
    io.problem("dx", "give the cell size 'dx' or the number of 'cells'");
  }
  io.number("lattice_speed", n.lattice_speed, unit::number, Range::positive, otherwise(default_lattice_speed));
  if (io.word("reference_speed", {"auto"}, n.reference_speed ? -1 : 0, 0) < 0) {
    double value = n.reference_speed.value_or(0.0);
    io.number("reference_speed", value, unit::velocity, Range::positive, required);
    n.reference_speed = value;
  }
  const int held = n.time_step == TimeStepRule::given ? -1 : static_cast<int>(n.time_step);
  if (const int rule = io.word("time_step", {"follow-ramp", "fixed"}, held, 0); rule >= 0) {
    n.time_step = static_cast<TimeStepRule>(rule);
  } else {
    n.time_step = TimeStepRule::given;
    io.number("time_step", n.time_step_seconds, unit::time, Range::positive, required);
  }
  io.choice("collision", n.collision, otherwise(Collision::rr3));
  io.number("hrr_sigma", n.hrr_sigma, unit::number, Range::non_negative, otherwise(0.98));
  io.choice("wall", n.wall, otherwise(WallScheme::bouzidi));
  io.choice("les", n.les, otherwise(Les::smagorinsky));
  io.number("smagorinsky_constant", n.smagorinsky_constant, unit::number, Range::non_negative, otherwise(0.10));
  io.flag("wall_model", n.wall_model, otherwise(false));
  if (n.wall_model && !features.wall_model) refuse(io, "wall_model", "a wall model");
  if (n.wall_model && (n.wall == WallScheme::ibm || n.wall == WallScheme::psm))
    io.problem("wall_model", "the wall model acts on cut links: take wall = \"bouzidi\" or \"halfway\" with it");
  io.choice("precision", n.precision, otherwise(Precision::float32));
  std::int64_t interval = n.coupling_interval;
  io.integer("coupling_interval", interval, Range::positive, otherwise<std::int64_t>(5));
  if (interval > 64) io.problem("coupling_interval", "at most 64 air steps between two exchanges");
  n.coupling_interval = static_cast<int>(interval);
  io.number("scalar_cfl", n.scalar_cfl, unit::number, Range::positive, otherwise(0.8));
  if (!(n.scalar_cfl < 1.0)) io.problem("scalar_cfl", "a step of the transport takes less than a cell's air: below 1");
  io.section("skip", [&](Fields& f) {
    f.flag("sleeping_carriers", n.skip.sleeping_carriers, otherwise(true));
    f.flag("free_flight", n.skip.free_flight, otherwise(true));
    f.flag("resting_exchange", n.skip.resting_exchange, otherwise(true));
    f.flag("idle_transport", n.skip.idle_transport, otherwise(true));
    f.flag("empty_cells", n.skip.empty_cells, otherwise(true));
    f.flag("transport_steps", n.skip.transport_steps, otherwise(true));
  });
  std::int64_t threads = n.threads;
  io.integer("threads", threads, Range::non_negative, otherwise<std::int64_t>(0));
  if (threads > 4096) io.problem("threads", "at most 4096 threads");
  n.threads = static_cast<int>(threads);
  std::int64_t seed = static_cast<std::int64_t>(n.seed);
  io.integer("seed", seed, Range::non_negative, otherwise<std::int64_t>(1));
  n.seed = static_cast<std::uint64_t>(seed);
}

}  // namespace puffin::cases::format
