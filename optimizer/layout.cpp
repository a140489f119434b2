#include "optimizer/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/diagnostic.h"

namespace spacetime::optimizer {
namespace {

// The Schur complement of the border is dense: a thousand columns cost a second an iteration, more are a misuse.
constexpr int max_border = 1024;

// The coefficients of a slot that count at a sample: those whose basis values do not all vanish there.
template <typename Visit>
void for_each_coefficient(const Transcription& t, const Batch& batch, int sample, Visit visit) {
  for (const Slot& slot : batch.slots) {
    const BasisValues& basis = batch.basis(slot, sample);
    for (int k = 0; k < 4; ++k) {
      bool counts = false;
      for (int d = 0; d <= max_derivative; ++d) counts |= slot.input[d] >= 0 && basis.b[d][k] != 0;
      if (counts) visit(t.first[slot.dof] + basis.first + k);
    }
  }
}

// Entries of the band. Five copies of it are kept, so this is two gigabytes; a step already takes minutes.
constexpr double max_band = 5e7;

struct Item {
  double key;  // time, s
  bool row;    // after coefficients of the same time: its pivot is made by theirs
  int index;
};

}  // namespace

Layout arrange(const Transcription& t) {
  Layout layout;
  layout.of_unknown.assign(t.unknowns(), -1);
  layout.of_row.assign(t.rows.size(), -1);

  std::vector<double> key(t.first_functional());
  std::vector<Item> items;
  for (int dof = 0; dof < t.dofs(); ++dof) {
    const auto times = greville(t.problem->dofs[dof].basis);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const int unknown = t.first[dof] + static_cast<int>(k);
      key[unknown] = times[k];
      items.push_back({times[k], false, unknown});
    }
  }
  for (const Batch& batch : t.batches) {
    if (batch.summed()) continue;
    for (int s = 0; s < batch.samples(); ++s) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for_each_coefficient(t, batch, s, [&](int unknown) {
        low = std::min(low, key[unknown]);
        high = std::max(high, key[unknown]);
      });
      if (low > high) continue;  // touches no coefficient: stands in the border
      for (int o = 0; o < batch.outputs(); ++o) {
        items.push_back({(low + high) / 2, true, batch.first_row + s * batch.outputs() + o});
      }
    }
  }
  std::ranges::stable_sort(items,
                           [](const Item& a, const Item& b) { return a.key != b.key ? a.key < b.key : a.row < b.row; });
  for (const Item& item : items) (item.row ? layout.of_row : layout.of_unknown)[item.index] = layout.n++;
  for (auto* positions : {&layout.of_unknown, &layout.of_row}) {
    for (int& position : *positions) {
      if (position < 0) position = layout.n + layout.border++;
    }
  }
  if (layout.border > max_border) {
    throw InputError(std::to_string(layout.border) + " unknowns and rows couple distant times; at most " +
                     std::to_string(max_border) + " can be eliminated. Use fewer lifted functionals");
  }

  for (const Batch& batch : t.batches) {
    for (int s = 0; s < batch.samples(); ++s) {
      int low = layout.n, high = -1;
      for_each_coefficient(t, batch, s, [&](int unknown) {
        low = std::min(low, layout.of_unknown[unknown]);
        high = std::max(high, layout.of_unknown[unknown]);
      });
      if (!batch.summed()) {
        for (int o = 0; o < batch.outputs(); ++o) {
          const int row = layout.of_row[batch.first_row + s * batch.outputs() + o];
          if (row >= layout.n) continue;
          layout.width = std::max({layout.width, high - row, row - low});
        }
      }
      // Coefficients couple only where the program has second derivatives; a residual that is linear has none.
      if (!batch.hessian.empty() && high >= 0) layout.width = std::max(layout.width, high - low);
    }
  }
  if (static_cast<double>(layout.n) * (layout.width + 1) > max_band) {
    throw InputError(
        fmt::format("the matrix of a step would have {} rows with {} entries each: too many instances stand "
                    "within a few knot spans. Use larger steps between instances, or fewer degrees of freedom",
                    layout.n, layout.width + 1));
  }
  return layout;
}

}  // namespace spacetime::optimizer
