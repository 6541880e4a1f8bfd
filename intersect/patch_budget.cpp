#include "patch_budget.h"

#include <thread>

#include "../schemes/errors.h"

namespace shaolin {

PatchBudget::PatchBudget(std::uint64_t bytes) : bytes_(bytes) {
  if (bytes == 0) throw InputError("a memory budget of 0 bytes is out of range; expected 1 or more");
}

void PatchBudget::add(Keeper& keeper, std::size_t tree) {
  const std::scoped_lock lock(mutex_);
  linked_.push_back({&keeper, tree});
}

void PatchBudget::remove(const Keeper& keeper) {
  const std::scoped_lock lock(mutex_);
  linked_.remove_if([&](const Tree& tree) { return tree.keeper == &keeper; });
  for (auto tree = unlinked_.begin(); tree != unlinked_.end();) {
    const auto next = std::next(tree);
    if (tree->keeper == &keeper) free(tree);
    tree = next;
  }
}

void PatchBudget::Query::end() {
  const bool may_wait = guard_->is_outermost();  // not for itself
  guard_.reset();
  // Either who evicts at the same time sees that this query is done, or this sees what that one found too much.
  std::atomic_thread_fence(std::memory_order_seq_cst);
  // A thread that sleeps in a query holds up what others free; they let it run rather than make more.
  while (budget_->held() > budget_->bytes_ && !budget_->evict() && may_wait) std::this_thread::yield();
}

/// The last of the queries that end while there is too much finds all others done, and frees what they left.
bool PatchBudget::evict() {
  const std::scoped_lock lock(mutex_);
  // Up to what trees grow by at the moment, for which the queries that do it come here again.
  const auto is_too_much = [&] { return held() > bytes_ + unlinked_bytes_; };
  for (std::size_t chances = linked_.size(); !linked_.empty() && is_too_much();) {
    const auto next = linked_.begin();
    if (chances > 0 && next->keeper->was_used(next->number)) {
      --chances;
      linked_.splice(linked_.end(), linked_, next);
    } else {
      unlink(next);
    }
  }
  const std::uint64_t oldest = oldest_epoch();
  while (!unlinked_.empty() && unlinked_.front().epoch < oldest) free(unlinked_.begin());
  return unlinked_bytes_ <= bytes_;
}

void PatchBudget::unlink(Trees::iterator tree) {
  tree->unlinked = tree->keeper->unlink(tree->number);
  tree->bytes = tree->keeper->bytes(tree->unlinked);
  tree->epoch = end_epoch();
  unlinked_bytes_ += tree->bytes;
  unlinked_.splice(unlinked_.end(), linked_, tree);
}

void PatchBudget::free(Trees::iterator tree) {
  unlinked_bytes_ -= tree->bytes;
  tree->keeper->free(tree->unlinked);
  unlinked_.erase(tree);
}

}  // namespace shaolin
