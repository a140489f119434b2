#include "protocol/memory.h"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <utility>

namespace spacetime::protocol {
namespace {

// Before each allocation: who pays, and how much.  As wide as the strictest alignment that plain new promises.
struct alignas(__STDCPP_DEFAULT_NEW_ALIGNMENT__) Tag {
  Account* account;
  std::size_t bytes;
};

// Small allocations may go beyond the limit by so much: those that a session makes outside of requests.
constexpr std::ptrdiff_t reserve = 1 << 20;
constexpr std::size_t small = 4096;

thread_local Account* paying = nullptr;

// What a session's thread has allocated may be freed after its end, so accounts are used again, never destroyed.
struct Book {
  std::mutex mutex;
  std::deque<Account> accounts;
  std::deque<Account*> closed;
};
Book& book() {
  static Book& it = *new Book;
  return it;
}

Account& opened(double most_bytes) {
  const std::lock_guard lock(book().mutex);
  auto& closed = book().closed;
  const auto found = std::ranges::find_if(closed, [](const Account* account) { return account->used == 0; });
  Account& account = found == closed.end() ? book().accounts.emplace_back() : **found;
  if (found != closed.end()) closed.erase(found);
  account.most = static_cast<std::ptrdiff_t>(most_bytes);
  return account;
}

void* allocate(std::size_t bytes) {
  Account* const account = paying;
  if (account) {
    const auto more = static_cast<std::ptrdiff_t>(bytes);
    const auto most = account->most + (bytes < small ? reserve : 0);
    if (account->used.fetch_add(more, std::memory_order_relaxed) > most - more) {
      account->used.fetch_sub(more, std::memory_order_relaxed);
      throw AccountExceeded();
    }
  }
  auto* const tag = static_cast<Tag*>(std::malloc(sizeof(Tag) + bytes));
  if (!tag) {
    if (account) account->used.fetch_sub(static_cast<std::ptrdiff_t>(bytes), std::memory_order_relaxed);
    throw std::bad_alloc();
  }
  *tag = {account, bytes};
  return tag + 1;
}

void release(void* memory) noexcept {
  if (!memory) return;
  Tag* const tag = static_cast<Tag*>(memory) - 1;
  if (tag->account) {
    tag->account->used.fetch_sub(static_cast<std::ptrdiff_t>(tag->bytes), std::memory_order_relaxed);
  }
  std::free(tag);
}

}  // namespace

Accounting::Accounting(double most_bytes) : account_(opened(most_bytes)) { paying = &account_; }

Accounting::~Accounting() {
  paying = nullptr;
  const std::lock_guard lock(book().mutex);
  book().closed.push_back(&account_);
}

Account* account_of_thread() { return paying; }

Sharing::Sharing(Account* account) : before_(std::exchange(paying, account)) {}
Sharing::~Sharing() { paying = before_; }

}  // namespace spacetime::protocol

void* operator new(std::size_t bytes) { return spacetime::protocol::allocate(bytes); }
void* operator new[](std::size_t bytes) { return spacetime::protocol::allocate(bytes); }
void operator delete(void* memory) noexcept { spacetime::protocol::release(memory); }
void operator delete[](void* memory) noexcept { spacetime::protocol::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { spacetime::protocol::release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { spacetime::protocol::release(memory); }

// Sanitizers bring their own of these, which would not know our tags.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return spacetime::protocol::allocate(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t bytes, const std::nothrow_t& no_throw) noexcept {
  return operator new(bytes, no_throw);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept { spacetime::protocol::release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { spacetime::protocol::release(memory); }
