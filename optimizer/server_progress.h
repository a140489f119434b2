// What a peer is told of a run while it goes on.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/motion.h"

namespace spacetime::optimizer {

// What one peer has been shown of a run, so that only changes are sent.  Used by whoever writes its messages.
struct Shown {
  int run = 0;
  std::vector<Trajectory> dofs;
};

// The iterations of a run that no message has told of yet: iterates may be left out, what was measured at them is not.
// They are known by the order they came in: an iteration's number may fall where another motion is put in place.
class Untold {
 public:
  int add(const IterationRecord& record);  // its serial number
  std::vector<IterationRecord> take_up_to(int serial);

 private:
  static constexpr std::size_t most = 1024;
  struct Numbered {
    int serial;
    IterationRecord record;
  };
  std::mutex mutex_;
  int last_ = 0;
  std::vector<Numbered> records_;
};

// An iterate, copied to be written later, or never.
struct Snapshot {
  int run = 0, serial = 0;
  IterationRecord record;
  std::shared_ptr<Untold> untold;
  std::vector<Trajectory> dofs;
  std::vector<std::pair<std::string, double>> parameters;

  // What has changed since what is shown, which it becomes.
  std::string text(Shown& shown) const;
};

}  // namespace spacetime::optimizer
