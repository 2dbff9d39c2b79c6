#pragma once
// Where words go: results to stdout, everything else to stderr.

#include <filesystem>
#include <string>

namespace puffin::tools {

/// Colours on a terminal only, and never with NO_COLOR set. quiet: warnings and errors alone.
void set_up_log(bool quiet);

/// From now on the log also goes to this file, whatever is shown; an existing file is continued.
void log_to_file(const std::filesystem::path& file);

/// The same while it lives, for one of several runs in a process.
class LogToFile {
 public:
  explicit LogToFile(const std::filesystem::path& file) { log_to_file(file); }
  ~LogToFile();
  LogToFile(const LogToFile&) = delete;
  LogToFile& operator=(const LogToFile&) = delete;
};

void log_info(const std::string& text);
void log_warning(const std::string& text);
void log_error(const std::string& text);

/// A line on stdout.
void print(const std::string& text);

/// "2751.6 mm^3", "0.234 mm", "63.5 m/s": four digits, with the prefix that people use.
std::string as_length(double metres);
std::string as_volume(double cubic_metres);
std::string as_time(double seconds);
std::string as_bytes(double bytes);
std::string four_digits(double value);

}  // namespace puffin::tools
