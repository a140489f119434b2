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

// Entries of the band. Five copies of it are kept, so this is two gigabytes; a step already takes minutes.
constexpr double max_band = 5e7;

// A coefficient counts as wide beside another whose knot spans are narrower by more than this.
constexpr double wide = 1.5;

// What a column costs besides its arithmetic, in multiplications; what an entry of a long row costs against one of the
// band; and how much cheaper the factorisation must become by long rows.
constexpr double overhead = 16, far_cost = 6, gain = 2;

struct Item {
  double key;  // time, s
  bool row;    // after coefficients of the same time: its pivot is made by theirs
  int index;
};

// The free coefficients that count at a sample: those whose basis values do not all vanish there.
template <typename Visit>
void for_each_coefficient(const Transcription& t, const Batch& batch, int sample, Visit visit) {
  for (const Slot& slot : batch.slots) {
    const BasisValues& basis = batch.basis(slot, sample);
    for (int k = 0; k < 4; ++k) {
      bool counts = false;
      for (int d = 0; d <= max_derivative; ++d) counts |= slot.input[d] >= 0 && basis.b[d][k] != 0;
      const int unknown = t.origin(slot.dof) + basis.first + k;
      if (counts && !t.fixed[unknown]) visit(unknown);
    }
  }
}

// Limits and soft rows that touch coefficients alone.
bool stands_beside(const Transcription& t, const Batch& batch) {
  if (batch.summed() || batch.samples() == 0 || !batch.border_jacobian.empty()) return false;
  const Row& row = t.rows[batch.first_row];
  return row.at_most || row.kind == Row::Kind::soft;
}

class Arranger {
 public:
  explicit Arranger(const Transcription& t) : t_(t) {
    out_.of_unknown.assign(t.unknowns(), -1);
    out_.of_row.assign(t.rows.size(), -1);
    for (int u = 0; u < t.unknowns(); ++u) {
      if (!t.fixed[u]) out_.free.push_back(u);
    }
  }

  Layout run() {
    place_coefficients();
    for (const Batch& batch : t_.batches) {
      if (!batch.summed() && !stands_beside(t_, batch)) place_rows(batch);
    }
    std::ranges::stable_sort(
        items_, [](const Item& a, const Item& b) { return a.key != b.key ? a.key < b.key : a.row < b.row; });
    for (const Item& item : items_) (item.row ? out_.of_row : out_.of_unknown)[item.index] = pattern_.n++;
    for (const Batch& batch : t_.batches) {
      if (stands_beside(t_, batch)) place_beside(batch);
    }
    place_border();
    find_profile();
    choose_long_rows();
    out_.pattern = std::make_shared<const Pattern>(std::move(pattern_));
    return std::move(out_);
  }

 private:
  // The narrowest knot span of any degree of freedom that ends at or reaches over a time.
  double narrowest_before(double time) const {
    double narrowest = std::numeric_limits<double>::infinity();
    for (const Dof& dof : t_.problem->dofs) {
      const auto& knots = dof.basis.knots;
      const auto after = std::ranges::lower_bound(knots.begin() + 4, knots.end() - 4, time);  // the span's end
      narrowest = std::min(narrowest, *after - *(after - 1));
    }
    return narrowest;
  }

  void place_coefficients() {
    key_.resize(t_.first_functional());
    span_.resize(t_.first_functional());
    for (int dof = 0; dof < t_.dofs(); ++dof) {
      const auto& knots = t_.problem->dofs[dof].basis.knots;
      for (int unknown = t_.first[dof]; unknown < t_.first[dof + 1]; ++unknown) {
        if (t_.fixed[unknown]) continue;
        const int k = unknown - t_.origin(dof);
        for (int i = k; i < k + 4; ++i) span_[unknown] = std::max(span_[unknown], knots[i + 1] - knots[i]);
        const double span = narrowest_before(knots[k + 4]);
        const bool is_wide = span_[unknown] > wide * span;
        key_[unknown] = is_wide ? knots[k + 4] - 2 * span : (knots[k + 1] + knots[k + 2] + knots[k + 3]) / 3;
        items_.push_back({key_[unknown], false, unknown});
      }
    }
  }

  void place_rows(const Batch& batch) {
    for (int s = 0; s < batch.samples(); ++s) {
      constexpr double infinite = std::numeric_limits<double>::infinity();
      double narrowest = infinite, low = infinite, high = -infinite;
      for_each_coefficient(t_, batch, s, [&](int unknown) { narrowest = std::min(narrowest, span_[unknown]); });
      for_each_coefficient(t_, batch, s, [&](int unknown) {
        if (span_[unknown] > wide * narrowest) return;  // the others are eliminated first
        low = std::min(low, key_[unknown]);
        high = std::max(high, key_[unknown]);
      });
      if (low > high) continue;  // touches no coefficient: stands in the border
      for (int o = 0; o < batch.outputs(); ++o) {
        items_.push_back({(low + high) / 2, true, batch.first_row + s * batch.outputs() + o});
      }
    }
  }

