#pragma once
// The results of puffin verify as JSON, text, CSV and a table for the documentation.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/verification/evaluate.hpp"

namespace puffin::tools {

/// One line of the results.
struct VerifyRow {
  std::string id, suite, quantity, source;
  cases::Outcome outcome;
  double tolerance = 0.0;
  double cells = 0.0;    // of the largest run
  double seconds = 0.0;  // wall-clock of its runs
};

/// {"cases": [{"id", "suite", "quantity", "reference", "value", "error", "tolerance", "pass", "cells", "seconds",
/// "source"}]}; null where a number could not be found.
std::string to_json(const std::vector<VerifyRow>& rows);
/// A line of text, and the line above all of them.
std::string to_text(const VerifyRow& row);
std::string heading();
/// A table in Markdown.
std::string to_markdown(const std::vector<VerifyRow>& rows);
/// Throws OutputError if the file cannot be written.
void write_csv(const std::filesystem::path& file, const std::vector<VerifyRow>& rows);

}  // namespace puffin::tools
