#include "tools/puffin/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puffin::tools {
namespace {

using micromodels::FinesModels;
using micromodels::Law;

const double reach = std::log(calibration_reach);

std::optional<Law>& law_of(FinesModels& models, const std::string& mechanism) {
  if (mechanism == "wall_detach") return models.wall_detach;
  if (mechanism == "wall_attach") return models.wall_attach;
  if (mechanism == "particle_detach") return models.particle_detach;
  if (mechanism == "drag_detach") return models.drag_detach;
  throw std::invalid_argument("unknown mechanism '" + mechanism +
                              "'; use wall_detach, wall_attach, particle_detach or drag_detach");
}

/// The law with `key` times `factor`, or nothing if it has no such constant. `value`: afterwards.
std::optional<Law> scaled(const Law& law, const std::string& key, double factor, double& value) {
  if (const auto* power = std::get_if<micromodels::PowerLaw>(&law)) {
    auto a = power->constants();
    if (key == "scale") {
      value = factor;
      a[0] *= factor, a[3] *= factor;
    } else if (key.size() == 2 && key[0] == 'A' && key[1] >= '0' && key[1] <= '4') {
      const auto k = static_cast<std::size_t>(key[1] - '0');
      value = a[k] *= factor;
    } else {
      return {};
    }
    return micromodels::PowerLaw(a, power->valid());
  }
  const auto change = [&](const auto& old, auto members) -> std::optional<Law> {
    auto c = old.constants();
    for (const auto& [name, member] : members)
      if (key == name) {
        c.*member *= factor;
        if (key == "limit" || key == "scale") c.limit = std::min(c.limit, 1.0);
        value = c.*member;
        return Law(std::decay_t<decltype(old)>(c, old.valid()));
      }
    return {};
  };
  if (const auto* lift = std::get_if<micromodels::LiftOffLaw>(&law)) {
    using C = micromodels::LiftOffLaw::Constants;
    return change(*lift, std::map<std::string, double C::*>{{"limit", &C::limit},
                                                            {"scale", &C::limit},
                                                            {"spread", &C::spread},
                                                            {"surface_energy", &C::surface_energy}});
  }
  if (const auto* weibull = std::get_if<micromodels::WeibullLaw>(&law)) {
    using C = micromodels::WeibullLaw::Constants;
    return change(
        *weibull,
        std::map<std::string, double C::*>{
            {"limit", &C::limit}, {"scale", &C::limit}, {"energy_ratio", &C::energy_ratio}, {"shape", &C::shape}});
  }
  return {};
}

/// Models with every named constant times exp(x), within reach. `values`: those of the constants then.
FinesModels with(FinesModels models, const std::vector<std::string>& constants, const Eigen::VectorXd& x,
                 std::vector<double>* values = nullptr) {
  for (std::size_t k = 0; k < constants.size(); ++k) {
    const auto dot = constants[k].find('.');
    std::optional<Law>& law = law_of(models, constants[k].substr(0, dot));
    if (!law) throw std::invalid_argument(constants[k] + ": that mechanism does not act in the micro-model file");
    double value = 0.0;
    const std::string key = dot == std::string::npos ? "scale" : constants[k].substr(dot + 1);
    auto changed = scaled(*law, key, std::exp(std::clamp(x[static_cast<Eigen::Index>(k)], -reach, reach)), value);
    if (!changed)
      throw std::invalid_argument(constants[k] + ": a " + micromodels::name(*law) + " law has no such constant");
    if (!(value > 0.0))
      throw std::invalid_argument(constants[k] + " is 0 in the micro-model file; give it a start value");
    if (values) values->push_back(value);
    law = std::move(changed);
  }
  return models;
}

double ours(const std::vector<output::FinesSummary>& fines, const std::string& quantity) {
  if (fines.empty()) throw std::invalid_argument("a run without fines cannot be calibrated");
  const std::pair<const char*, double output::FinesSummary::*> known[] = {{"FFE", &output::FinesSummary::FFE},
                                                                          {"FFW", &output::FinesSummary::FFW},
                                                                          {"FFCR", &output::FinesSummary::FFCR},
                                                                          {"FFCE", &output::FinesSummary::FFCE}};
  for (const auto& [name, member] : known)
    if (quantity == name) return fines.front().*member;
  throw std::invalid_argument("unknown target '" + quantity + "'; use FFE, FFW, FFCR or FFCE");
}

}  // namespace

Calibration calibrate(const FinesModels& start, const std::vector<StoredRun>& runs, const std::vector<Target>& targets,
                      const std::vector<std::string>& constants) {
  if (targets.size() < constants.size() || constants.empty())
    throw std::invalid_argument(
        "a calibration needs at least one constant, and a target for each: " + std::to_string(constants.size()) +
        " constants, " + std::to_string(targets.size()) + " targets");
  const auto predict = [&](const FinesModels& models, std::vector<Target>& out) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const auto fines = summaries(coupling::replay(runs[r].record, models), runs[r].scalars);
      for (Target& t : out)
        if (t.run == r) t.ours = ours(fines, t.quantity);
    }
  };
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(constants.size()));
  with(start, constants, zero);  // refuses unknown ones before the first replay
  std::vector<Target> now = targets;
  const auto fit = micromodels::derivation::least_squares(
      [&](const Eigen::VectorXd& x, Eigen::VectorXd& r) {
        predict(with(start, constants, x), now);
        for (std::size_t k = 0; k < now.size(); ++k) r[static_cast<Eigen::Index>(k)] = now[k].ours - now[k].value;
      },
      static_cast<int>(targets.size()), zero, 1.0);  // at first by a factor e: more saturates what a law may take
  Calibration result;
  std::vector<double> values;
  result.models = with(start, constants, fit.x, &values);
  result.models.label = micromodels::Label::calibrated;
  predict(result.models, now);
  result.targets = now;
  for (std::size_t k = 0; k < constants.size(); ++k) {
    const auto e = fit.estimate(static_cast<int>(k));
    const double down = std::exp(e.low - e.value), up = std::exp(e.high - e.value);
    result.constants.push_back(
        {constants[k], {values[k], values[k] * down, values[k] * up}, std::abs(e.value) >= reach});
  }
  result.rms = std::sqrt(fit.sum_of_squares / static_cast<double>(targets.size()));
  return result;
}

}  // namespace puffin::tools
