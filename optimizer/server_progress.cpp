#include "optimizer/server_progress.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "protocol/motion_json.h"
#include "protocol/program_json.h"

namespace spacetime::optimizer {

void write_measure(Writer& to, std::string_view name, double value) {
  to.key(name);
  if (std::isfinite(value)) {
    to.number(value);
  } else {
    to.null();
  }
}

void Untold::add(const IterationRecord& record) {
  const std::lock_guard lock(mutex_);
  if (records_.size() == most) {  // nobody reads: every second one says as much
    for (std::size_t i = 1; i < most / 2; ++i) records_[i] = std::move(records_[2 * i]);
    records_.resize(most / 2);
  }
  records_.push_back(record);
}

std::vector<IterationRecord> Untold::take_up_to(int iteration) {
  const std::lock_guard lock(mutex_);
  const auto later = [&](const IterationRecord& record) { return record.iteration > iteration; };
  const auto end = std::ranges::find_if(records_, later);
  std::vector<IterationRecord> told(std::make_move_iterator(records_.begin()), std::make_move_iterator(end));
  records_.erase(records_.begin(), end);
  return told;
}

std::string Snapshot::text(Shown& shown) const {
  Writer to(false);
  to.object([&] {
    to.member("kind", "iteration");
    to.member("iteration", record.iteration);
    write_measure(to, "objective", record.objective);
    write_measure(to, "violation", record.violation);
    write_measure(to, "stationarity", record.stationarity);
    write_measure(to, "step", record.step);
    write_measure(to, "shift", record.shift);
    to.member("seconds", record.seconds);
    to.key("record");
    to.list_of(untold->take_up_to(record.iteration), [&](const IterationRecord& one) { write(to, one, true); });
    to.key("dofs");
    const bool same = shown.run == run && shown.dofs.size() == dofs.size();
    to.list([&] {
      for (std::size_t i = 0; i < dofs.size(); ++i) {
        const Trajectory* before = same ? &shown.dofs[i] : nullptr;
        if (before && *before == dofs[i]) continue;
        to.object([&] {
          to.member("name", dofs[i].name);
          if (!before || before->basis != dofs[i].basis) {
            to.key("basis");
            write(to, dofs[i].basis);
          }
          to.key("coefficients");
          to.numbers(dofs[i].coefficients);
        });
      }
    });
    if (parameters.empty()) return;
    to.key("parameters");
    to.object([&] {
      for (const auto& [name, value] : parameters) to.member(name, value);
    });
  });
  shown = {run, dofs};
  return to.take();
}

}  // namespace spacetime::optimizer
