#include "tools/puffin/verify_report.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/output/csv_file.hpp"

namespace puffin::tools {
namespace {

nlohmann::json number(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

std::string digits(double value, int count) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", count, value);
  return text;
}

}  // namespace

std::string to_json(const std::vector<VerifyRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const VerifyRow& r : rows)
    list.push_back({{"id", r.id},
                    {"suite", r.suite},
                    {"quantity", r.quantity},
                    {"reference", number(r.outcome.reference)},
                    {"value", number(r.outcome.value)},
                    {"error", number(r.outcome.error)},
                    {"tolerance", r.tolerance},
                    {"pass", r.outcome.pass},
                    {"cells", static_cast<std::int64_t>(r.cells)},
                    {"seconds", r.seconds},
                    {"source", r.source}});
  return nlohmann::json{{"cases", list}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string heading() {
  return "id    suite    reference       value     error tolerance             cells   seconds  quantity";
}

std::string to_text(const VerifyRow& r) {
  char line[160];
  std::snprintf(line, sizeof line, "%-5s %-8s %9.5g %11.5g %9.2g %9.2g %s %12.0f %9.1f  ", r.id.c_str(),
                r.suite.c_str(), r.outcome.reference, r.outcome.value, r.outcome.error, r.tolerance,
                r.outcome.pass ? "pass" : "FAIL", r.cells, r.seconds);
  return line + r.quantity;
}

std::string to_markdown(const std::vector<VerifyRow>& rows) {
  std::string text = "| id | quantity | reference | Puffin | error | tolerance | | cells | s |\n";
  text += "|---|---|---|---|---|---|---|---|---|\n";
  for (const VerifyRow& r : rows)
    text += "| " + r.id + " | " + r.quantity + " | " + digits(r.outcome.reference, 6) + " | " +
            digits(r.outcome.value, 6) + " | " + digits(r.outcome.error, 2) + " | " + digits(r.tolerance, 2) + " | " +
            (r.outcome.pass ? "pass" : "**out**") + " | " + std::to_string(static_cast<std::int64_t>(r.cells)) + " | " +
            digits(r.seconds, 2) + " |\n";
  return text;
}

void write_csv(const std::filesystem::path& file, const std::vector<VerifyRow>& rows) {
  output::CsvFile csv(file, {"id", "suite", "quantity", "reference", "value", "error", "tolerance", "pass", "cells",
                             "seconds", "source"});
  for (const VerifyRow& r : rows)
    csv.append({r.id, r.suite, r.quantity, r.outcome.reference, r.outcome.value, r.outcome.error, r.tolerance,
                std::string(r.outcome.pass ? "true" : "false"), r.cells, r.seconds, r.source});
  csv.flush();
}

}  // namespace puffin::tools
