#pragma once
// Arithmetic written in a verification file: "0.5*(u^2 + v^2)/U^2".

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace puffin::cases {

/// A formula of named numbers. Operators, from loosest to tightest: == != < <= > >= (1 or 0), + -, * /, unary -, ^
/// (from the right: 2^3^2 = 512, -2^2 = -4). Functions: sqrt exp log sin cos tan sinh cosh tanh atan abs, and of two
/// arguments min max atan2. `pi` is known. Names hold letters, digits, '_' and '.', and begin with a letter.
class Formula {
 public:
  /// Throws std::invalid_argument with the column and what was expected there.
  explicit Formula(std::string_view text);

  /// The names in it, each once, in the order of their first appearance.
  const std::vector<std::string>& names() const { return names_; }
  /// values: one for each of names(). Never throws; 0/0 and the like give NaN.
  double operator()(std::span<const double> values) const;
  /// The same with the values looked up. Throws std::invalid_argument naming a name that is not known, with the
  /// nearest.
  double operator()(const std::map<std::string, double>& known) const;

  /// One instruction of a stack machine.
  struct Step {
    enum class Kind { number, name, unary, binary } kind = Kind::number;
    double number = 0.0;
    std::size_t name = 0;                     // index into names()
    double (*one)(double) = nullptr;          // unary
    double (*two)(double, double) = nullptr;  // binary
  };

 private:
  std::vector<std::string> names_;
  std::vector<Step> steps_;
};

}  // namespace puffin::cases
