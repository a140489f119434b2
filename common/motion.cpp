#include "common/motion.h"

#include "common/assert.h"

namespace spacetime {

std::string_view name_of(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::stopped:
      return "stopped";
    case Status::infeasible:
      return "infeasible";
    case Status::failed:
      return "failed";
  }
  SPACETIME_ASSERT(false && "a status of the enumeration");
  return {};
}

}  // namespace spacetime
