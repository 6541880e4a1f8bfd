#include "tools/stress/run.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "tools/cli/render_stats.h"
#include "tools/stress/bad_numbers.h"

namespace shaolin::stress {

namespace {

/// Rays that share one sequence of random numbers: what a thread takes at a time.
constexpr std::size_t block = 64;

/// FNV-1a; the standard's hash differs from library to library.
std::uint64_t hash_of(const std::string& text, std::uint64_t hash) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// Of the block's own, so that its rays are the same whoever throws them and whatever else is thrown.
SampleRandom random_of(std::uint64_t seed, const Row& row, std::size_t number) {
  const std::uint64_t start = 0xcbf29ce484222325 ^ (seed * 0x9e3779b97f4a7c15);
  return SampleRandom(hash_of(row.family + '/' + row.model + '/' + std::to_string(number), start));
}

struct Job {
  const Family* family;
  StressModel model;
  Row row;
};

std::vector<Job> jobs_of(const RunOptions& options) {
  std::vector<Job> jobs;
  for (const Family& family : families()) {
    const auto& wanted = options.families;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), family.name) == wanted.end()) continue;
    for (const StressModel& model : family.own_models ? family.own_models() : options.models)
      jobs.push_back({&family, model, {family.name, model.name, {}, 0}});
  }
  return jobs;
}

/// Rays `begin` (of a multiple of `block`) to `end` of a job. False if it has nothing to aim at.
bool throw_rays(Job& job, const RunOptions& options, std::size_t begin, std::size_t end) {
  Stopwatch stopwatch;
  const QueriesOf queries_of = options.peers && !job.model.masks
                                   ? options.peers->beside(options.queries_of, job.family->name, job.model.scheme)
                                   : options.queries_of;
  const std::unique_ptr<const Stage> stage = job.family->stage(job.model, queries_of);
  if (!stage) return false;
  const std::size_t first = begin / block, blocks = (end + block - 1) / block - first;
  std::vector<Tally> tallies(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t i) {
    SampleRandom random = random_of(options.seed, job.row, first + i);
    const std::size_t from = (first + i) * block, to = std::min(end, from + block);
    tallies[i].rays = to - from;
    for (std::size_t ray = from; ray < to; ++ray) stage->shoot(random, tallies[i]);
  });
  for (const Tally& tally : tallies) job.row.tally.add(tally);
  job.row.seconds += stopwatch.lap();
  return true;
}

/// How many rays the next round ends at: as many again, or what the last round's speed lets into nine tenths of the
/// time that is left; whole blocks.
std::size_t next_end(const RunOptions& options, std::size_t done, std::size_t last, double seconds, double elapsed) {
  if (options.minutes <= 0) return options.rays;
  if (done == 0) return block;
  const double left = 0.9 * (60 * options.minutes - elapsed);
  const double most = left > 0 ? left * static_cast<double>(last) / seconds : 0;
  const std::size_t more = most < static_cast<double>(done) ? static_cast<std::size_t>(most) : done;
  return done + more / block * block;
}

}  // namespace

std::vector<Row> Result::by_family() const {
  std::vector<Row> sums;
  for (const Row& row : rows) {
    if (sums.empty() || sums.back().family != row.family) sums.push_back({row.family, {}, {}, 0});
    sums.back().tally.add(row.tally);
    sums.back().seconds += row.seconds;
  }
  return sums;
}

Tally Result::total() const {
  Tally sum;
  for (const Row& row : rows) sum.add(row.tally);
  return sum;
}

Result run(const RunOptions& options, const std::function<void(std::size_t)>& progress) {
  std::vector<Job> jobs = jobs_of(options);
  Result result;
  Stopwatch whole, round;
  std::size_t last = 0;
  double seconds = 0;
  for (;;) {
    const std::size_t end = next_end(options, result.rays, last, seconds, result.seconds);
    if (end <= result.rays) break;
    std::erase_if(jobs, [&](Job& job) { return !throw_rays(job, options, result.rays, end); });
    last = end - result.rays;
    result.rays = end;
    seconds = round.lap();
    result.seconds += seconds;
    if (progress) progress(result.rays);
  }
  for (Job& job : jobs) result.rows.push_back(std::move(job.row));
  const bool has_bad =
      std::any_of(result.rows.begin(), result.rows.end(), [](const Row& row) { return row.family == "bad numbers"; });
  if (has_bad) result.slowdown = bad_number_slowdown(options.queries_of);
  return result;
}

}  // namespace shaolin::stress
