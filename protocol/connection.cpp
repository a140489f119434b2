#include "protocol/connection.h"

#include <algorithm>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>

#include "common/diagnostic.h"

namespace spacetime::protocol {
namespace {

// Progress is for eyes: more than the fastest screens show is waste.
constexpr std::chrono::microseconds between_progress{1'000'000 / 120};

// A session whose peer has not taken so many bytes of answers does no more work until it has.
constexpr std::size_t most_unsent_bytes = std::size_t{4} << 20;

constexpr std::chrono::milliseconds look_again{10};  // where reading waits for room
constexpr std::chrono::seconds stall_patience{60};   // for the next byte of a message that has begun
constexpr std::chrono::seconds refusal_patience{5};  // for a peer that has no session to say something and go

}  // namespace

Connection::Connection(boost::asio::io_context& context, std::unique_ptr<Stream> stream, const Service* service,
                       const Allowance& allowance, Events events)
    : context_(context),
      stream_(std::move(stream)),
      allowance_(allowance),
      events_(std::move(events)),
      reader_(static_cast<std::size_t>(service ? allowance.message : 4096)),
      resume_(context),
      pace_(context),
      watch_(context),
      last_message_(Clock::now()),
      last_byte_(last_message_),
      last_written_(last_message_),
      unsent_(most_unsent_bytes) {
  if (service) conversation_.emplace(*service, allowance, *this);
}

void Connection::start() {
  read();
  watch();
}

void Connection::finish() {
  reading_ends_ = true;
  if (conversation_) return conversation_->hang_up();
  ended();
}

void Connection::cut() {
  broken_ = true;
  stream_->close();
  pace_.cancel();
  resume_.cancel();
  finish();
  const std::lock_guard lock(mutex_);
  forget();
}

// What nobody will read.
void Connection::forget() {
  for (const Outgoing& outgoing : queue_) unsent_.take_off(outgoing.bytes);
  queue_.clear();
  newest_ = {};
}

void Connection::read() {
  if (broken_ || reading_ends_) return;
  if (too_much_waits()) {
    resume_.expires_after(look_again);
    resume_.async_wait([self = shared_from_this()](boost::system::error_code stopped) {
      if (!stopped) self->read();
    });
    return;
  }
  stream_->read_some(block_, [self = shared_from_this()](boost::system::error_code error, std::size_t bytes) {
    if (self->gone_) return;  // parting ends the read, and must not cut what was written before it
    if (!error) return self->take({self->block_.data(), bytes});
    if (!self->conversation_) {
      self->reading_ends_ = true;
      return self->ended();
    }
    if (error != boost::asio::error::eof) return self->cut();
    // Whoever has only closed its sending side still reads the answers.
    if (auto frame = self->reader_.last(); frame && !self->reading_ends_) self->pass(std::move(*frame));
    self->reading_ends_ = true;
    self->conversation_->end_of_input();
  });
}

bool Connection::too_much_waits() const {
  return full() || (conversation_ && static_cast<double>(conversation_->waiting_bytes()) > allowance_.message);
}

void Connection::take(std::string_view bytes) {
  last_byte_ = Clock::now();
  reader_.add(bytes);
  while (auto frame = reader_.next()) {
    if (reading_ends_) return;
    last_message_ = Clock::now();
    reading_ends_ = frame->ends;
    if (!conversation_) return refuse(*frame);
    pass(std::move(*frame));
  }
  read();
}

void Connection::pass(Frame frame) {
  if (events_.passed) events_.passed(frame.text, true);
  conversation_->receive(std::move(frame));
}

void Connection::refuse(const Frame& frame) {
  std::optional<std::string> id;
  try {
    if (frame.kind == Frame::Kind::message) read_request(frame.text, static_cast<std::size_t>(allowance_.depth), id);
  } catch (const Error&) {
    // Whatever it was, it is not served.
  }
  send(answer(id, beyond("sessions", allowance_, allowance_.sessions + 1)));
  reading_ends_ = true;
  ended();
}

void Connection::send(std::string message) {
  {
    const std::lock_guard lock(mutex_);
    if (newest_) queue_.push_back({std::exchange(newest_, {}), 0});
    const std::size_t bytes = message.size();
    queue_.push_back({[message = std::move(message)]() mutable { return std::move(message); }, bytes});
    unsent_.add(bytes);
  }
  wake();
}

void Connection::offer(std::function<std::string()> message) {
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    first = !newest_;
    newest_.swap(message);  // what it takes the place of is let go of without the lock
  }
  if (first) wake();  // else write() is to come already: after a wake, a write or the pace
}

