#include "symbolic/nearest.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "symbolic/quoted.h"

namespace spacetime::symbolic {
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

}  // namespace

std::string nearest(std::string_view wrong, std::span<const std::string> candidates) {
  if (wrong.size() > longest_compared) return {};
  std::string best;
  // Of those equally near, one as long as `wrong` is likelier.
  std::pair<std::size_t, bool> best_score{std::max<std::size_t>(1, wrong.size() / 3) + 1, false};
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest_compared || candidate == wrong) continue;
    const std::size_t dot = candidate.rfind('.');
    const bool tail = dot != std::string::npos && std::string_view(candidate).substr(dot + 1) == wrong;
    const std::pair score{tail ? 0 : distance(wrong, candidate), candidate.size() != wrong.size()};
    if (score < best_score && score.first < std::max(wrong.size(), candidate.size()))
      best = candidate, best_score = score;
  }
  return best;
}

std::string suggestion(std::string_view wrong, std::span<const std::string> candidates, std::string_view otherwise) {
  const std::string best = nearest(wrong, candidates);
  return ": " + (best.empty() ? std::string(otherwise) : "did you mean " + quoted(best) + "?");
}

std::string one_of(std::span<const std::string> candidates) {
  std::string out = "it is ";
  for (std::size_t i = 0; i < candidates.size(); ++i)
    out += (i == 0 ? "" : i + 1 == candidates.size() ? " or " : ", ") + quoted(candidates[i]);
  return out;
}

}  // namespace spacetime::symbolic
