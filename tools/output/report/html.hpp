#pragma once
// Pieces of a page: escaped text, numbers for people, tables, embedded pictures.

#include <optional>
#include <string>
#include <vector>

namespace puffin::output {

/// &, <, > and quotes made harmless.
std::string escaped(const std::string& text);
/// A bar that is filled to `part` of 1; `attributes` of its own, like style="width:100%".
std::string progress_bar(double part, const std::string& attributes = "");

/// A number with so many significant digits; powers of ten as "1.2 x 10<sup>-9</sup>" where plain digits would be long.
std::string significant(double value, int digits = 3);
/// "not given" for an absent number.
std::string significant(const std::optional<double>& value, int digits = 3);
/// Whole numbers with thin spaces between the thousands.
std::string grouped(long long value);
/// A part of 1 as "12.3&nbsp;%".
std::string percent(double part);
/// A time [s] as "12.3 ms", or that there is none.
std::string milliseconds(const std::optional<double>& time);
std::string heading(const std::string& text);    // of a section
std::string paragraph(const std::string& text);  // plain text
using Rows = std::vector<std::vector<std::string>>;
/// Cells are HTML; the first column is text, the others are set flush right.
std::string table(const std::vector<std::string>& head, const Rows& rows);
std::string base64(const std::string& bytes);
/// A figure with an embedded PNG; `alt`: what it shows, for those who cannot see it.
std::string figure_png(const std::string& png, const std::string& caption, const std::string& alt);
std::string figure_svg(const std::string& svg, const std::string& caption);
/// The frame of a page: head, style, body. Nothing is loaded from anywhere.
std::string page(const std::string& title, const std::string& body);

}  // namespace puffin::output
