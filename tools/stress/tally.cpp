#include "tools/stress/tally.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace shaolin::stress {

const char* name_of(Fault fault) {
  switch (fault) {
    case Fault::lost:
      return "lost";
    case Fault::ghost:
      return "ghost";
    case Fault::duplicate:
      break;
  }
  return "duplicate";
}

void Tally::add(const Tally& other) {
  rays += other.rays;
  hits += other.hits;
  for (std::size_t i = 0; i < wrong.size(); ++i) wrong[i] += other.wrong[i];
  undecided += other.undecided;
  certified += other.certified;
  for (std::size_t i = 0; i < uncertified.size(); ++i) uncertified[i] += other.uncertified[i];
  worst_error = std::max(worst_error, other.worst_error);
  const std::size_t room = most_failures - std::min(most_failures, failures.size());
  const auto end = other.failures.begin() + static_cast<std::ptrdiff_t>(std::min(room, other.failures.size()));
  failures.insert(failures.end(), other.failures.begin(), end);
}

void Tally::fail(Failure failure) {
  ++wrong[static_cast<std::size_t>(failure.fault)];
  if (failures.size() < most_failures) failures.push_back(std::move(failure));
}

std::optional<double> Tally::uncertified_share() const {
  const std::size_t open = std::accumulate(uncertified.begin(), uncertified.end(), std::size_t{0});
  if (certified + open == 0) return {};
  return static_cast<double>(open) / static_cast<double>(certified + open);
}

}  // namespace shaolin::stress
