#pragma once
/// A bound on the memory of what rays refine, for any number of objects together.
#include <atomic>
#include <cstdint>
#include <list>
#include <mutex>
#include <optional>

#include "epochs.h"

namespace shaolin {

/// How many bytes the start patches of objects and the trees that rays make of them may hold: SceneOptions::budget.
/// When they hold more, whole trees are dropped, those first that no ray has come by for the longest (by the
/// second-chance rule), and made anew when a ray needs them again. So a small budget costs time; answers are the same
/// bit for bit.
///
/// When no query is underway, the budget is kept. Those that are may hold more: each what it meets itself; and what is
/// dropped is freed only once no query is underway that may be in it, of which there is as much again as the budget at
/// most, for a query that ends and finds more waits until it is less. Hierarchies, meshes and the lists that say which
/// trees there are (some 80 bytes each) do not count. Thread-safe.
class PatchBudget {
 public:
  /// Throws InputError if it is 0.
  explicit PatchBudget(std::uint64_t bytes);

  std::uint64_t bytes() const { return bytes_; }

  /// What trees hold now, including those that are dropped but still in use.
  std::uint64_t held() const { return held_.load(std::memory_order_relaxed); }

  /// Who keeps trees, numbered from 0: the start patches of an object.
  class Keeper {
   public:
    /// True if a ray came by since this was last asked.
    virtual bool was_used(std::size_t tree) = 0;
    /// The bytes of all that there is of a tree so far.
    virtual std::uint64_t bytes(const void* tree) const = 0;
    /// Takes a tree from where queries find it.
    virtual const void* unlink(std::size_t tree) = 0;
    /// Frees what was unlinked, and takes it off its account.
    virtual void free(const void* tree) = 0;

   protected:
    ~Keeper() = default;
  };

  /// For keepers: the account that their trees' bytes go to.
  std::atomic<std::uint64_t>& account() { return held_; }
  /// From now on a tree, whose bytes are on the account, may be evicted. O(1).
  void add(Keeper& keeper, std::size_t tree);
  /// Forgets a keeper, of which no query is underway; frees what is unlinked of it. O(trees under the budget).
  void remove(const Keeper& keeper);

  /// Spans a query: all that it finds stays until this is destroyed, which then evicts if there is more than the
  /// budget. Without a budget it does nothing.
  class Query {
   public:
    explicit Query(PatchBudget* budget) : budget_(budget) {
      if (budget_) guard_.emplace();
    }
    ~Query() {
      if (budget_) end();
    }
    Query(const Query&) = delete;
    Query& operator=(const Query&) = delete;

   private:
    void end();

    PatchBudget* budget_;
    std::optional<EpochGuard> guard_;
  };

 private:
  struct Tree {
    Keeper* keeper;
    std::size_t number;
    // Once it is unlinked:
    const void* unlinked = nullptr;
    std::uint64_t bytes = 0;  ///< that it had then; it may have grown since
    std::uint64_t epoch = 0;  ///< which ended then
  };
  using Trees = std::list<Tree>;  // moves from list to list without allocation: eviction cannot fail

  /// False if too much waits for queries that are underway.
  bool evict();
  void unlink(Trees::iterator tree);
  void free(Trees::iterator tree);

  std::uint64_t bytes_;
  std::atomic<std::uint64_t> held_{0};
  std::mutex mutex_;  ///< of what follows
  Trees linked_;      ///< from the one that is looked at next
  Trees unlinked_;    ///< in the order of their epochs
  std::uint64_t unlinked_bytes_ = 0;
};

}  // namespace shaolin
