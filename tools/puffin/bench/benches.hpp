#pragma once
// The benchmarks of `puffin bench`: each makes rows with named columns. To add one: its function here, its file beside
// this one, its line in benches().

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace puffin::tools {

struct BenchArguments {
  std::string name;
  bool quick = false, json = false;
  std::vector<double> cells;        // kernel: numbers of cells instead of the usual ones
  std::vector<double> carriers;     // dem: numbers of carriers instead of the usual ones
  std::vector<std::string> only;    // pareto: cases; stability, skip: scenes
  std::filesystem::path catalogue;  // pareto: a folder of cases instead of Puffin's own
  bool processor_time = false;      // pareto: weighed against the error instead of the run time
  int repeats = 0;                  // skip: interleaved repeats instead of the usual ones; 0: those
  std::string out;                  // folder for tables and figures; empty: none
};

/// What a benchmark found; after a signal, what was finished by then.
struct BenchRows {
  nlohmann::json rows;
  int code = 0;  // what the program ends with
};

struct Bench {
  const char* name;
  const char* what;
  /// The rows; while it works it prints a line a row unless a.json, and puts further files into a.out.
  BenchRows (*rows)(const BenchArguments& a);
};
std::span<const Bench> benches();

BenchRows bench_geometry(const BenchArguments& a);
BenchRows bench_kernel(const BenchArguments& a);
BenchRows bench_stability(const BenchArguments& a);
BenchRows bench_dem(const BenchArguments& a);
BenchRows bench_pareto(const BenchArguments& a);
BenchRows bench_skip(const BenchArguments& a);
BenchRows bench_scaling(const BenchArguments& a);

/// Writes rows as CSV: a header of the keys of the first row in alphabetical order; texts with commas in quotes.
/// Throws std::runtime_error if it cannot be written.
void write_rows(const nlohmann::json& rows, const std::string& file);

}  // namespace puffin::tools
