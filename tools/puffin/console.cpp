#include "tools/puffin/console.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tools/output/output_error.hpp"

namespace puffin::tools {

void set_up_log(bool quiet) {
  const bool plain = std::getenv("NO_COLOR") != nullptr && *std::getenv("NO_COLOR") != '\0';
  spdlog::drop("puffin");
  auto logger = spdlog::stderr_color_mt("puffin", plain ? spdlog::color_mode::never : spdlog::color_mode::automatic);
  logger->set_pattern("%^%l%$: %v");
  logger->sinks().front()->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  spdlog::set_default_logger(logger);
}

void log_to_file(const std::filesystem::path& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string());
    sink->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
    const auto logger = spdlog::get("puffin");
    logger->sinks().push_back(std::move(sink));
    logger->flush_on(spdlog::level::info);
  } catch (const spdlog::spdlog_ex& e) {
    throw output::OutputError("cannot write " + file.string() + ": " + e.what());
  }
}

LogToFile::~LogToFile() { spdlog::get("puffin")->sinks().pop_back(); }

void log_info(const std::string& text) { spdlog::info("{}", text); }
void log_warning(const std::string& text) { spdlog::warn("{}", text); }
void log_error(const std::string& text) {  // the log says "error" itself
  spdlog::error("{}", text.starts_with("error: ") ? text.substr(7) : text);
}

void print(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
                       std::fputc('\n', stdout) != EOF && std::fflush(stdout) == 0;
  if (!written) throw output::OutputError(std::string("cannot write to stdout: ") + std::strerror(errno));
}

std::string four_digits(double value) { return fmt::format("{:.4g}", value); }

std::string as_length(double metres) {
  if (metres != 0.0 && std::abs(metres) < 1e-4) return four_digits(metres * 1e6) + " um";
  return std::abs(metres) < 1.0 ? four_digits(metres * 1e3) + " mm" : four_digits(metres) + " m";
}

std::string as_volume(double cubic_metres) {
  return cubic_metres < 1e-3 ? fmt::format("{:.1f} mm^3", cubic_metres * 1e9) : four_digits(cubic_metres) + " m^3";
}

std::string as_time(double seconds) {
  if (seconds != 0.0 && seconds < 1e-3) return four_digits(seconds * 1e6) + " us";
  if (seconds != 0.0 && seconds < 1.0) return four_digits(seconds * 1e3) + " ms";
  if (seconds < 120.0) return four_digits(seconds) + " s";
  return seconds < 7200.0 ? four_digits(seconds / 60.0) + " min" : four_digits(seconds / 3600.0) + " h";
}

std::string as_bytes(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

}  // namespace puffin::tools
