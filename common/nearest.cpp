#include "common/nearest.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace spacetime {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Optimal string alignment distance; upper and lower case count as alike.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

constexpr std::size_t longest_compared = 64;  // characters; longer names are not guessed at
constexpr std::size_t most_guesses = 3;

// "'a', 'b' or 'c'"
std::string enumerated(std::span<const std::string> names, char quote) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + (quote + names[i] + quote);
  return out;
}

}  // namespace

std::vector<std::string> nearest(std::string_view wrong, std::span<const std::string> candidates) {
  std::vector<std::string> best;
  if (wrong.size() > longest_compared) return best;
  // Of those equally near, those as long as `wrong` are likelier.
  std::pair<std::size_t, bool> best_score{std::max<std::size_t>(1, wrong.size() / 3) + 1, false};
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest_compared || candidate == wrong) continue;
    const std::size_t dot = candidate.rfind('.');
    const bool tail = dot != std::string::npos && std::string_view(candidate).substr(dot + 1) == wrong;
    const std::pair score{tail ? 0 : distance(wrong, candidate), candidate.size() != wrong.size()};
    if (score.first >= std::max(wrong.size(), candidate.size())) continue;
    if (score > best_score || (score == best_score && best.empty())) continue;
    if (score < best_score) best.clear(), best_score = score;
    if (best.size() < most_guesses && std::ranges::find(best, candidate) == best.end()) best.push_back(candidate);
  }
  return best;
}

std::string suggestion(std::string_view wrong, std::span<const std::string> candidates, std::string_view otherwise,
                       char quote) {
  const auto best = nearest(wrong, candidates);
  return ": " + (best.empty() ? std::string(otherwise) : "did you mean " + enumerated(best, quote) + "?");
}

std::string one_of(std::span<const std::string> candidates) { return "it is " + enumerated(candidates, '\''); }

}  // namespace spacetime
