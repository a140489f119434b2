#include "optimizer/server_progress.h"

#include <algorithm>

#include "protocol/measure.h"
#include "protocol/motion_json.h"
#include "protocol/program_json.h"

namespace spacetime::optimizer {

int Untold::add(const IterationRecord& record) {
  const std::lock_guard lock(mutex_);
  if (records_.size() == most) {  // nobody reads: every second one says as much
    for (std::size_t i = 1; i < most / 2; ++i) records_[i] = std::move(records_[2 * i]);
    records_.resize(most / 2);
  }
  records_.push_back({++last_, record});
  return last_;
}

std::vector<IterationRecord> Untold::take_up_to(int serial) {
  const std::lock_guard lock(mutex_);
  const auto end = std::ranges::upper_bound(records_, serial, {}, &Numbered::serial);
  std::vector<IterationRecord> told;
  for (auto at = records_.begin(); at != end; ++at) told.push_back(std::move(at->record));
  records_.erase(records_.begin(), end);
  return told;
}

std::string Snapshot::text(Shown& shown) const {
  Writer to(false);
  to.object([&] {
    to.member("kind", "iteration");
    to.member("iteration", record.iteration);
    const spacetime::Measures measures{to, true};
    measures.member("objective", record.objective);
    measures.member("violation", record.violation);
    measures.member("stationarity", record.stationarity);
    measures.member("step", record.step);
    measures.member("shift", record.shift);
    to.member("seconds", record.seconds);
    to.key("record");
    to.list_of(untold->take_up_to(serial), [&](const IterationRecord& one) { write(to, one, true); });
    to.key("dofs");
    const bool same = shown.run == run && shown.dofs.size() == dofs.size();
    to.list([&] {
      for (std::size_t i = 0; i < dofs.size(); ++i) {
        const Trajectory* before = same && shown.dofs[i].name == dofs[i].name ? &shown.dofs[i] : nullptr;
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
