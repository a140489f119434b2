#include "optimizer/conflict.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "common/bspline.h"
#include "optimizer/gradients.h"
#include "optimizer/naming.h"

namespace spacetime::optimizer {
namespace {

// Relations that are violated by less than this fraction of the worst, each over its size, take no part.
constexpr double innocent = 1e-6;
// A ridge above this (over the rows' size) forbids even ordinary changes.  It is believed only of a row whose gradient
// all but vanishes: to hold it alone needs a change of so many times the largest coefficient, or 1 (rad or m).
constexpr double plain_ridge = 1e-2, reach = 10;
// Dense algebra: the worst so many violated rows are looked at, and no larger systems.
constexpr std::size_t most_rows = 200, most_relations = 2000;
constexpr std::size_t most_conflicts = 4;
// The ridge: what a change d costs against a violation.  The least, in units of the rows' size, that leaves the
// violation of all relations at this fraction or more: restoration has found that no change helps, so what a smaller
// ridge takes for a remedy is one beyond the linearisation's reach.
constexpr double least_ridge = 1e-10, most_ridge = 1e6, left_of_all = 0.5;
// A set is contradictory where one of it keeps this fraction of its present violation.
constexpr double contradictory = 0.3;
// Definitions and bounds are not to give way.  What gives way so that others hold: so much more readily than they, but
// not so readily that no change of the motion would be worth while.
constexpr double stiff = 1e-6, giving = 1e5, least_giving = 1e2, most_giving = 1e-3;
// A bound is in the way where it pushes with this fraction of the largest multiplier.
constexpr double pushing = 1e-3;
constexpr int most_exchanges = 50;

struct Relation {
  Gradient gradient;  // over `size`
  double value = 0;   // c, over `size`
  double size = 1;
  bool at_most = false;
  int row = -1;             // of the transcription; -1 for a bound
  int unknown = -1;         // of a bound
  bool definition = false;  // of a functional
  bool wanted() const { return row >= 0 && !definition; }
  double violation() const { return at_most ? std::max(value, 0.0) : std::abs(value); }
};

using Indices = std::vector<int>;

// Of too many, those at the times of the worst: what contradicts one another mostly stands at one time.
void keep_worst_times(const Transcription& t, std::vector<Relation>& by_violation) {
  if (by_violation.size() <= most_rows) return;
  const auto time_of = [&](const Relation& one) {
    const double time = t.rows[one.row].time;
    return std::isnan(time) ? std::nullopt : std::optional(time);
  };
  std::map<std::optional<double>, std::size_t> count;
  for (const Relation& one : by_violation) ++count[time_of(one)];
  std::set<std::optional<double>> kept;
  std::size_t rows = 0;
  for (auto one = by_violation.rbegin(); one != by_violation.rend(); ++one) {
    const auto time = time_of(*one);
    if (kept.contains(time)) continue;
    if (rows + count[time] > most_rows) break;
    rows += count[time];
    kept.insert(time);
  }
  std::erase_if(by_violation, [&](const Relation& one) { return !kept.contains(time_of(one)); });
}

// The relations that matter at x: the worst violated ones, the functionals' definitions, the bounds of what they touch.
std::vector<Relation> gather(const Transcription& t, const Layout& layout, std::span<const double> x,
                             const Values& values, const BorderedMatrix& jacobian, const Eigen::VectorXd& sizes) {
  auto rows = gradients(t, layout, jacobian);
  std::vector<Relation> wanted, all;
  double worst = 0;
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const Row& row = t.rows[r];
    if (row.kind == Row::Kind::soft) continue;
    Relation relation;
    relation.size = std::sqrt(sizes[layout.of_row[r]]);
    relation.value = values.residual[r] / relation.size;
    relation.at_most = row.at_most;
    relation.row = static_cast<int>(r);
    relation.definition = row.kind == Row::Kind::functional;
    for (auto& [position, derivative] : rows[r]) derivative /= relation.size;
    relation.gradient = std::move(rows[r]);
    if (relation.definition) {
      all.push_back(std::move(relation));
    } else if (relation.violation() > 0) {
      worst = std::max(worst, relation.violation());
      wanted.push_back(std::move(relation));
    }
  }
  std::erase_if(wanted, [&](const Relation& one) { return one.violation() <= innocent * worst; });
  // The worst last: what is left out first is what is violated least.
  std::ranges::stable_sort(wanted, {}, &Relation::violation);
  keep_worst_times(t, wanted);
  std::ranges::move(wanted, std::back_inserter(all));

