#include "lbm/geometry/stl.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "lbm/geometry/stl_text.hpp"
#include "lbm/geometry/weld.hpp"

namespace puffin::lbm::geometry {

namespace {

constexpr std::size_t header_bytes = 80, start_bytes = 84, triangle_bytes = 50;

std::string read_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw StlFileError(path + ": error: no such file; check the path");
  if (!std::filesystem::is_regular_file(path, error)) throw StlFileError(path + ": error: not a regular file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw StlFileError(path + ": error: cannot be opened; check its permissions");
  std::string bytes(static_cast<std::size_t>(std::filesystem::file_size(path)), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::size_t>(in.gcount()) != bytes.size())
    throw StlFileError(path + ": error: cannot be read to its end");
  return bytes;
}

std::uint32_t load_u32(const char* p) {  // little-endian, as the format demands
  const auto* u = reinterpret_cast<const unsigned char*>(p);
  return u[0] | (static_cast<std::uint32_t>(u[1]) << 8) | (static_cast<std::uint32_t>(u[2]) << 16) |
         (static_cast<std::uint32_t>(u[3]) << 24);
}

float load_float(const char* p) {
  const std::uint32_t u = load_u32(p);
  float f;
  std::memcpy(&f, &u, 4);
  return f;
}

void store_u32(std::string& out, std::uint32_t u) {
  for (int k = 0; k < 4; ++k) out += static_cast<char>((u >> (8 * k)) & 0xFF);
}

void store_float(std::string& out, double value) {
  const auto f = static_cast<float>(value);
  std::uint32_t u;
  std::memcpy(&u, &f, 4);
  store_u32(out, u);
}

bool begins_like_text(std::string_view bytes) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  while (!bytes.empty() && std::strchr(" \t\r\n\f\v", bytes[0]) && bytes[0] != '\0') bytes.remove_prefix(1);
  auto starts = [&](std::string_view word) {
    if (bytes.size() < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
      if ((bytes[i] | 0x20) != word[i]) return false;
    }
    return true;
  };
  // Binary headers may begin with "solid" as well, but are followed by bytes that no text holds.
  return (starts("solid") || starts("facet")) && bytes.substr(0, 4096).find('\0') == std::string_view::npos;
}

// What stands where a binary file has its header and the number of its triangles.
bool is_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](unsigned char c) { return std::isprint(c) || std::isspace(c); });
}

bool has_binary_length(std::string_view bytes) {
  return bytes.size() >= start_bytes &&
         bytes.size() == start_bytes + triangle_bytes * static_cast<std::size_t>(load_u32(bytes.data() + header_bytes));
}

std::string solid_name_in_header(std::string_view header) {
  const std::string_view mark = "solid=";
  const auto at = header.find(mark);
  if (at == std::string_view::npos) return "solid";
  std::string_view name = header.substr(at + mark.size());
  name = name.substr(0, name.find('\0'));
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  return name.empty() ? "solid" : std::string(name);
}

void parse_binary(const std::string& path, std::string_view bytes, double unit, TriangleMesh& mesh) {
  if (bytes.size() < start_bytes) {
    throw StlError(path + ": error: " + std::to_string(bytes.size()) +
                   " bytes are too few for an STL file (84 at least); it is truncated or no STL");
  }
  const std::size_t claimed = load_u32(bytes.data() + header_bytes);
  const std::size_t held = (bytes.size() - start_bytes) / triangle_bytes;
  if (claimed != held && is_text(bytes.substr(0, start_bytes))) {
    throw StlError(path +
                   ": error: the file is text that does not begin with 'solid'; take out what stands before it, or it "
                   "is no STL");
  }
  if (claimed > held) {
    throw StlError(path + ": error: the header promises " + std::to_string(claimed) +
                   " triangles but the file ends in " + "triangle " + std::to_string(held + 1) +
                   "; it is truncated or no STL: export or copy it again");
  }
  if (held > claimed) {
    throw StlError(path + ": error: the header promises " + std::to_string(claimed) +
                   " triangles but the file has room " + "for " + std::to_string(held) +
                   "; it is damaged or no STL: export it again");
  }
  mesh.solids = {solid_name_in_header(bytes.substr(0, header_bytes))};
  mesh.vertices.reserve(3 * claimed);
  mesh.triangles.reserve(claimed);
  for (std::size_t t = 0; t < claimed; ++t) {
    const char* at = bytes.data() + start_bytes + t * triangle_bytes + 12;  // behind the normal
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      Vec3 p;
      for (int d = 0; d < 3; ++d) p[d] = unit * load_float(at + 12 * k + 4 * d);
      if (!p.allFinite()) {
        throw StlError(path + ": error: triangle " + std::to_string(t + 1) +
                       " has a corner that is no finite number; " + "the file is damaged: export it again");
      }
      triangle[k] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(p);
    }
    mesh.triangles.push_back(triangle);
  }
  mesh.solid.assign(claimed, 0);
}

