#include "optimizer/gradients.h"

#include <algorithm>

namespace spacetime::optimizer {

std::vector<Gradient> gradients(const Transcription& t, const Layout& layout, const BorderedMatrix& jacobian) {
  std::vector<int> row_at(layout.size(), -1);
  for (std::size_t r = 0; r < t.rows.size(); ++r) row_at[layout.of_row[r]] = static_cast<int>(r);
  std::vector<Gradient> result(t.rows.size());
  for_each_entry(jacobian, [&](int i, int j, double value) {
    if (value == 0) return;
    if (row_at[i] >= 0) {
      result[row_at[i]].emplace_back(j, value);
    } else if (row_at[j] >= 0) {
      result[row_at[j]].emplace_back(i, value);
    }
  });
  for (Gradient& gradient : result) std::ranges::sort(gradient);
  return result;
}

double dot(const Gradient& a, const Gradient& b) {
  double sum = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (i->first == j->first) sum += i->second * j->second;
    const bool forward = i->first <= j->first, other = j->first <= i->first;
    i += forward;
    j += other;
  }
  return sum;
}

}  // namespace spacetime::optimizer