  std::vector<char> touched(layout.size(), 0);
  for (const Relation& one : all) {
    for (const auto& [position, derivative] : one.gradient) touched[position] = 1;
  }
  for (const int u : layout.free) {
    if (!touched[layout.of_unknown[u]]) continue;
    const auto bound = [&](double sign, double excess_of_bound) {
      if (!std::isfinite(excess_of_bound)) return;
      Relation relation;
      relation.gradient = {{layout.of_unknown[u], sign}};
      relation.value = excess_of_bound;
      relation.at_most = true;
      relation.unknown = u;
      all.push_back(std::move(relation));
    };
    bound(1, x[u] - t.upper[u]);
    bound(-1, t.lower[u] - x[u]);
  }
  return all;
}

// Least squares of chosen relations, with a ridge:  min  sum r_i^2 / ridge_i + |d|^2,  r = A d + c, or its positive
// part.  By duality r_i = ridge_i y_i where (A A^T + ridge) y = c, y >= 0 for inequalities.
class System {
 public:
  explicit System(std::vector<Relation> relations) : relations_(std::move(relations)) {
    const auto n = static_cast<Eigen::Index>(relations_.size());
    gram_.resize(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        gram_(i, j) = gram_(j, i) = dot(relations_[i].gradient, relations_[j].gradient);
      }
    }
    for (int i = 0; i < static_cast<int>(n); ++i) {
      if (relations_[i].wanted()) wanted_.push_back(i);
    }
    if (!wanted_.empty() && !calibrate()) wanted_.clear();
  }

  const std::vector<Relation>& relations() const { return relations_; }
  const Indices& wanted() const { return wanted_; }  // empty where nothing can be said

  // Multipliers y of all relations when only `chosen` are wanted; `giving_way` of them rather than the others.
  Eigen::VectorXd multipliers(const Indices& chosen, const Indices& giving_way = {}) const {
    Eigen::VectorXd ridge = ridges(giving_way);
    std::vector<char> is_in(relations_.size(), 0), active(relations_.size(), 0);
    for (std::size_t i = 0; i < relations_.size(); ++i) is_in[i] = !relations_[i].wanted();
    for (const int i : chosen) is_in[i] = 1;
    for (std::size_t i = 0; i < relations_.size(); ++i) {
      active[i] = is_in[i] && (!relations_[i].at_most || relations_[i].value > 0);
    }
    Eigen::VectorXd y = Eigen::VectorXd::Zero(gram_.rows());
    for (int k = 0; k < most_exchanges; ++k) {  // the active set of the inequalities
      y = solve(active, ridge);
      const Eigen::VectorXd change = gram_ * y;  // -A d
      bool settled = true;
      for (std::size_t i = 0; i < relations_.size(); ++i) {
        if (!is_in[i] || !relations_[i].at_most) continue;
        const auto index = static_cast<Eigen::Index>(i);
        const bool wants = active[i] ? y[index] > 0 : relations_[i].value - change[index] > rounding;
        settled &= wants == static_cast<bool>(active[i]);
        active[i] = wants;
      }
      if (settled) break;
    }
    return y;
  }

  // What is left of violations, each over its size.
  Eigen::VectorXd left(const Indices& chosen, const Indices& giving_way = {}) const {
    return multipliers(chosen, giving_way).cwiseProduct(ridges(giving_way)).cwiseAbs();
  }

  // Whether the ridge may say that these contradict one another.
  bool credible(const Indices& chosen, double largest_coefficient) const {
    if (ridge_ <= plain_ridge * unit_) return true;
    return std::ranges::any_of(chosen, [&](int i) {
      return relations_[i].violation() > reach * std::max(1.0, largest_coefficient) * std::sqrt(gram_(i, i));
    });
  }

  // Each is compared with its own violation: one of a thousandth beside one of 1 may be a conflict as well.
  bool contradict(const Indices& chosen) const {
    const Eigen::VectorXd remains = left(chosen);
    return std::ranges::any_of(chosen, [&](int i) { return remains[i] > contradictory * relations_[i].violation(); });
  }

 private:
  static constexpr double rounding = 1e-12;

  Eigen::VectorXd ridges(const Indices& giving_way) const {
    Eigen::VectorXd ridge(gram_.rows());
    for (Eigen::Index i = 0; i < ridge.size(); ++i) {
      ridge[i] = ridge_ * (relations_[i].wanted() ? 1 : stiff);
    }
    // A violation is r_i * size: ridges that give way to all of a statement alike.
    const double way = std::max(least_giving * ridge_, std::min(giving * ridge_, most_giving * unit_));
    double squares = 0;
    for (const int i : giving_way) squares += relations_[i].size * relations_[i].size;
    for (const int i : giving_way) {
      const double mean = squares / static_cast<double>(giving_way.size());
      ridge[i] = way * mean / (relations_[i].size * relations_[i].size);
    }
    return ridge;
  }