/// The search of nearest triangles squares lengths in single precision, which ends at 1e38.
constexpr double largest_coordinate = 1e12;  // m

void refuse_the_absurd(const std::string& name, const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const double size = mesh.corner(static_cast<int>(t), k).cwiseAbs().maxCoeff();
      if (size <= largest_coordinate) continue;
      char text[64];
      std::snprintf(text, sizeof text, "%zu has a corner %.3g m from the origin", t + 1, size);
      throw StlError(name + ": error: triangle " + text +
                     "; no device is that large: the file is damaged, or its unit another one");
    }
}

}  // namespace

double weld_tolerance(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  Vec3 low = mesh.vertices[0], high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return weld_fraction * (high - low).norm();
}

TriangleMesh parse_stl(const std::string& name, std::string_view bytes, double unit) {
  if (!(unit > 0.0) || !std::isfinite(unit)) {
    throw StlError(name + ": error: the unit must be a positive number of metres, e.g. 0.001 for mm");
  }
  if (bytes.empty()) throw StlError(name + ": error: the file is empty");
  if (bytes.size() / triangle_bytes > 700'000'000) {
    throw StlError(name + ": error: more than 700 million triangles; coarsen the surface");
  }
  TriangleMesh mesh;
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    throw StlError(name + ": error: the file is text in UTF-16; save it as ASCII or UTF-8");
  if (!has_binary_length(bytes) && begins_like_text(bytes)) {
    parse_stl_text(name, bytes, unit, mesh);
  } else {
    parse_binary(name, bytes, unit, mesh);
  }
  if (mesh.triangles.empty()) throw StlError(name + ": error: the file holds no triangles; export the surface again");
  refuse_the_absurd(name, mesh);
  weld(mesh, weld_tolerance(mesh));
  return mesh;
}

TriangleMesh read_stl(const std::string& path, double unit) { return parse_stl(path, read_file(path), unit); }

void write_stl(const std::string& path, const TriangleMesh& mesh, bool binary, double unit) {
  if (!(unit > 0.0)) throw StlError(path + ": error: the unit must be a positive number of metres");
  std::string out;
  if (binary) {
    std::string header = "binary STL";
    if (mesh.solids.size() == 1) header += ", solid=" + mesh.solids[0].substr(0, 60);
    header.resize(header_bytes, '\0');
    out.reserve(start_bytes + triangle_bytes * mesh.triangles.size());
    out += header;
    store_u32(out, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 normal = mesh.area_vector(static_cast<int>(t)).stableNormalized();
      for (int d = 0; d < 3; ++d) store_float(out, normal[d]);
      for (int k = 0; k < 3; ++k) {
        for (int d = 0; d < 3; ++d) store_float(out, mesh.corner(static_cast<int>(t), k)[d] / unit);
      }
      out.append(2, '\0');
    }
  } else {
    out = format_stl_text(mesh, unit);
  }
  const std::string partial = path + ".partial";
  {
    std::ofstream file(partial, std::ios::binary | std::ios::trunc);
    file.write(out.data(), static_cast<std::streamsize>(out.size()));
    file.close();
    if (!file) {
      std::error_code ignored;
      std::filesystem::remove(partial, ignored);
      throw StlFileError(path + ": error: cannot be written; does the folder exist, and is there room on the disk?");
    }
  }
  std::error_code error;
  std::filesystem::rename(partial, path, error);
  if (error) throw StlFileError(path + ": error: cannot be replaced: " + error.message());
}

}  // namespace puffin::lbm::geometry
