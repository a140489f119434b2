// How much memory each session holds, and an end to it: whoever links this has its operator new count for the account
// of the thread that allocates.  What Eigen takes for its matrices by malloc is not counted; the limit of unknowns
// bounds that.
#pragma once

#include <atomic>
#include <cstddef>
#include <new>

namespace spacetime::protocol {

struct Account {
  std::atomic<std::ptrdiff_t> used{0};  // bytes that were allocated for it and not freed yet, by whomever
  std::ptrdiff_t most = 0;
};

// Thrown by operator new where an account would be exceeded.
class AccountExceeded : public std::bad_alloc {
 public:
  const char* what() const noexcept override { return "more memory than this session may hold"; }
};

// As long as it lives, its thread allocates for an account of its own.
class Accounting {
 public:
  explicit Accounting(double most_bytes);
  ~Accounting();
  Accounting(const Accounting&) = delete;
  Accounting& operator=(const Accounting&) = delete;

 private:
  Account& account_;
};

// The account for which this thread allocates; null where it is nobody's.
Account* account_of_thread();

// As long as it lives, its thread allocates for another's account.  What Accounting opened that one must live longer.
class Sharing {
 public:
  explicit Sharing(Account* account);
  ~Sharing();
  Sharing(const Sharing&) = delete;
  Sharing& operator=(const Sharing&) = delete;

 private:
  Account* before_;
};

// As long as it lives, its thread allocates for nobody: so that whoever is told of an exceeded account is told.
class Unpaid : Sharing {
 public:
  Unpaid() : Sharing(nullptr) {}
};

}  // namespace spacetime::protocol