  Eigen::VectorXd solve(const std::vector<char>& active, const Eigen::VectorXd& ridge) const {
    Indices in;
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (active[i]) in.push_back(static_cast<int>(i));
    }
    Eigen::MatrixXd matrix = gram_(in, in);
    Eigen::VectorXd right(static_cast<Eigen::Index>(in.size()));
    for (std::size_t k = 0; k < in.size(); ++k) {
      const auto index = static_cast<Eigen::Index>(k);
      matrix(index, index) += ridge[in[k]];
      right[index] = relations_[in[k]].value;
    }
    Eigen::VectorXd y = Eigen::VectorXd::Zero(gram_.rows());
    const Eigen::VectorXd solution = matrix.ldlt().solve(right);
    y(in) = solution;
    return y;
  }

  bool calibrate() {
    double present = 0;
    unit_ = 0;
    for (const int i : wanted_) {
      unit_ = std::max(unit_, gram_(i, i));
      present += relations_[i].value * relations_[i].value;
    }
    if (unit_ == 0) unit_ = 1;
    for (double ridge = least_ridge; ridge <= most_ridge; ridge *= 10) {
      ridge_ = ridge * unit_;
      if (left(wanted_)(wanted_).squaredNorm() >= left_of_all * present) return true;
    }
    return false;
  }

  std::vector<Relation> relations_;
  Indices wanted_;
  Eigen::MatrixXd gram_;
  double ridge_ = 0, unit_ = 1;
};

using Groups = std::vector<Indices>;

