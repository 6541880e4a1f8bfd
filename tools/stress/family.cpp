#include "tools/stress/family.h"

#include <iterator>
#include <utility>

namespace shaolin::stress {

namespace {

using Draw = std::function<Probe(const Subject&, SampleRandom&)>;

class ProbeStage final : public Stage {
 public:
  ProbeStage(std::string family, std::vector<std::unique_ptr<const Subject>> subjects, Draw draw)
      : family_(std::move(family)), subjects_(std::move(subjects)), draw_(std::move(draw)) {}

  void shoot(SampleRandom& random, Tally& tally) const override {
    const Subject& subject = *pick(subjects_, random);
    Check(subject, family_, tally).ray(draw_(subject, random));
  }

 private:
  std::string family_;
  std::vector<std::unique_ptr<const Subject>> subjects_;
  Draw draw_;
};

}  // namespace

std::unique_ptr<const Stage> probe_stage(std::string family, std::vector<std::unique_ptr<const Subject>> subjects,
                                         Draw draw) {
  if (subjects.empty() || subjects.front()->sites().pieces.empty()) return nullptr;
  return std::make_unique<ProbeStage>(std::move(family), std::move(subjects), std::move(draw));
}

std::unique_ptr<const Stage> probe_stage(std::string family, std::unique_ptr<const Subject> subject, Draw draw) {
  std::vector<std::unique_ptr<const Subject>> subjects;
  subjects.push_back(std::move(subject));
  return probe_stage(std::move(family), std::move(subjects), std::move(draw));
}

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> result;
    for (auto* part : {aimed_families, parity_families, grazing_families, moved_families, watertight_families,
                       degenerate_families, invariance_families, spawned_families, bad_number_families}) {
      std::vector<Family> some = part();
      std::move(some.begin(), some.end(), std::back_inserter(result));
    }
    return result;
  }();
  return all;
}

}  // namespace shaolin::stress
