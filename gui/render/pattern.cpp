#include "gui/render/pattern.h"

#include "common/diagnostic.h"

namespace spacetime::gui {

std::string Pattern::file(int number) const {
  std::string text = std::to_string(number);
  if (text.size() < static_cast<std::size_t>(digits))
    text.insert(0, static_cast<std::size_t>(digits) - text.size(), '0');
  return before + text + behind;
}

std::optional<Pattern> pattern_of(const std::string& name) {
  const auto at = name.find('%');
  if (at == std::string::npos) return std::nullopt;
  Pattern pattern{name.substr(0, at), name.substr(at + 1), 1};
  const auto is_digit = [&](std::size_t i) {
    return i < pattern.behind.size() && pattern.behind[i] >= '1' && pattern.behind[i] <= '9';
  };
  if (pattern.behind.starts_with("0") && is_digit(1)) {
    pattern.digits = pattern.behind[1] - '0';
    pattern.behind.erase(0, 2);
  }
  if (!pattern.behind.starts_with("d") || pattern.behind.find('%') != std::string::npos) {
    throw InputError("'" + name +
                     "' is no pattern for numbered files: it needs exactly one %04d, as in frames/%04d.png");
  }
  pattern.behind.erase(0, 1);
  return pattern;
}

}  // namespace spacetime::gui