Indices joined(const Groups& groups) {
  Indices all;
  for (const Indices& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

// Leaves out what contradiction does not need: halves first, then quarters, at last one by one.
Groups filtered(const System& system, Groups groups) {
  for (std::size_t size = std::max<std::size_t>(1, groups.size() / 2);; size /= 2) {
    for (std::size_t k = 0; k < groups.size();) {
      Groups rest(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(k));
      rest.insert(rest.end(), groups.begin() + static_cast<std::ptrdiff_t>(std::min(k + size, groups.size())),
                  groups.end());
      if (!rest.empty() && system.contradict(joined(rest))) {
        groups = std::move(rest);
      } else {
        k += size;
      }
    }
    if (size == 1) return groups;
  }
}

// Groups of equal keys, in the order in which keys first stand.
template <class Key>
Groups grouped(const Indices& indices, Key key) {
  Groups groups;
  std::map<decltype(key(0)), std::size_t> group_of;
  for (const int i : indices) {
    const auto [found, added] = group_of.try_emplace(key(i), groups.size());
    if (added) groups.emplace_back();
    groups[found->second].push_back(i);
  }
  return groups;
}

class Finder {
 public:
  Finder(const Transcription& t, std::span<const double> x, std::vector<Relation> relations)
      : t_(t), system_(std::move(relations)) {
    for (const double one : x) largest_coefficient_ = std::max(largest_coefficient_, std::abs(one));
  }

  std::vector<Conflict> run() const {
    std::vector<Conflict> result;
    Indices rest = system_.wanted();
    while (!rest.empty() && result.size() < most_conflicts) {
      Groups groups = filtered(system_, by_statement(rest));
      const Indices statements = joined(groups);
      groups = filtered(system_, grouped(statements, [&](int i) {
                          const double time = row(i).time;
                          return std::pair(row(i).statement, std::isnan(time) ? std::nullopt : std::optional(time));
                        }));
      if (!system_.credible(joined(groups), largest_coefficient_)) break;
      result.push_back(told(by_statement(joined(groups))));
      rest = without_one_of(rest, groups);
    }
    return result;
  }

 private:
  const Row& row(int i) const { return t_.rows[system_.relations()[i].row]; }
  Groups by_statement(const Indices& indices) const {
    return grouped(indices, [&](int i) { return row(i).statement; });
  }

  // The wanted relations without one of a conflict's statements, such that they still contradict one another; nothing
  // where whichever is left out the others can hold.
  Indices without_one_of(const Indices& wanted, const Groups& conflict) const {
    for (const Indices& statement : by_statement(joined(conflict))) {
      Indices rest = wanted;
      std::erase_if(rest, [&](int i) { return row(i).statement == row(statement.front()).statement; });
      if (!rest.empty() && system_.contradict(rest)) return rest;
    }
    return {};
  }

  Conflict told(const Groups& statements) const {
    Conflict conflict;
    const Indices all = joined(statements);
    const auto everywhere = [&](const Indices& some) {  // all wanted instances of the same statements
      Indices result;
      for (const int i : system_.wanted()) {
        if (std::ranges::any_of(some, [&](int one) { return row(one).statement == row(i).statement; })) {
          result.push_back(i);
        }
      }
      return result;
    };
    for (const Indices& statement : statements) {
      const Constraint& constraint = t_.problem->constraints[row(statement.front()).statement];
      Member member{constraint.name, constraint.place.line, {}, 0};
      for (const int i : statement) {
        if (!std::isnan(row(i).time)) member.times.push_back(row(i).time);
      }
      const Indices gives = everywhere(statement);
      const Eigen::VectorXd left = system_.left(everywhere(all), gives);
      for (const int i : gives) {
        const Relation& one = system_.relations()[i];
        member.give = std::max(member.give, one.size * (statements.size() == 1 ? one.violation() : left[i]));
      }
      std::ranges::sort(member.times);
      member.times.erase(std::unique(member.times.begin(), member.times.end()), member.times.end());
      conflict.members.push_back(std::move(member));
    }
    std::ranges::stable_sort(conflict.members, {}, &Member::line);
    add_bounds(all, conflict);
    return conflict;
  }

  void add_bounds(const Indices& chosen, Conflict& conflict) const {
    const Eigen::VectorXd y = system_.multipliers(chosen).cwiseAbs();
    double largest = 0;
    for (const int i : chosen) largest = std::max(largest, y[i]);
    for (std::size_t i = 0; i < system_.relations().size(); ++i) {
      const int unknown = system_.relations()[i].unknown;
      if (unknown < 0 || !(y[static_cast<Eigen::Index>(i)] > pushing * largest)) continue;
      Member member;
      if (unknown >= t_.first_parameter()) {
        const Parameter& parameter = t_.problem->parameters[unknown - t_.first_parameter()];
        member = {parameter.name, parameter.place.line, {}, 0};
      } else {
        const auto dof = std::upper_bound(t_.first.begin(), t_.first.end(), unknown) - t_.first.begin() - 1;
        const Dof& one = t_.problem->dofs[dof];
        member = {one.name, one.place.line, {}, 0};
      }
      if (std::ranges::find(conflict.bounds, member) == conflict.bounds.end()) conflict.bounds.push_back(member);
    }
  }

  const Transcription& t_;
  System system_;
  double largest_coefficient_ = 0;
};

}  // namespace

std::vector<Conflict> conflicts(const Transcription& t, const Layout& layout, std::span<const double> x,
                                const Values& values, const BorderedMatrix& jacobian, const Eigen::VectorXd& sizes) {
  auto relations = gather(t, layout, x, values, jacobian, sizes);
  if (relations.size() > most_relations) return {};
  return Finder(t, x, std::move(relations)).run();
}

namespace {

// By how much each member would have to give way, the largest first.  What is nothing beside that says how far the
// constraint is from holding already, not that relaxing it would help.
std::vector<std::string> ways_out(const Conflict& conflict) {
  constexpr double nothing = 1e-6;
  struct Way {
    double give = 0;
    std::string text;
  };
  std::vector<Way> ways;
  double largest = 0;
  for (const Member& member : conflict.members) {
    // As it is told: equal numbers stay in the order of the scene, whatever the rounding behind them.
    const std::string give = fmt::format("{:.3g}", member.give);
    ways.push_back({std::stod(give), fmt::format("'{}' by {}", member.name, give)});
    largest = std::max(largest, member.give);
  }
  std::ranges::stable_sort(ways, std::greater{}, &Way::give);
  std::vector<std::string> told;
  for (const Way& way : ways) {
    if (way.give >= nothing * largest) told.push_back(way.text);
  }
  return told;
}

}  // namespace

std::string sentence(const Conflict& conflict) {
  std::vector<std::string> members, bounds;
  for (const Member& member : conflict.members) {
    std::string text = fmt::format("'{}' (line {}", member.name, member.line);
    if (const std::string when = seconds(member.times); !when.empty()) text += ", at " + when;
    members.push_back(text + ")");
  }
  for (const Member& bound : conflict.bounds) bounds.push_back(named(bound.name, bound.line));
  const std::string within = bounds.empty() ? "" : " within the bounds of " + listed(bounds);
  if (members.size() > 1) {
    return fmt::format("{} cannot hold together{}. To reconcile them relax {}.", listed(members), within,
                       listed(ways_out(conflict), "or"));
  }
  const Member& only = conflict.members.front();
  const bool many = only.times.size() > 1;
  return fmt::format("{} cannot hold{}{}: no small change brings {} nearer than {:.3g}.", members.front(),
                     many             ? " at these times together"
                     : bounds.empty() ? " by itself"
                                      : "",
                     within, many ? "them" : "it", only.give);
}

}  // namespace spacetime::optimizer
