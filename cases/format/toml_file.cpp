#include "cases/format/toml_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>

#include "cases/case_error.hpp"

namespace puffin::cases::format {
namespace {

constexpr std::uintmax_t longest_file = std::uintmax_t{64} << 20;  // [bytes]

CaseError too_long(const std::filesystem::path& file) {
  return CaseError({{file.string(), 0, 0, "", "this is no case file: longer than 64 MB"}});
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!error && std::filesystem::is_directory(status)) error = std::make_error_code(std::errc::is_a_directory);
  if (!error && (std::filesystem::is_fifo(status) || std::filesystem::is_socket(status)))  // nobody may ever write
    throw CaseError({{file.string(), 0, 0, "", "this is a pipe, which may never say anything; give a file"}});
  if (!error && std::filesystem::is_regular_file(status) && std::filesystem::file_size(file) > longest_file)
    throw too_long(file);
  std::ifstream in(file, std::ios::binary);
  if (!error && !in) error = std::make_error_code(std::errc::permission_denied);
  if (error) throw std::system_error(error, "cannot read " + file.string());
  // Not by its size alone: a pipe or a device has none, and may never end.
  std::string text;
  constexpr std::streamsize piece = std::streamsize{1} << 16;
  for (std::streamsize got = piece; got == piece;) {
    const std::size_t before = text.size();
    text.resize(before + static_cast<std::size_t>(piece));
    in.read(text.data() + before, piece);
    got = in.gcount();
    text.resize(before + static_cast<std::size_t>(got));
    if (text.size() > longest_file) throw too_long(file);
  }
  return text;
}

toml::table parse_toml(std::string_view text, const std::string& file) try {
  return toml::parse(text, std::string_view(file));
} catch (const toml::parse_error& e) {
  const toml::source_position at = e.source().begin;
  throw CaseError({{file, static_cast<int>(at.line), static_cast<int>(at.column), "",
                    "this is not TOML: " + std::string(e.description())}});
}

namespace {

bool has_any(const toml::table& root, std::span<const std::string_view> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return root.contains(key); });
}
constexpr std::string_view of_a_study[] = {"case", "sweep", "replicates", "share"};
constexpr std::string_view of_a_case[] = {"name", "geometry", "schema"};
constexpr std::string_view of_a_device[] = {"geometry", "schema", "air"};

}  // namespace

bool describes_study(const toml::table& root) { return !has_any(root, of_a_device) && has_any(root, of_a_study); }
bool describes_case(const toml::table& root) { return has_any(root, of_a_case) && !has_any(root, of_a_study); }

}  // namespace puffin::cases::format
