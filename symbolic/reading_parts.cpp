#include "symbolic/reading_parts.h"

#include <algorithm>

#include "symbolic/written_number.h"

namespace spacetime::symbolic {
namespace {

using Kind = Reading::Kind;

constexpr int short_enough = 12;    // characters; shorter than that is quicker read than looked up
constexpr int long_enough = 240;    // characters; about three lines
constexpr int deepest_reading = 8;  // brackets in brackets

// Items from operands to what they are operands of, as a reader meets them.
std::vector<std::size_t> in_order(const Reading& reading) {
  std::vector<std::size_t> out;
  std::vector<std::uint8_t> seen(reading.items.size());
  std::vector<std::pair<std::size_t, std::size_t>> stack;  // item, its next operand
  for (const std::size_t root : reading.roots) {
    if (seen[root]) continue;
    seen[root] = 1;
    stack.emplace_back(root, 0);
    while (!stack.empty()) {
      auto& [item, next] = stack.back();
      const auto& operands = reading.items[item].operands;
      if (next == operands.size()) {
        out.push_back(item);
        stack.pop_back();
        continue;
      }
      const std::size_t operand = operands[next++].item;
      if (seen[operand]) continue;
      seen[operand] = 1;
      stack.emplace_back(operand, 0);
    }
  }
  return out;
}

}  // namespace

void choose_parts(Reading& reading) {
  reading.order = in_order(reading);
  const std::vector<std::size_t>& order = reading.order;
  std::vector<int> uses(reading.items.size()), length(reading.items.size()), depth(reading.items.size());
  for (const std::size_t root : reading.roots) ++uses[root];
  for (const std::size_t item : order)
    for (const Reading::Operand& operand : reading.items[item].operands) ++uses[operand.item];
  reading.part_number.assign(reading.items.size(), -1);
  for (const std::size_t i : order) {
    const Reading::Item& item = reading.items[i];
    length[i] = static_cast<int>(item.name.size());
    if (item.kind == Kind::number || item.kind == Kind::pi) length[i] = static_cast<int>(written(item.number).size());
    if (item.kind == Kind::input) length[i] += static_cast<int>(item.number);
    for (const Reading::Operand& operand : item.operands) {
      length[i] = std::min(length[i] + length[operand.item] + 2, 1 << 20);
      depth[i] = std::max(depth[i], depth[operand.item] + (is_leaf(reading.items[operand.item].kind) ? 0 : 1));
    }
    if (is_leaf(item.kind) || is_condition(item.kind)) continue;
    const bool is_root = std::ranges::find(reading.roots, i) != reading.roots.end();
    const bool of_parts =
        (item.kind == Kind::sum || item.kind == Kind::product) &&
        std::ranges::any_of(item.operands, [&](const auto& operand) { return reading.is_part(operand.item); });
    const bool shared = uses[i] > 1 && (length[i] > short_enough || of_parts);
    const bool large = !is_root && (length[i] > long_enough || depth[i] > deepest_reading);
    if (!shared && !large) continue;
    reading.part_number[i] = static_cast<int>(reading.parts.size());
    reading.parts.push_back(i);
    length[i] = 3;
    depth[i] = 0;
  }
}

}  // namespace spacetime::symbolic
