#include "optimizer/dependence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "optimizer/gradients.h"
#include "optimizer/naming.h"

namespace spacetime::optimizer {
namespace {

// Multiplications spent at most: some hundredths of a second.
constexpr double most_work = 3e7;
// A row of length 1 is suspected within this distance of what others span (Cholesky knows its square to rounding), and
// dependent within the second.
constexpr double suspicious = 1e-5, dependent = 1e-9;
// A coefficient of the combination below this is rounding.
constexpr double negligible = 1e-6;
constexpr std::size_t statements_named = 3;

struct Equation {
  int row = 0;        // of the transcription
  Gradient gradient;  // of length 1
  bool definition = false;
};

// Cholesky factorisation of the Gram matrix of rows, by rows, in an envelope: row i from column first[i] on.  Its
// pivots are the squared distances from what the rows before span; a row without is left out.
class GramFactor {
 public:
  explicit GramFactor(const std::vector<Equation>& equations) : equations_(equations) {
    const int n = static_cast<int>(equations.size());
    std::map<int, int> first_with;  // by position
    for (int i = 0; i < n; ++i) {
      int first = i;
      for (const auto& [position, derivative] : equations[i].gradient) {
        first = std::min(first, first_with.try_emplace(position, i).first->second);
      }
      first_.push_back(first);
      work_ += static_cast<double>(i - first) * (i - first) / 2;
    }
  }

  double work() const { return work_; }

  // The next equation: where it depends on those before, the combination (weights by index).
  std::optional<std::map<int, double>> add(int i) {
    std::vector<double> l = forward(i, gram(i));
    double squares = 0;
    for (const double one : l) squares += one * one;
    const double pivot = equations_[i].gradient.empty() ? 0 : 1 - squares;
    std::optional<std::map<int, double>> weights;
    if (pivot <= suspicious * suspicious) weights = combination(i, l);
    rows_.push_back(std::move(l));
    pivots_.push_back(weights ? 0 : std::sqrt(std::max(pivot, dependent * dependent)));
    return weights;
  }

 private:
  std::vector<double> gram(int i) const {
    std::vector<double> g;
    for (int j = first_[i]; j < i; ++j) g.push_back(dot(equations_[i].gradient, equations_[j].gradient));
    return g;
  }

  // L l = g
  std::vector<double> forward(int i, std::vector<double> g) const {
    const int from = first_[i];
    for (int j = from; j < i; ++j) {
      double& value = g[j - from];
      if (pivots_[j] == 0) {
        value = 0;
        continue;
      }
      const int start = std::max(from, first_[j]);
      for (int k = start; k < j; ++k) value -= rows_[j][k - first_[j]] * g[k - from];
      value /= pivots_[j];
    }
    return g;
  }

  // L^T y = l.  It may reach back before first_[i].
  std::map<int, double> backward(int i, const std::vector<double>& l) const {
    std::map<int, double> right, y;
    for (int j = first_[i]; j < i; ++j) right[j] = l[j - first_[i]];
    while (!right.empty()) {
      const auto [j, value] = *right.rbegin();
      right.erase(j);
      if (pivots_[j] == 0 || value == 0) continue;
      const double weight = value / pivots_[j];
      y[j] = weight;
      for (int k = first_[j]; k < j; ++k) {
        const double part = rows_[j][k - first_[j]] * weight;
        if (part != 0) right[k] -= part;
      }
    }
    return y;
  }

  // How row i is made of those before; nothing where it is not.
  std::optional<std::map<int, double>> combination(int i, const std::vector<double>& l) const {
    std::map<int, double> weights = backward(i, l);
    std::map<int, double> missing(equations_[i].gradient.begin(), equations_[i].gradient.end());
    for (const auto& [j, weight] : weights) {
      for (const auto& [position, derivative] : equations_[j].gradient) missing[position] -= weight * derivative;
    }
    double squares = 0;
    for (const auto& [position, derivative] : missing) squares += derivative * derivative;
    if (!(std::sqrt(squares) <= dependent)) return std::nullopt;
    std::erase_if(weights, [](const auto& one) { return std::abs(one.second) <= negligible; });
    return weights;
  }

