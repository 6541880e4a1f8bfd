#include "epochs.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace shaolin {

namespace {

constexpr std::uint64_t idle = std::numeric_limits<std::uint64_t>::max();

/// A thread's announcement, on a cache line of its own. Lines are passed on from threads that end, and never freed: a
/// reader of the list may be anywhere in it.
struct alignas(64) Announcement {
  std::atomic<std::uint64_t> epoch{idle};  ///< in which its reader began
  std::atomic<bool> is_owned{true};
  Announcement* next = nullptr;
};

constinit std::atomic<std::uint64_t> current_epoch{0};
constinit std::atomic<Announcement*> announcements{nullptr};

Announcement& find_announcement() {
  for (Announcement* one = announcements.load(std::memory_order_acquire); one; one = one->next)
    if (!one->is_owned.load(std::memory_order_relaxed) && !one->is_owned.exchange(true, std::memory_order_acquire))
      return *one;
  auto* const made = new Announcement;
  made->next = announcements.load(std::memory_order_relaxed);
  while (!announcements.compare_exchange_weak(made->next, made, std::memory_order_release, std::memory_order_relaxed)) {
  }
  return *made;
}

struct Owner {
  Announcement& announcement = find_announcement();
  ~Owner() { announcement.is_owned.store(false, std::memory_order_release); }
};

Announcement& own_announcement() {
  thread_local const Owner owner;
  return owner.announcement;
}

}  // namespace

/// Of the fences here and in oldest_epoch() one comes first. If it is this one, the announcement is seen there. If it
/// is the other, what was unlinked before that is unlinked for all loads after this.
EpochGuard::EpochGuard() {
  std::atomic<std::uint64_t>& epoch = own_announcement().epoch;
  is_outermost_ = epoch.load(std::memory_order_relaxed) == idle;
  if (!is_outermost_) return;
  epoch.store(current_epoch.load(std::memory_order_acquire), std::memory_order_release);
  std::atomic_thread_fence(std::memory_order_seq_cst);
}

EpochGuard::~EpochGuard() {
  if (is_outermost_) own_announcement().epoch.store(idle, std::memory_order_release);
}

std::uint64_t end_epoch() { return current_epoch.fetch_add(1, std::memory_order_acq_rel); }

std::uint64_t oldest_epoch() {
  std::atomic_thread_fence(std::memory_order_seq_cst);
  std::uint64_t oldest = idle;
  for (const Announcement* one = announcements.load(std::memory_order_acquire); one; one = one->next)
    oldest = std::min(oldest, one->epoch.load(std::memory_order_acquire));
  return oldest;
}

}  // namespace shaolin
