// What a peer is told of a run while it goes on.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/motion.h"
#include "protocol/writer.h"

namespace spacetime::optimizer {

// A number, or null where it is none.
void write_measure(Writer& to, std::string_view name, double value);

// What one peer has been shown of a run, so that only changes are sent.  Used by whoever writes its messages.
struct Shown {
  int run = 0;
  std::vector<Trajectory> dofs;
};

// The iterations of a run that no message has told of yet: iterates may be left out, what was measured at them is not.
class Untold {
 public:
  void add(const IterationRecord& record);
  std::vector<IterationRecord> take_up_to(int iteration);

 private:
  static constexpr std::size_t most = 1024;
  std::mutex mutex_;
  std::vector<IterationRecord> records_;
};

// An iterate, copied to be written later, or never.
struct Snapshot {
  int run = 0;
  IterationRecord record;
  std::shared_ptr<Untold> untold;
  std::vector<Trajectory> dofs;
  std::vector<std::pair<std::string, double>> parameters;

  // What has changed since what is shown, which it becomes.
  std::string text(Shown& shown) const;
};

}  // namespace spacetime::optimizer
