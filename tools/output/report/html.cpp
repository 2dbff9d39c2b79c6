#include "tools/output/report/html.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace puffin::output {
namespace {

constexpr char style[] = R"css(
:root { --ink: #21262d; --soft: #5f6873; --line: #d9dde2; --ground: #f6f7f9; --accent: #31688e; }
* { box-sizing: border-box; }
body { font: 16px/1.5 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif; color: var(--ink);
       max-width: 1060px; margin: 0 auto; padding: 32px 28px 60px; background: #fff; }
h1 { font-size: 32px; margin: 0 0 2px; } h2 { font-size: 21px; margin: 38px 0 10px; padding-top: 14px;
     border-top: 2px solid var(--line); } h3 { font-size: 16px; margin: 18px 0 6px; }
p { margin: 6px 0 10px; max-width: 80ch; } .soft, figcaption { color: var(--soft); font-size: 14px; }
.state { display: inline-block; padding: 2px 12px; border-radius: 12px; font-weight: 600; font-size: 14px;
         vertical-align: middle; margin-left: 10px; }
.finished { background: #dff2e6; color: #14663b; } .stopped { background: #fdf0d5; color: #7a5200; }
.diverged { background: #fbe0dd; color: #9b1c12; }
.alarm { border-left: 5px solid #c0392b; background: #fdf1ef; padding: 10px 16px; margin: 14px 0; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 10px; margin: 18px 0; }
.tile { background: var(--ground); border: 1px solid var(--line); border-radius: 8px; padding: 10px 14px; }
.tile b { display: block; white-space: nowrap; font-size: 20px; font-weight: 650; } .tile span { color: var(--soft); font-size: 13px; }
figure { margin: 10px 0; } figure img, figure svg { width: 100%; height: auto; display: block; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 6px 22px; }
table { border-collapse: collapse; margin: 8px 0 14px; font-size: 15px; }
th, td { padding: 4px 14px 4px 0; text-align: right; border-bottom: 1px solid var(--line); vertical-align: top; }
th:first-child, td:first-child { text-align: left; } th { color: var(--soft); font-weight: 600; font-size: 13px; }
td { font-variant-numeric: tabular-nums; } code { font-size: 14px; background: var(--ground); padding: 1px 5px; }
pre { background: var(--ground); border: 1px solid var(--line); padding: 10px 14px; overflow-x: auto; font-size: 14px; }
.left { text-align: left; } ul { margin: 6px 0; padding-left: 22px; } sup { line-height: 0; }
@media (max-width: 720px) { .pair { grid-template-columns: 1fr; } }
@media print { body { padding: 0; max-width: none; font-size: 11pt; } h2 { break-after: avoid; }
  figure, table, .tiles, .alarm { break-inside: avoid; } .tile, th, code, pre { print-color-adjust: exact; } }
)css";

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return "not a number";
  if (value == 0) return "0";
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  const std::string scientific = text;
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (exponent < -3 || exponent > 6) {
    return scientific.substr(0, e) + "&nbsp;&times;&nbsp;10<sup>" + std::to_string(exponent) + "</sup>";
  }
  std::snprintf(text, sizeof text, "%.*f", std::max(0, digits - 1 - exponent), value);
  return text;
}

std::string progress_bar(double part, const std::string& attributes) {
  char text[64];
  std::snprintf(text, sizeof text, "<progress max=\"1\" value=\"%.4f\"", std::clamp(part, 0.0, 1.0));
  return text + (attributes.empty() ? "" : " " + attributes) + "></progress>";
}

std::string significant(const std::optional<double>& value, int digits) {
  return value ? significant(*value, digits) : "<span class=soft>none</span>";
}

std::string grouped(long long value) {
  std::string digits = std::to_string(value < 0 ? -value : value);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), "&#8239;");
  return (value < 0 ? "&minus;" : "") + digits;
}

std::string percent(double part) { return significant(100 * part, 3) + "&nbsp;%"; }

std::string milliseconds(const std::optional<double>& time) {
  return time ? significant(*time * 1e3, 4) + " ms" : "<span class=soft>none</span>";
}

std::string heading(const std::string& text) { return "<h2>" + escaped(text) + "</h2>\n"; }
std::string paragraph(const std::string& text) { return "<p>" + escaped(text) + "</p>\n"; }

std::string table(const std::vector<std::string>& head, const Rows& rows) {
  std::string out = "<table>\n<tr>";
  for (const auto& cell : head) out += "<th>" + cell + "</th>";
  out += "</tr>\n";
  for (const auto& row : rows) {
    out += "<tr>";
    for (const auto& cell : row) out += "<td>" + cell + "</td>";
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string base64(const std::string& bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t block = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) {
      block = block << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) out += k <= n ? letters[block >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string figure_png(const std::string& png, const std::string& caption, const std::string& alt) {
  return "<figure><img alt=\"" + escaped(alt) + "\" src=\"data:image/png;base64," + base64(png) + "\"><figcaption>" +
         escaped(caption) + "</figcaption></figure>\n";
}

std::string figure_svg(const std::string& svg, const std::string& caption) {
  return "<figure>" + svg + "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string page(const std::string& title, const std::string& body) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title) + "</title>\n<style>" + style + "</style></head>\n<body>\n" + body + "</body></html>\n";
}

}  // namespace puffin::output