  const std::vector<Equation>& equations_;
  std::vector<int> first_;
  std::vector<std::vector<double>> rows_;
  std::vector<double> pivots_;  // 0 where left out
  double work_ = 0;
};

// Those of statements in time, so that the envelope is narrow; what has no time first.
std::vector<Equation> equations_of(const Transcription& t, const Layout& layout, const BorderedMatrix& jacobian,
                                   const std::vector<char>& active) {
  auto rows = gradients(t, layout, jacobian);
  std::vector<Equation> equations;
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const Row& row = t.rows[r];
    if (row.kind == Row::Kind::soft || row.at_most || (!active.empty() && !active[r])) continue;
    double squares = 0;
    for (const auto& [position, derivative] : rows[r]) squares += derivative * derivative;
    for (auto& [position, derivative] : rows[r]) derivative /= std::sqrt(squares);
    equations.push_back({static_cast<int>(r), std::move(rows[r]), row.kind == Row::Kind::functional});
  }
  std::ranges::stable_sort(equations, {}, [&](const Equation& one) {
    const double time = t.rows[one.row].time;
    return std::isnan(time) ? -std::numeric_limits<double>::infinity() : time;
  });
  return equations;
}

}  // namespace

Dependences dependences(const Transcription& t, const Layout& layout, const BorderedMatrix& jacobian,
                        const std::vector<char>& active) {
  const auto equations = equations_of(t, layout, jacobian, active);
  GramFactor factor(equations);
  if (factor.work() > most_work) return {};
  Dependences result;
  std::map<std::tuple<int, std::vector<int>, bool>, std::vector<double>> found;
  for (int i = 0; i < static_cast<int>(equations.size()); ++i) {
    result.equations += !equations[i].definition;
    const auto weights = factor.add(i);
    if (!weights) continue;
    // A dependence is mutual: of the statements that take part, the last is told to follow from the others.
    std::vector<std::pair<int, int>> parts{{t.rows[equations[i].row].statement, i}};
    for (const auto& [j, weight] : *weights) {
      if (!equations[j].definition) parts.emplace_back(t.rows[equations[j].row].statement, j);
    }
    const auto last = std::ranges::max_element(parts, {}, [](const auto& part) { return part.first; });
    const auto [statement, which] = *last;
    parts.erase(last);
    std::set<int> others;
    for (const auto& part : parts) others.insert(part.first);
    found[{statement, {others.begin(), others.end()}, parts.size() == 1}].push_back(t.rows[equations[which].row].time);
  }
  for (auto& [key, times] : found) {
    const auto& [statement, others, repeated] = key;
    result.all.push_back({statement, others, std::move(times), repeated});
  }
  return result;
}

std::string sentence(const Problem& problem, const Dependences& dependences) {
  std::size_t count = 0;
  std::vector<std::string> parts;
  const auto name = [&](int statement) {
    return named(problem.constraints[statement].name, problem.constraints[statement].place.line);
  };
  for (const Dependence& one : dependences.all) {
    count += one.times.size();
    std::vector<std::string> others;
    for (const int other : one.others) {
      if (others.size() == statements_named) break;
      others.push_back(other == one.statement ? "its other instances" : name(other));
    }
    if (one.others.size() > statements_named) {
      others.push_back(fmt::format("{} more", one.others.size() - statements_named));
    }
    std::string text = name(one.statement);
    text += others.empty() ? " depends on nothing that is free" : one.repeated ? " repeats " : " follows from ";
    text += listed(others);
    if (const std::string when = seconds(one.times); !when.empty()) text += " at " + when;
    parts.push_back(std::move(text));
  }
  if (count == 0) return "";
  return fmt::format("{} of {} equations depend{} on others: {}.", count, dependences.equations, count == 1 ? "s" : "",
                     fmt::join(parts, "; "));
}

}  // namespace spacetime::optimizer
