#pragma once
/// The same rays asked of peers: Embree's triangles and subdivision, robust, and CGAL's tree over triangles.
#include <array>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "tools/bench/text_table.h"
#include "tools/stress/subject.h"

namespace shaolin::stress {

/// Counts, by family, what peers make of the rays whose closest hit a run asks for, against its own answer. What they
/// lose or make up at outlines, where triangles lie beside the limit, is no fault of their queries, but is what a user
/// sees. A peer that does not take a subject, or whose scheme it is not, is not asked there; nor is any asked rays
/// whose numbers single precision does not have, and CGAL's tree those that do not begin at their origin.
class Peers {
 public:
  /// The level of tessellations and of Embree's subdivision.
  explicit Peers(int level) : level_(level) {}

  /// The queries that `own` makes of a scene; closest hits are compared with those of peers, which are built from its
  /// surface and live as long. Whatever it makes must not outlive this.
  QueriesOf beside(QueriesOf own, std::string family, std::string scheme);

  /// A row for each family and peer: rays, hits of our own, and rays that a peer loses, makes up, or meets more than a
  /// hundredth of the diagonal from there.
  TextTable table() const;

 private:
  struct Count {
    std::size_t rays = 0, hits = 0, lost = 0, ghosts = 0, astray = 0;
  };
  void add(const std::string& family, const std::string& peer, const std::optional<double>& own,
           const std::optional<double>& theirs, double far_off);

  int level_;
  mutable std::mutex mutex_;
  std::vector<std::string> families_;  ///< in the order they came
  std::map<std::pair<std::string, std::string>, Count> counts_;
};

}  // namespace shaolin::stress
