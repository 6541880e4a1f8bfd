#pragma once
/// The start patches of an object: each is made when a ray first needs it, and kept, as long as a budget lets, with the
/// tree that rays make of it.
#include <array>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "counters.h"
#include "patch_budget.h"
#include "tree_totals.h"

namespace shaolin {

/// StartPatch is a Finish's, see shaolin.h; they are numbered from 0. Their places come in blocks, made when the first
/// of a block is: what no ray needs costs an eighth of a byte. Thread-safe, but for resize().
template <class StartPatch>
class StartPatches final : private PatchBudget::Keeper {
 public:
  /// None. Without a budget none that is made is ever dropped.
  explicit StartPatches(std::shared_ptr<PatchBudget> budget = {})
      : budget_(std::move(budget)), totals_{ByteCount(budget_ ? &budget_->account() : nullptr)} {}
  ~StartPatches() {
    if (budget_) budget_->remove(*this);
    for (auto& block : blocks_) {
      const std::unique_ptr<Block> own(block.load());
      if (own)
        for (auto& slot : *own) delete slot.load();
    }
  }

  /// Room for so many, of which none is made yet.
  void resize(std::size_t count) {
    size_ = count;
    blocks_ = std::vector<std::atomic<Block*>>((count + block_size - 1) / block_size);
    if (!budget_) return;
    // Under a budget what comes and goes is to be trees alone.
    uses_ = std::vector<std::atomic<Use>>(count);
    for (std::size_t i = 0; i < count; i += block_size) slot(i);
  }

  std::size_t size() const { return size_; }

  /// Null: see shaolin.h.
  PatchBudget* budget() const { return budget_.get(); }

  /// Null if there is none at the moment. What there is stays until the PatchBudget::Query ends that this was asked in,
  /// and is to stay longer than what nobody asks for.
  const StartPatch* find(std::size_t number) {
    if (budget_) use(number);
    const Block* const block = blocks_[number / block_size].load(std::memory_order_acquire);
    return block ? (*block)[number % block_size].load(std::memory_order_acquire) : nullptr;
  }

  /// What another thread has kept in the meantime, or `made`, whose making is counted then.
  const StartPatch& keep(std::size_t number, std::unique_ptr<const StartPatch> made, const TreeTotals& making);

  /// Where what grows in trees is counted.
  TreeTotals& totals() { return totals_; }

  void add_to(Statistics& total) const {
    total.faces_touched += touched_;
    total.patches_split += totals_.patches_split;
    total.patches_evicted += evicted_;
    total.invalid_patches += totals_.invalid_patches;
    total.unresolved_patches += totals_.unresolved_patches;
    total.bytes += totals_.bytes + blocks_.size() * sizeof(blocks_[0]) + block_count_ * sizeof(Block) +
                   uses_.size() * sizeof(uses_[0]);
  }

 private:
  static constexpr std::size_t block_size = 64;
  using Block = std::array<std::atomic<const StartPatch*>, block_size>;

  enum class Use : std::uint8_t { never, before, now };

  /// Of a block that is there, or is made now.
  std::atomic<const StartPatch*>& slot(std::size_t number) {
    std::atomic<Block*>& place = blocks_[number / block_size];
    Block* block = place.load(std::memory_order_acquire);
    if (!block) {
      auto made = std::make_unique<Block>();
      if (place.compare_exchange_strong(block, made.get(), std::memory_order_acq_rel)) {
        block = made.release();
        ++block_count_;
      }
    }
    return (*block)[number % block_size];
  }

  /// Only what is made, so that keep() knows what was made before; and most are marked already.
  void use(std::size_t number) {
    if (uses_[number].load(std::memory_order_relaxed) == Use::before)
      uses_[number].store(Use::now, std::memory_order_relaxed);
  }

  bool was_used(std::size_t number) override {
    return uses_[number].exchange(Use::before, std::memory_order_relaxed) == Use::now;
  }
  std::uint64_t bytes(const void* tree) const override {
    const auto& start = *static_cast<const StartPatch*>(tree);
    return sizeof start + start.bytes() + start.grown_bytes();
  }
  const void* unlink(std::size_t number) override {
    ++evicted_;
    return slot(number).exchange(nullptr, std::memory_order_acq_rel);
  }
  void free(const void* tree) override {
    totals_.bytes -= bytes(tree);
    delete static_cast<const StartPatch*>(tree);
  }

  std::shared_ptr<PatchBudget> budget_;
  std::size_t size_ = 0;
  std::vector<std::atomic<Block*>> blocks_;
  std::vector<std::atomic<Use>> uses_;  ///< none without a budget
  TreeTotals totals_;
  std::atomic<std::uint64_t> block_count_{0}, touched_{0}, evicted_{0};
};

template <class StartPatch>
auto StartPatches<StartPatch>::keep(std::size_t number, std::unique_ptr<const StartPatch> made,
                                    const TreeTotals& making) -> const StartPatch& {
  const StartPatch* expected = nullptr;
  if (!slot(number).compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
  const StartPatch& kept = *made.release();
  totals_.bytes += sizeof kept + kept.bytes() + making.bytes;
  totals_.patches_split += making.patches_split;
  // What is made again is no other face, and overlaps itself as it did before.
  const bool is_new = !budget_ || uses_[number].exchange(Use::now, std::memory_order_relaxed) == Use::never;
  if (is_new) {
    ++touched_;
    totals_.invalid_patches += making.invalid_patches;
    totals_.unresolved_patches += making.unresolved_patches;
  }
  if (budget_) budget_->add(*this, number);
  return kept;
}

}  // namespace shaolin
