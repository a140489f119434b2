#include "symbolic/scope.h"

#include "symbolic/expression.h"

namespace spacetime::symbolic {
namespace {

constexpr int most_instances = 1000000;  // of one statement; memory for each would run out soon after

std::optional<Fixed> fixed_time(Model& model, NodeId root, std::string_view what) {
  const auto time = elaborate_fixed(model, root, what);
  if (time) model.time_checks.push_back({model.scene.nodes[root].span, time->value, std::string(what)});
  return time;
}

}  // namespace

std::optional<Quantity> elaborate_time(Model& model, NodeId root, std::string_view what) {
  const auto time = fixed_time(model, root, what);
  if (!time) return std::nullopt;
  return quantity(model, time->expr);
}

std::optional<Scope> elaborate_scope(Model& model, const ScopeClause& clause) {
  using Kind = ScopeClause::Kind;
  Scope out;
  if (clause.kind == Kind::at) {
    out.kind = Scope::Kind::times;
    bool good = true;
    for (const NodeId id : clause.times) {
      const auto time = elaborate_time(model, id, "this time");
      if (time)
        out.times.push_back(*time);
      else
        good = false;
    }
    return good ? std::optional(out) : std::nullopt;
  }
  const auto from = fixed_time(model, clause.interval.from, "the scope's first time");
  const auto to = fixed_time(model, clause.interval.to, "the scope's last time");
  if (!from || !to) return std::nullopt;
  if (!(from->value < to->value)) {
    report(model, clause.interval.span, "a scope's last time must be later than its first");
    return std::nullopt;
  }
  out.from = quantity(model, from->expr);
  out.to = quantity(model, to->expr);
  out.kind = Scope::Kind::knots;
  if (clause.kind == Kind::count) {
    const auto count = elaborate_count(model, clause.argument, "the count", 2, most_instances);
    if (!count) return std::nullopt;
    out.kind = Scope::Kind::count;
    out.count = count->value;
    freeze(model, count->expr, clause.span, "count");
  }
  if (clause.kind == Kind::every) {
    const auto step = elaborate_fixed(model, clause.argument, "the step");
    if (!step) return std::nullopt;
    const Span& span = model.scene.nodes[clause.argument].span;
    if (!(step->value > 0)) return report(model, span, "a scope's step must be greater than 0"), std::nullopt;
    if ((to->value - from->value) / step->value > most_instances)
      return report(model, span,
                    "this step makes more than " + std::to_string(most_instances) + " instances: take a longer one"),
             std::nullopt;
    out.kind = Scope::Kind::every;
    out.step = quantity(model, step->expr);
  }
  return out;
}

std::optional<spacetime::Interval> elaborate_window(Model& model, const Interval& interval, std::string_view what) {
  const auto from = elaborate_fixed(model, interval.from, "the first time of " + std::string(what));
  const auto to = elaborate_fixed(model, interval.to, "the last time of " + std::string(what));
  if (!from || !to) return std::nullopt;
  if (!(from->value < to->value)) {
    report(model, interval.span, "the last time of " + std::string(what) + " must be later than its first");
    return std::nullopt;
  }
  model.interval_checks.push_back({interval.span, from->value, to->value});
  return spacetime::Interval{quantity(model, from->expr), quantity(model, to->expr)};
}

void check_times(Model& model) {
  const double start = model.problem.start, end = model.problem.end;
  const double slack = 1e-9 * (end - start);  // the same as the one that makes a last step whole
  const auto interval = [](double from, double to) {
    return std::string("[").append(text_of(from)).append(", ").append(text_of(to)).append("]");
  };
  const std::string time = "the scene's time " + interval(start, end);
  for (const TimeCheck& check : model.time_checks)
    if (check.time < start - slack || check.time > end + slack)
      report(model, check.span, check.what + " is " + text_of(check.time) + ", which lies outside " + time);
  for (const IntervalCheck& check : model.interval_checks)
    if (check.to <= start + slack || check.from >= end - slack)
      report(model, check.span, interval(check.from, check.to) + " does not meet " + time);
}

}  // namespace spacetime::symbolic
