#include "cases/format/toml_edit.hpp"
#include "cases/case_numerics.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "cases/units.hpp"

namespace puffin::cases::format {
namespace {

/// "a.b[0].c" -> a, b, 0, c.
std::vector<std::string> steps_of(std::string_view key) {
  std::vector<std::string> steps(1);
  for (const char c : key) {
    if (c == '.' || c == '[')
      steps.emplace_back();
    else if (c != ']')
      steps.back() += c;
  }
  for (const std::string& step : steps)
    if (step.empty()) throw std::invalid_argument("'" + std::string(key) + "' is no dotted key");
  return steps;
}

/// The value as TOML, or as a text if it is none. `source` is what messages call it.
toml::table parse_value(const std::string& value, const std::string& source) {
  try {
    toml::table t = toml::parse("v = " + value + "\n", source);
    if (t.size() == 1) return t;
  } catch (const toml::parse_error&) {  // no TOML value: the shell ate the quotes, and the text itself is meant
  }
  toml::table t = toml::parse("v = 0\n", source);
  toml::table holder;
  const toml::source_region where = t.get("v")->source();
  holder.insert_or_assign(toml::key("v", where), value);
  return holder;
}

toml::node* enter(toml::node& node, const std::string& step, const Override& o, const toml::source_region& where) {
  if (toml::table* table = node.as_table()) {
    if (!table->contains(step)) table->insert_or_assign(toml::key(step, where), toml::table{});
    return table->get(step);
  }
  if (toml::array* array = node.as_array()) {
    std::size_t i = 0;
    const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), i);
    if (error != std::errc() || end != step.data() + step.size() || i >= array->size())
      throw std::invalid_argument("'" + step + "' in '" + o.key + "' is no index of a list of " +
                                  std::to_string(array->size()));
    return array->get(i);
  }
  throw std::invalid_argument("'" + o.key + "': there is a value, not a table, before '" + step + "'");
}

std::optional<double> quantity(const toml::node_view<toml::node>& node, const Unit& u) try {
  if (const auto* text = node.as_string()) return parse_quantity(text->get(), u);
  return node.value<double>();
} catch (const UnitError&) {
  return std::nullopt;
}

/// Rounded to three significant digits.
double rounded(double value) {
  const double scale = std::pow(10.0, 2.0 - std::floor(std::log10(value)));
  return std::round(value * scale) / scale;
}

/// The settings of the air that the trade-off behind Preset::speeding was made with: the defaults, or more C_s.
bool runs_with_long_steps(const toml::table& root) {
  const auto numerics = root["numerics"];
  const auto usual = [&](const char* key, const char* word) {
    return numerics[key].value_or(std::string(word)) == word;
  };
  return numerics.is_table() && usual("collision", "rr3") && usual("les", "smagorinsky") && usual("wall", "bouzidi") &&
         numerics["smagorinsky_constant"].value_or(0.10) >= 0.10 && !numerics["wall_model"].value_or(false);
}

}  // namespace

void apply_override(toml::table& root, const Override& o) {
  const std::vector<std::string> steps = steps_of(o.key);
  toml::table holder = parse_value(o.value, "--set " + o.key);
  toml::node& value = *holder.get("v");
  const toml::source_region where = holder.begin()->first.source();
  toml::node* parent = &root;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) parent = enter(*parent, steps[i], o, where);
  if (toml::table* table = parent->as_table()) {
    table->erase(steps.back());
    value.visit([&](auto& v) { table->insert_or_assign(toml::key(steps.back(), where), std::move(v)); });
  } else {
    toml::node* old = enter(*parent, steps.back(), o, where);
    toml::array& array = *parent->as_array();
    const auto at = std::find_if(array.begin(), array.end(), [&](toml::node& n) { return &n == old; });
    value.visit([&](auto& v) { array.replace(at, std::move(v)); });
  }
}

/// What would begin after the end that a preset sets, takes its default: the last part of the run.
void forget_later(toml::table& root, double end) {
  toml::table* output = root["output"].as_table();
  if (output == nullptr) return;
  const auto later = [&](toml::node_view<toml::node> value) {
    const std::optional<double> begin = quantity(value, unit::time);
    return begin && *begin >= end;
  };
  if (later((*output)["pressure_window"][0])) output->erase("pressure_window");
  if (toml::array* lines = (*output)["line"].as_array())
    for (toml::node& line : *lines)
      if (toml::table* table = line.as_table(); table && later((*table)["average_from"])) table->erase("average_from");
}

void apply_preset(toml::table& root, const Preset& preset) {
  const std::string source = "--preset " + std::string(preset.name);
  const auto replace = [&](const char* table, const char* key, double value) {
    toml::table holder = parse_value(shortest(value), source);
    const toml::source_region where = holder.begin()->first.source();
    toml::table& t = *root.get(table)->as_table();
    t.erase(key);
    holder.get("v")->visit([&](auto& v) { t.insert_or_assign(toml::key(key, where), std::move(v)); });
  };
  const std::optional<double> dx = quantity(root["numerics"]["dx"], unit::length);
  const std::optional<double> cells = quantity(root["numerics"]["cells"], unit::number);
  const std::optional<double> stop = quantity(root["stop"]["time"], unit::time);
  if (preset.coarsening != 1.0) {
    if (dx && *dx > 0.0 && std::isfinite(*dx)) replace("numerics", "dx", rounded(*dx * preset.coarsening));
    if (cells && *cells > 0.0 && *cells < 9e15)
      replace("numerics", "cells", std::max(1.0, std::round(*cells / std::pow(preset.coarsening, 3))));
  }
  const std::optional<double> step = quantity(root["numerics"]["time_step"], unit::time);  // in seconds: goes with dx
  if (step && *step > 0.0 && std::isfinite(*step)) {
    const double factor = preset.coarsening * (runs_with_long_steps(root) ? preset.speeding : 1.0);
    if (factor != 1.0) replace("numerics", "time_step", *step * factor);
  }
  const auto speed_key = root["numerics"]["lattice_speed"];
  if (preset.speeding != 1.0 && runs_with_long_steps(root) && (!speed_key || speed_key.is_number())) {
    constexpr double largest = 0.15;  // with which the settings below ran in the whole map (cases/stability)
    const double speed = speed_key.value_or(default_lattice_speed);
    if (speed > 0.0) replace("numerics", "lattice_speed", std::min(preset.speeding * speed, std::max(speed, largest)));
  }
  if (stop && *stop > preset.longest_time) {
    replace("stop", "time", preset.longest_time);
    forget_later(root, preset.longest_time);
  }
}

}  // namespace puffin::cases::format