bool Connection::full() const { return unsent_.full(); }

void Connection::ended() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  wake();
}

// Has write() called in the io_context's thread, once however often it is asked for.
void Connection::wake() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(wake_coming_, true)) return;
  }
  auto alive = weak_from_this().lock();  // the session's thread says its last word while this is being destroyed
  if (!alive) return;
  boost::asio::post(context_, [self = std::move(alive)] {
    {
      const std::lock_guard lock(self->mutex_);
      self->wake_coming_ = false;
    }
    self->write();
  });
}

void Connection::write() {
  if (writing_ || gone_) return;
  Outgoing next;
  bool over = false;
  {
    const std::lock_guard lock(mutex_);
    if (broken_) forget();
    if (!queue_.empty()) {
      next = std::move(queue_.front());
      queue_.pop_front();
    } else if (newest_) {
      const auto due = last_progress_ + between_progress;
      if (Clock::now() >= due || ended_) {
        next = {std::exchange(newest_, {}), 0};
        last_progress_ = Clock::now();
      } else {
        pace_.expires_at(due);
        pace_.async_wait([self = shared_from_this()](boost::system::error_code stopped) {
          if (!stopped) self->write();
        });
      }
    }
    over = !next.write && !newest_ && ended_;
  }
  if (over) {
    gone_ = true;
    broken_ ? stream_->close() : stream_->part();
    watch_.cancel();
    resume_.cancel();
    pace_.cancel();
    if (events_.gone) events_.gone();
    return;
  }
  if (!next.write) return;
  std::string message;
  try {
    message = next.write();
  } catch (const InputError&) {  // progress with numbers that no message can hold
    return write();
  }
  if (events_.passed) events_.passed(message, false);
  // Before the peer's first byte its framing is not known; only an end without any message comes so early.
  outgoing_ = framed(std::move(message), reader_.framing());
  writing_ = true;
  last_written_ = Clock::now();
  stream_->write_all(outgoing_,
                     [self = shared_from_this(), bytes = next.bytes](boost::system::error_code error, std::size_t) {
                       if (self->unsent_.take_off(bytes) && self->conversation_) self->conversation_->drained();
                       self->written(error);
                     });
}

void Connection::written(boost::system::error_code error) {
  writing_ = false;
  last_written_ = Clock::now();
  outgoing_.clear();
  if (outgoing_.capacity() > most_unsent_bytes) outgoing_ = {};
  if (error && !broken_) cut();
  write();
}

// Why it ends, where the peer has had nothing to say for too long, or has stopped inside a message.
std::optional<Error> Connection::too_quiet(Clock::time_point now) const {
  if (reading_ends_ || (conversation_ && conversation_->busy())) return std::nullopt;
  const std::chrono::duration<double> allowed(conversation_ ? allowance_.idle : refusal_patience.count());
  const auto patience = std::min<std::chrono::duration<double>>(allowed, stall_patience);
  if (reader_.begun() > 0 && now - last_byte_ > patience) {
    return Error(Code::idle, "a message has stopped half-way, after " + std::to_string(reader_.begun()) +
                                 " bytes, and nothing more of it came for " + amount(patience.count()) + " seconds");
  }
  if (now - std::max(last_message_, last_written_) <= allowed) return std::nullopt;
  if (!conversation_) return beyond("sessions", allowance_, allowance_.sessions + 1);
  return beyond("idle", allowance_, allowance_.idle);
}

// Ends a connection on which nothing has happened for too long, now and then.
void Connection::watch() {
  const auto soon = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(allowance_.idle / 2));
  watch_.expires_after(std::clamp<Clock::duration>(soon, look_again, refusal_patience));
  watch_.async_wait([self = shared_from_this()](boost::system::error_code stopped) {
    if (stopped || self->gone_) return;
    const auto now = Clock::now();
    if (self->writing_ && now - self->last_written_ > std::chrono::duration<double>(self->allowance_.idle)) {
      return self->cut();
    }
    if (const auto error = self->too_quiet(now)) {
      self->send(answer(std::nullopt, *error));
      return self->finish();
    }
    self->watch();
  });
}

}  // namespace spacetime::protocol