  void place_beside(const Batch& batch) {
    for (int s = 0; s < batch.samples(); ++s) {
      std::vector<int> columns;
      for_each_coefficient(t_, batch, s, [&](int unknown) { columns.push_back(out_.of_unknown[unknown]); });
      for (int o = 0; o < batch.outputs(); ++o) {
        beside_.push_back(batch.first_row + s * batch.outputs() + o);
        pattern_.column.insert(pattern_.column.end(), columns.begin(), columns.end());
        pattern_.start.push_back(static_cast<int>(pattern_.column.size()));
      }
    }
  }

  void place_border() {
    for (std::size_t k = 0; k < beside_.size(); ++k) out_.of_row[beside_[k]] = 0;  // below, behind the border
    for (const int unknown : out_.free) {
      if (out_.of_unknown[unknown] < 0) out_.of_unknown[unknown] = pattern_.n + pattern_.m++;
    }
    for (std::size_t r = 0; r < t_.rows.size(); ++r) {
      if (out_.of_row[r] < 0) out_.of_row[r] = pattern_.n + pattern_.m++;
    }
    if (pattern_.m > max_border) {
      throw InputError(std::to_string(pattern_.m) + " unknowns and rows couple distant times; at most " +
                       std::to_string(max_border) + " can be eliminated. Use fewer lifted functionals");
    }
    int position = pattern_.n + pattern_.m;
    for (const int row : beside_) out_.of_row[row] = position++;
  }

  // The first column in which each row of the band may have an entry.
  void find_profile() {
    profile_.resize(pattern_.n);
    for (int k = 0; k < pattern_.n; ++k) profile_[k] = k;
    std::vector<int> touched;
    for (const Batch& batch : t_.batches) {
      // Coefficients couple only where the program has second derivatives (a residual that is linear has none), or
      // where rows beside the band are eliminated.
      const bool couples = !batch.hessian.empty() || stands_beside(t_, batch);
      for (int s = 0; s < batch.samples(); ++s) {
        touched.clear();
        int low = pattern_.n;
        for_each_coefficient(t_, batch, s, [&](int unknown) {
          touched.push_back(out_.of_unknown[unknown]);
          low = std::min(low, touched.back());
        });
        if (couples) {
          for (const int k : touched) profile_[k] = std::min(profile_[k], low);
        }
        if (batch.summed() || stands_beside(t_, batch)) continue;
        for (int o = 0; o < batch.outputs(); ++o) {
          const int row = out_.of_row[batch.first_row + s * batch.outputs() + o];
          if (row >= pattern_.n) continue;
          profile_[row] = std::min(profile_[row], low);
          for (const int k : touched) profile_[k] = std::min(profile_[k], row);
        }
      }
    }
  }

  // The width that makes the factorisation cheapest; rows that reach further are long.
  void choose_long_rows() {
    const int n = pattern_.n;
    std::vector<int> lengths(n);
    for (int k = 0; k < n; ++k) lengths[k] = k - profile_[k];
    std::ranges::sort(lengths, std::greater<>{});
    double best = std::numeric_limits<double>::infinity(), far = 0;
    for (int longer = 0; longer < n; ++longer) {
      const int width = lengths[longer];
      if (longer == 0 || width < lengths[longer - 1]) {
        const double cost = (longer == 0 ? 1 : gain) * (n * (width + 1.0) + far) * (width + overhead);
        if (cost < best) {
          best = cost;
          pattern_.width = width;
        }
      }
      far += far_cost * width;
    }
    std::size_t offset = 0;
    for (int k = 0; k < n; ++k) {
      if (k - profile_[k] <= pattern_.width) continue;
      pattern_.long_rows.push_back({k, profile_[k], offset});
      offset += static_cast<std::size_t>(k - pattern_.width - profile_[k]);
    }
    if (static_cast<double>(n) * (pattern_.width + 1) + static_cast<double>(offset) > max_band) {
      throw InputError(
          fmt::format("the matrix of a step would have {} rows with {} entries each: too many instances stand "
                      "within a few knot spans. Use larger steps between instances, or fewer degrees of freedom",
                      n, pattern_.width + 1));
    }
  }

  const Transcription& t_;
  Layout out_;
  Pattern pattern_;
  std::vector<double> key_, span_;  // by unknown: where it stands, s; the widest knot span of its support, s
  std::vector<Item> items_;
  std::vector<int> beside_;   // rows
  std::vector<int> profile_;  // by position in the band
};

}  // namespace

Layout arrange(const Transcription& transcription) { return Arranger(transcription).run(); }

double most_length(const Transcription& t, const Layout& layout, const Eigen::VectorXd& direction) {
  constexpr double within = 1 - 1e-9;  // whatever adding it rounds to
  double most = std::numeric_limits<double>::infinity();
  for (const int u : layout.free) {
    const double change = std::abs(direction[layout.of_unknown[u]]);
    if (change * most > t.most_change[u]) most = within * t.most_change[u] / change;
  }
  return most;
}

}  // namespace spacetime::optimizer
