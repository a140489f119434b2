// Writes JSON text from top to bottom, without a tree in between.  Members stand in the order they are written, so
// that "format" can come first.  What it cannot write is what no reader may see: a number that is not finite, or text
// that is not UTF-8; both throw InputError.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/assert.h"

namespace spacetime {

// How the elements of an object or list are set: one after the other, or each on a line of its own.
enum class Set { in_line, in_lines };

class Writer {
 public:
  // `broken` false writes all in one line, as a message needs it.
  explicit Writer(bool broken = true) : broken_(broken) {}

  // body() writes the members (member or key) or elements.
  template <class Body>
  void object(Body body, Set set = Set::in_line) {
    open('{', set);
    body();
    close('}');
  }
  template <class Body>
  void list(Body body, Set set = Set::in_line) {
    open('[', set);
    body();
    close(']');
  }
  // element(x) writes each x of a range.
  template <class Range, class Element>
  void list_of(const Range& range, Element element, Set set = Set::in_line) {
    list(
        [&] {
          for (const auto& x : range) element(x);
        },
        set);
  }

  void key(std::string_view name);
  void number(double value);  // the fewest digits that read back as the same bits
  void integer(std::int64_t value);
  void string(std::string_view value);
  void boolean(bool value);
  void null();
  void json(std::string_view text);  // a value that is already written
  void numbers(std::span<const double> values);
  void integers(std::span<const std::int32_t> values);

  // key and value in one.
  void member(std::string_view name, double value) { key(name), number(value); }
  void member(std::string_view name, int value) { key(name), integer(value); }
  void member(std::string_view name, bool value) { key(name), boolean(value); }
  void member(std::string_view name, std::string_view value) { key(name), string(value); }
  void member(std::string_view name, const char* value) { key(name), string(value); }

  // An enumeration's value by its name; `names` in the enumeration's order.
  template <class Enumeration>
  void choice(std::string_view name, std::span<const std::string_view> names, Enumeration value) {
    const auto index = static_cast<std::size_t>(value);
    SPACETIME_ASSERT(index < names.size());
    member(name, names[index]);
  }

  // The text; with a line's end behind it where it is broken into lines.
  std::string take();

 private:
  void open(char bracket, Set set);
  void close(char bracket);
  void separate();  // before an element or a key
  void next_line();

  struct Level {
    bool lines = false;  // one element a line
    bool empty = true;
  };
  std::string text_;
  std::string key_;  // the last, for errors
  std::vector<Level> levels_;
  bool after_key_ = false;
  bool broken_;
};

}  // namespace spacetime
