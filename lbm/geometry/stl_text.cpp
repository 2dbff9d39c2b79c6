#include "lbm/geometry/stl_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "lbm/geometry/stl.hpp"

namespace puffin::lbm::geometry {

namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// `word` is lower case.
bool same_word(std::string_view token, std::string_view word) {
  return token.size() == word.size() && std::equal(token.begin(), token.end(), word.begin(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
}

class Parser {
 public:
  Parser(const std::string& path, std::string_view text, double unit, TriangleMesh& mesh)
      : path_(path), text_(text), unit_(unit), mesh_(mesh) {}

  void run() {
    while (true) {
      const std::string_view word = next();
      if (word.empty()) return;
      if (same_word(word, "facet")) {
        facet();
      } else if (same_word(word, "solid")) {
        open_solid(name_in_line());
      } else if (same_word(word, "endsolid")) {
        skip_name();
        solid_ = -1;
      } else if (is_facet_word(word)) {
        fail(quoted(word) + " outside a facet; is the file damaged? Export it again");
      } else if (solid_ < 0 && mesh_.triangles.empty()) {
        fail(quoted(word) + " where 'solid' was expected; this is no STL file");
      } else {
        rest_of_line();  // comment, colour, ... between facets
      }
    }
  }

 private:
  static bool is_facet_word(std::string_view w) {
    return same_word(w, "vertex") || same_word(w, "outer") || same_word(w, "endloop") || same_word(w, "endfacet") ||
           same_word(w, "loop");
  }

  static std::string quoted(std::string_view token) {
    std::string s(token.substr(0, 40));
    for (char& c : s) {
      if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    }
    s.insert(s.begin(), '\'');
    s.push_back('\'');
    return s;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw StlError(path_ + ":" + std::to_string(line_) + ": error: " + what);
  }

  // The next word, empty at the end of the file; line_ is the line of that word.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) {
      // A line ends in LF, CR LF or (old Macintosh) CR.
      if (text_[at_] == '\n' || (text_[at_] == '\r' && text_.substr(at_ + 1, 1) != "\n")) ++line_;
      ++at_;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::string_view rest_of_line() {
    std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    std::size_t end = at_;
    while (begin < end && is_space(text_[begin])) ++begin;
    while (end > begin && is_space(text_[end - 1])) --end;
    return text_.substr(begin, end - begin);
  }

  // The name of a solid: the rest of its line, or what comes before the first facet where a file has no line breaks.
  std::string_view name_in_line() {
    std::string_view line = rest_of_line();
    const std::size_t facet = first_facet(line);
    if (facet == std::string_view::npos) return line;
    at_ = place_of(line) + facet;
    line = line.substr(0, facet);
    while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
    return line;
  }

  // Behind "endsolid": to the end of the line, or to the next solid where a file has no line breaks.
  void skip_name() {
    const std::string_view line = rest_of_line();
    const std::size_t facet = first_facet(line);
    if (facet == std::string_view::npos) return;
    std::size_t to = facet;
    for (std::size_t at = 0; at + 5 < facet; ++at)
      if ((at == 0 || is_space(line[at - 1])) && same_word(line.substr(at, 5), "solid") && is_space(line[at + 5]))
        to = at;
    at_ = place_of(line) + to;
  }

  std::size_t place_of(std::string_view part) const { return static_cast<std::size_t>(part.data() - text_.data()); }

  // Where "facet normal" stands in a line.
  static std::size_t first_facet(std::string_view line) {
    for (std::size_t at = 0; at + 12 <= line.size(); ++at) {
      if ((at > 0 && !is_space(line[at - 1])) || !same_word(line.substr(at, 5), "facet")) continue;
      const std::size_t next = std::min(line.find_first_not_of(" \t", at + 5), line.size());
      if (next > at + 5 && same_word(line.substr(next, 6), "normal")) return at;
    }
    return std::string_view::npos;
  }

  void open_solid(std::string_view name) {
    const std::string n = name.empty() ? "solid" : std::string(name);
    const auto found = std::find(mesh_.solids.begin(), mesh_.solids.end(), n);
    solid_ = static_cast<int>(found - mesh_.solids.begin());
    if (found == mesh_.solids.end()) mesh_.solids.push_back(n);
  }

  std::string_view expect_any(const char* what) {
    const std::string_view word = next();
    if (word.empty()) {
      fail(std::string("the file ends inside a facet, where ") + what +
           " was expected; it is truncated: export or copy it again");
    }
    return word;
  }

  void expect(const char* word) {
    const std::string_view got = expect_any(word);
    if (!same_word(got, word)) fail(quoted(got) + " where '" + word + "' was expected");
  }

  double number() {
    std::string_view word = expect_any("a number");
    const std::string_view whole = word;
    if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
      const auto e = word.find_first_of("eE");  // too small is zero, too large an error
      if (e != std::string_view::npos && e + 1 < word.size() && word[e + 1] == '-') return 0.0;
    }
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      fail(quoted(whole) + " is no coordinate" +
           (whole.find(',') != std::string_view::npos ? "; write decimals with a point, not a comma"
                                                      : "; a finite number was expected"));
    }
    return value * unit_;
  }

  void facet() {
    if (solid_ < 0) open_solid("");
    std::string_view word = expect_any("'outer loop'");
    while (!same_word(word, "outer")) {  // the normal: not used, often wrong
      if (is_facet_word(word) || same_word(word, "facet")) fail(quoted(word) + " where 'outer loop' was expected");
      word = expect_any("'outer loop'");
    }
    expect("loop");
    std::array<int, 3> triangle{};
    for (int& corner : triangle) {
      expect("vertex");
      Vec3 p;
      for (int d = 0; d < 3; ++d) p[d] = number();
      corner = static_cast<int>(mesh_.vertices.size());
      mesh_.vertices.push_back(p);
    }
    word = expect_any("'endloop'");
    if (same_word(word, "vertex")) fail("a facet with more than three corners; export triangles only");
    if (!same_word(word, "endloop")) fail(quoted(word) + " where 'endloop' was expected");
    expect("endfacet");
    mesh_.triangles.push_back(triangle);
    mesh_.solid.push_back(solid_);
  }

  const std::string& path_;
  std::string_view text_;
  double unit_;
  TriangleMesh& mesh_;
  std::size_t at_ = 0, line_ = 1;
  int solid_ = -1;
};

void append(std::string& out, const char* word, const Vec3& v) {
  out += word;
  for (int d = 0; d < 3; ++d) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), v[d], std::chars_format::general, 9);
    out += ' ';
    out.append(digits.data(), end.ptr);
  }
  out += '\n';
}

}  // namespace

void parse_stl_text(const std::string& path, std::string_view text, double unit, TriangleMesh& mesh) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  Parser(path, text, unit, mesh).run();
}

std::string format_stl_text(const TriangleMesh& mesh, double unit) {
  std::string out;
  out.reserve(mesh.triangles.size() * 240 + 100);
  const int solids = std::max<int>(1, static_cast<int>(mesh.solids.size()));
  std::vector<std::vector<int>> of_solid(solids);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    of_solid[t < mesh.solid.size() ? mesh.solid[t] : 0].push_back(static_cast<int>(t));
  }
  for (int s = 0; s < solids; ++s) {
    std::string name = mesh.solids.empty() ? "solid" : mesh.solids[s];
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    out += "solid " + name + '\n';
    for (const int t : of_solid[s]) {
      append(out, " facet normal", mesh.area_vector(t).stableNormalized());
      out += "  outer loop\n";
      for (int k = 0; k < 3; ++k) append(out, "   vertex", mesh.corner(t, k) / unit);
      out += "  endloop\n endfacet\n";
    }
    out += "endsolid " + name + '\n';
  }
  return out;
}

}  // namespace puffin::lbm::geometry
