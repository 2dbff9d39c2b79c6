#pragma once
// JSON by lists of named fields, both directions. Only for the .cpp files that read or write JSON.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/output/format_version.hpp"
#include "tools/output/output_error.hpp"

namespace puffin::output {

using Json = nlohmann::ordered_json;

/// null for what is absent or not finite: JSON knows no NaN.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
inline Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

/// Puts a member into an object.
struct JsonWriter {
  static constexpr bool writes = true;
  Json& json;
  void operator()(const char* key, double value) const { json[key] = number(value); }
  void operator()(const char* key, const std::optional<double>& value) const { json[key] = number(value); }
  template <class T>
  void operator()(const char* key, const T& value) const {
    json[key] = value;
  }
};

/// Fills a member from an object; keeps it if the key is missing or of another kind.
struct JsonReader {
  static constexpr bool writes = false;
  const Json& json;
  template <class T>
  void operator()(const char* key, T& value) const {
    if (!json.is_object() || !json.contains(key)) return;
    const Json& item = json[key];
    if constexpr (std::is_same_v<T, std::string>) {
      if (item.is_string()) value = item.template get<std::string>();
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      if (item.is_number()) value = item.template get<double>();
    } else {
      if (item.is_number()) value = item.template get<T>();
    }
  }
};

/// A member that is an object or a list; an empty one if it is absent.
inline const Json& part(const Json& json, const char* key) {
  static const Json empty = Json::object();
  return json.is_object() && json.contains(key) ? json[key] : empty;
}

/// A list of numbers; shorter if some items are none.
inline std::vector<double> numbers(const Json& list) {
  std::vector<double> out;
  for (const auto& item : list) {
    if (item.is_number()) out.push_back(item.get<double>());
  }
  return out;
}

/// Throws OutputError if the file is missing, holds no object, or is of another format.
inline Json read_json(const std::filesystem::path& file) {
  demand_regular(file);
  std::ifstream stream(file);
  if (!stream) throw OutputError("cannot read " + file.string() + "; is this the folder of a run?");
  Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object()) throw OutputError(file.string() + " is damaged: it holds no JSON object");
  // Files from before formats had a number are of the first one.
  if (json.contains("format"))
    check_format_version(file.string(), json["format"].is_number_integer() ? json["format"].get<int>() : -1);
  return json;
}

}  // namespace puffin::output
