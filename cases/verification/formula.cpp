#include "cases/verification/formula.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "cases/spelling.hpp"

namespace puffin::cases {
namespace {

using Step = Formula::Step;
using Unary = double (*)(double);
using Binary = double (*)(double, double);

struct NamedUnary {
  std::string_view name;
  Unary function;
};
struct NamedBinary {
  std::string_view name;
  Binary function;
};
constexpr std::array<NamedUnary, 11> unary_functions{{{"sqrt", [](double a) { return std::sqrt(a); }},
                                                      {"exp", [](double a) { return std::exp(a); }},
                                                      {"log", [](double a) { return std::log(a); }},
                                                      {"sin", [](double a) { return std::sin(a); }},
                                                      {"cos", [](double a) { return std::cos(a); }},
                                                      {"tan", [](double a) { return std::tan(a); }},
                                                      {"sinh", [](double a) { return std::sinh(a); }},
                                                      {"cosh", [](double a) { return std::cosh(a); }},
                                                      {"tanh", [](double a) { return std::tanh(a); }},
                                                      {"atan", [](double a) { return std::atan(a); }},
                                                      {"abs", [](double a) { return std::abs(a); }}}};
constexpr std::array<NamedBinary, 3> binary_functions{{{"min", [](double a, double b) { return std::min(a, b); }},
                                                       {"max", [](double a, double b) { return std::max(a, b); }},
                                                       {"atan2", [](double a, double b) { return std::atan2(a, b); }}}};

/// Recursive descent; each function reads one level of precedence and appends its steps in postfix order.
class Parser {
 public:
  Parser(std::string_view text, std::vector<std::string>& names, std::vector<Step>& steps)
      : text_(text), names_(names), steps_(steps) {}

  void whole() {
    comparison();
    if (skip(); at_ < text_.size()) fail("an operator");
  }

 private:
  [[noreturn]] void fail(const std::string& wanted) const {
    throw std::invalid_argument("formula '" + std::string(text_) + "', column " + std::to_string(at_ + 1) +
                                ": expected " + wanted);
  }
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(std::string_view word) {
    skip();
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  void push(Unary f) { steps_.push_back({Step::Kind::unary, 0.0, 0, f, nullptr}); }
  void push(Binary f) { steps_.push_back({Step::Kind::binary, 0.0, 0, nullptr, f}); }
  void push(double number) { steps_.push_back({Step::Kind::number, number, 0, nullptr, nullptr}); }

  void comparison() {
    sum();
    constexpr std::array<NamedBinary, 6> signs{{{"==", [](double a, double b) { return a == b ? 1.0 : 0.0; }},
                                                {"!=", [](double a, double b) { return a != b ? 1.0 : 0.0; }},
                                                {"<=", [](double a, double b) { return a <= b ? 1.0 : 0.0; }},
                                                {">=", [](double a, double b) { return a >= b ? 1.0 : 0.0; }},
                                                {"<", [](double a, double b) { return a < b ? 1.0 : 0.0; }},
                                                {">", [](double a, double b) { return a > b ? 1.0 : 0.0; }}}};
    for (const NamedBinary& sign : signs)
      if (take(sign.name)) {
        sum();
        push(sign.function);
        return;
      }
  }
  void sum() {
    product();
    for (;;) {
      if (take("+")) {
        product();
        push([](double a, double b) { return a + b; });
      } else if (take("-")) {
        product();
        push([](double a, double b) { return a - b; });
      } else {
        return;
      }
    }
  }
  void product() {
    signed_power();
    for (;;) {
      if (take("*")) {
        signed_power();
        push([](double a, double b) { return a * b; });
      } else if (take("/")) {
        signed_power();
        push([](double a, double b) { return a / b; });
      } else {
        return;
      }
    }
  }
  void signed_power() {
    if (++depth_ > 200) fail("fewer brackets");
    if (take("-")) {
      signed_power();
      push([](double a) { return -a; });
    } else {
      primary();
      if (take("^")) {
        signed_power();
        push([](double a, double b) { return std::pow(a, b); });
      }
    }
    --depth_;
  }
  void primary() {
    skip();
    if (take("(")) {
      comparison();
      if (!take(")")) fail("')'");
      return;
    }
    if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) return name_or_call();
    double number = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
    if (error != std::errc()) fail("a number, a name or '('");
    at_ = static_cast<std::size_t>(end - text_.data());
    push(number);
  }
  void name_or_call() {
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_' || text_[at_] == '.'))
      ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (take("(")) return call(name, begin);
    if (name == "pi") return push(3.14159265358979323846);
    auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) found = names_.emplace(names_.end(), name);
    steps_.push_back({Step::Kind::name, 0.0, static_cast<std::size_t>(found - names_.begin()), nullptr, nullptr});
  }
  void call(std::string_view name, std::size_t begin) {
    comparison();
    for (const NamedUnary& f : unary_functions)
      if (f.name == name) {
        if (!take(")")) fail("')' after the argument of " + std::string(name));
        return push(f.function);
      }
    for (const NamedBinary& f : binary_functions)
      if (f.name == name) {
        if (!take(",")) fail("',' and a second argument of " + std::string(name));
        comparison();
        if (!take(")")) fail("')'");
        return push(f.function);
      }
    at_ = begin;
    fail("a function (sqrt exp log sin cos tan sinh cosh tanh atan abs min max atan2)");
  }

  std::string_view text_;
  std::vector<std::string>& names_;
  std::vector<Step>& steps_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Formula::Formula(std::string_view text) { Parser(text, names_, steps_).whole(); }

double Formula::operator()(std::span<const double> values) const {
  // No formula of the catalogue nests deeply; the parser's bound of 200 levels needs at most 3 places a level.
  std::array<double, 1024> stack;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  std::size_t top = 0;
  for (const Step& s : steps_) switch (s.kind) {
      case Step::Kind::number:
        stack[top++] = s.number;
        break;
      case Step::Kind::name:
        stack[top++] = values[s.name];
        break;
      case Step::Kind::unary:
        stack[top - 1] = s.one(stack[top - 1]);
        break;
      case Step::Kind::binary:
        --top;
        stack[top - 1] = s.two(stack[top - 1], stack[top]);
        break;
    }
  return stack[0];
}

double Formula::operator()(const std::map<std::string, double>& known) const {
  std::vector<double> values;
  for (const std::string& name : names_) {
    const auto found = known.find(name);
    if (found == known.end()) {
      std::vector<std::string> all;
      all.reserve(known.size());
      for (const auto& [k, v] : known) all.push_back(k);
      throw std::invalid_argument("'" + name + "' is not known" + did_you_mean(name, all));
    }
    values.push_back(found->second);
  }
  return (*this)(values);
}

}  // namespace puffin::cases
