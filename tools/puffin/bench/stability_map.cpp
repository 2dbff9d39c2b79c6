#include "tools/puffin/bench/stability_map.hpp"

#include <algorithm>
#include <vector>

#include "tools/output/report/svg.hpp"

namespace puffin::tools {
namespace {

namespace svg = output::svg;
using nlohmann::json;

// Told apart without colour by their letters, and by their lightness.
struct Look {
  const char* outcome;
  const char* colour;
  const char* ink;
  const char* letter;
  const char* meaning;
};
constexpr Look looks[] = {{"ok", "#cfe8d5", "#1d5c33", "", "ran to its end"},
                          {"healed", "#f6d77a", "#5c4300", "h", "ran on with smaller steps, and said so"},
                          {"diverged", "#b3362c", "#ffffff", "D", "diverged, named, exit code 5"},
                          {"refused", "#c9cdd3", "#21262d", "r", "refused before it began"}};

const Look& look_of(const std::string& outcome) {
  for (const Look& look : looks)
    if (outcome == look.outcome) return look;
  return looks[3];
}

std::vector<std::string> names(const json& rows, const char* key, const std::string& scene = {}) {
  std::vector<std::string> list;
  for (const json& row : rows) {
    if (!scene.empty() && row["scene"] != scene) continue;
    const std::string name = row[key].is_string() ? row[key].get<std::string>() : row[key].dump();
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
  }
  return list;
}

std::string field(double x, double y, double width, double height, const Look& look) {
  const double tall = height - 2.0;
  std::string out = "<rect x=\"" + svg::coordinate(x) + "\" y=\"" + svg::coordinate(y) + "\" width=\"" +
                    svg::coordinate(width - 2.0) + "\" height=\"" + svg::coordinate(tall) + "\" fill=\"" + look.colour +
                    "\"/>";
  if (*look.letter != 0)
    out += svg::text_at(x + 0.5 * width - 1.0, y + 0.5 * tall + 4.0, look.letter, "middle", look.ink);
  return out;
}

}  // namespace

std::string stability_map(const json& rows) {
  constexpr double label = 130.0, cell = 36.0, line = 17.0, gap = 26.0, head = 40.0, top = 48.0;
  constexpr int across = 3;  // panels side by side
  const std::vector<std::string> scenes = names(rows, "scene");
  std::string body;
  double y = top, x = 0.0, tallest = 0.0, widest = 0.0;
  int column = 0;
  for (const std::string& scene : scenes) {
    const auto variations = names(rows, "variation", scene), speeds = names(rows, "u_lb", scene);
    body += svg::text_at(x + 8.0, y + 12.0, scene, "start", svg::text_colour, " font-weight=\"600\"");
    for (std::size_t s = 0; s < speeds.size(); ++s)
      body += svg::text_at(x + label + (static_cast<double>(s) + 0.5) * cell, y + 30.0, speeds[s], "middle",
                           svg::soft_colour);
    for (std::size_t v = 0; v < variations.size(); ++v) {
      const double at = y + head + static_cast<double>(v) * line;
      body += svg::text_at(x + label - 6.0, at + 12.0, variations[v], "end");
      for (const json& row : rows) {
        if (row["scene"] != scene || row["variation"] != variations[v]) continue;
        const auto s = std::find(speeds.begin(), speeds.end(), row["u_lb"].dump()) - speeds.begin();
        body += field(x + label + static_cast<double>(s) * cell, at, cell, line, look_of(row["outcome"]));
      }
    }
    tallest = std::max(tallest, head + line * static_cast<double>(variations.size()) + gap);
    x += label + 4.0 * cell + gap;
    widest = std::max(widest, x);
    if (++column == across) {
      column = 0;
      x = 0.0;
      y += tallest;
      tallest = 0.0;
    }
  }
  std::string key;
  double at = 8.0;
  for (const Look& look : looks) {
    key += field(at, 22.0, cell, line, look) + svg::text_at(at + cell + 4.0, 34.0, look.meaning, "start");
    at += cell + 30.0 + 6.6 * static_cast<double>(std::string(look.meaning).size());
  }
  const std::string title =
      svg::text_at(8.0, 14.0, "What ran, by scene, setting and lattice speed of the reference", "start");
  return svg::standalone(svg::open(std::max(widest, at), y + tallest, "Map of stability") + title + key + body +
                         "</svg>");
}

}  // namespace puffin::tools
