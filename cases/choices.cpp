#include "cases/choices.hpp"

#include <array>

namespace puffin::cases {

// The one place that says what this version can do. A new model: turn its `no` into `yes`.
namespace {
constexpr bool yes = true, no = false;

template <class Enum>
constexpr Choice word(Enum value, std::string_view name, bool offered) {
  return {static_cast<int>(value), name, offered};
}

constexpr std::array air_models{word(AirModel::none, "none", yes), word(AirModel::lbm, "lbm", yes),
                                word(AirModel::frozen, "frozen", yes)};
constexpr std::array frozen_fields{Choice{0, "uniform", yes}, Choice{1, "shear", yes}, Choice{2, "solid-body", yes},
                                   Choice{3, "file", yes}, Choice{4, "run", yes}};
constexpr std::array initial_fields{
    word(InitialField::uniform, "uniform", yes), word(InitialField::taylor_green, "taylor-green", yes),
    word(InitialField::shear_layer, "shear-layer", yes), word(InitialField::file, "file", yes)};
constexpr std::array boundary_types{word(BoundaryType::velocity_inlet, "velocity-inlet", yes),
                                    word(BoundaryType::pressure_outlet, "pressure-outlet", yes),
                                    word(BoundaryType::wall, "wall", yes),
                                    word(BoundaryType::moving_wall, "moving-wall", yes),
                                    word(BoundaryType::slip, "slip", yes),
                                    word(BoundaryType::periodic, "periodic", yes)};
constexpr std::array profiles{word(Profile::plug, "plug", yes), word(Profile::duct, "duct", yes),
                              word(Profile::parabolic, "parabolic", yes), word(Profile::pipe, "pipe", yes),
                              word(Profile::file, "file", yes)};
constexpr std::array time_steps{word(TimeStepRule::follow_ramp, "follow-ramp", yes),
                                word(TimeStepRule::fixed, "fixed", yes)};
constexpr std::array collisions{word(Collision::bgk, "bgk", yes), word(Collision::trt, "trt", yes),
                                word(Collision::rr3, "rr3", yes), word(Collision::hrr, "hrr", yes),
                                word(Collision::central_moments, "central-moments", yes)};
constexpr std::array walls{word(WallScheme::bouzidi, "bouzidi", yes), word(WallScheme::ibm, "ibm", yes),
                           word(WallScheme::psm, "psm", yes), word(WallScheme::halfway, "halfway", yes)};
constexpr std::array les_models{word(Les::none, "none", yes), word(Les::smagorinsky, "smagorinsky", yes),
                                word(Les::vreman, "vreman", yes)};
constexpr std::array precisions{word(Precision::float32, "float", yes), word(Precision::float64, "double", yes)};
constexpr std::array fill_shapes{word(FillShape::cylinder, "cylinder", yes), word(FillShape::cube, "cube", yes),
                                 word(FillShape::settled, "settled", yes), word(FillShape::file, "file", yes)};
constexpr std::array size_laws{word(SizeLaw::log_normal, "log-normal", yes),
                               word(SizeLaw::rosin_rammler, "rosin-rammler", yes), word(SizeLaw::table, "table", yes)};
constexpr std::array drags{word(Drag::none, "none", yes), word(Drag::schiller_naumann, "schiller-naumann", yes),
                           word(Drag::di_felice, "di-felice", yes), word(Drag::beetstra, "beetstra", yes)};
constexpr std::array volume_fractions{word(VolumeFraction::none, "none", yes), word(VolumeFraction::drag, "drag", yes),
                                      word(VolumeFraction::averaged, "averaged", yes)};
constexpr std::array lifts{word(Lift::none, "none", yes), word(Lift::saffman_mei, "saffman-mei", yes),
                           word(Lift::saffman_magnus, "saffman-magnus", yes)};
constexpr std::array outsides{word(Outside::remove, "remove", yes), word(Outside::bounce, "bounce", yes)};
constexpr std::array contact_models{word(ContactModel::linear, "linear", yes), word(ContactModel::hertz, "hertz", yes)};
constexpr std::array on_walls{word(OnWall::bounce, "bounce", yes), word(OnWall::stick, "stick", yes)};
constexpr std::array adhesion_models{word(AdhesionModel::none, "none", yes),
                                     word(AdhesionModel::hamaker, "hamaker", yes), word(AdhesionModel::dmt, "dmt", yes),
                                     word(AdhesionModel::jkr, "jkr", yes)};
constexpr std::array parcel_scalings{word(ParcelScaling::ddpm, "ddpm", yes), word(ParcelScaling::energy, "energy", yes),
                                     word(ParcelScaling::mass, "mass", yes)};
constexpr std::array wall_depositions{word(WallDeposition::none, "none", yes),
                                      word(WallDeposition::inertial, "inertial", no)};
constexpr std::array schemes{word(ScalarScheme::upwind, "upwind", yes), word(ScalarScheme::minmod, "minmod", yes),
                             word(ScalarScheme::van_leer, "van-leer", yes), word(ScalarScheme::mc, "mc", yes)};
constexpr std::array scalar_walls{word(ScalarWall::reflect, "reflect", yes), word(ScalarWall::absorb, "absorb", yes)};
}  // namespace

const Features features{.wall_model = yes,
                        .inlet_turbulence = yes,
                        .body_force_file = yes,
                        .velocity_friction = yes,
                        .rolling_friction = yes,
                        .fixed_values = yes};

// clang-format off
template <> std::span<const Choice> choices<AirModel>() { return air_models; }
template <> std::span<const Choice> choices<InitialField>() { return initial_fields; }
template <> std::span<const Choice> choices<BoundaryType>() { return boundary_types; }
template <> std::span<const Choice> choices<Profile>() { return profiles; }
template <> std::span<const Choice> choices<TimeStepRule>() { return time_steps; }
template <> std::span<const Choice> choices<Collision>() { return collisions; }
template <> std::span<const Choice> choices<WallScheme>() { return walls; }
template <> std::span<const Choice> choices<Les>() { return les_models; }
template <> std::span<const Choice> choices<Precision>() { return precisions; }
template <> std::span<const Choice> choices<FillShape>() { return fill_shapes; }
template <> std::span<const Choice> choices<SizeLaw>() { return size_laws; }
template <> std::span<const Choice> choices<Drag>() { return drags; }
template <> std::span<const Choice> choices<VolumeFraction>() { return volume_fractions; }
template <> std::span<const Choice> choices<Lift>() { return lifts; }
template <> std::span<const Choice> choices<Outside>() { return outsides; }
template <> std::span<const Choice> choices<ContactModel>() { return contact_models; }
template <> std::span<const Choice> choices<OnWall>() { return on_walls; }
template <> std::span<const Choice> choices<AdhesionModel>() { return adhesion_models; }
template <> std::span<const Choice> choices<ParcelScaling>() { return parcel_scalings; }
template <> std::span<const Choice> choices<WallDeposition>() { return wall_depositions; }
template <> std::span<const Choice> choices<ScalarScheme>() { return schemes; }
template <> std::span<const Choice> choices<ScalarWall>() { return scalar_walls; }
// clang-format on

std::span<const Choice> frozen_field_kinds() { return frozen_fields; }

}  // namespace puffin::cases
