#include "optimizer/naming.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spacetime::optimizer {
namespace {

constexpr std::size_t times_listed = 4;

}  // namespace

std::string named(const std::string& name, int line) { return fmt::format("'{}' (line {})", name, line); }

std::string seconds(std::vector<double> times) {
  std::erase_if(times, [](double time) { return std::isnan(time); });
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  if (times.empty()) return "";
  if (times.size() > times_listed) {
    return fmt::format("{:.4g}, {:.4g}, ..., {:.4g} s ({} times)", times[0], times[1], times.back(), times.size());
  }
  std::vector<std::string> parts;
  for (const double time : times) parts.push_back(fmt::format("{:.4g}", time));
  return listed(parts) + " s";
}

std::string listed(const std::vector<std::string>& parts, const std::string& word) {
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) text += k + 1 < parts.size() ? ", " : " " + word + " ";
    text += parts[k];
  }
  return text;
}

}  // namespace spacetime::optimizer
