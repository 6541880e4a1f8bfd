/// Prints how many configurations meshes have, how long they take and what they occupy: shaolin_bench_configurations
/// MODEL...
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <set>
#include <vector>

#include "schemes/builtin.h"
#include "schemes/errors.h"
#include "schemes/limit_surface.h"
#include "schemes/obj.h"
#include "schemes/subdivision_mesh.h"

namespace shaolin {
namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// What one run found: all configurations that patches of any level can have.
struct Figures {
  std::size_t of_faces, all;
  double match_ms, split_ms;  ///< to find those of the faces; to find all others and to compile their splits
  double bytes;               ///< of the heap, for all of them and their splits
};

template <Scheme S>
Figures measure(const ControlMesh& control, const S& scheme) {
  const SubdivisionMesh<S> mesh(control, scheme);
  const std::size_t before = mallinfo2().uordblks;
  std::set<const Configuration<S>*> known;
  auto start = std::chrono::steady_clock::now();
  for (const int face : mesh.faces())
    if (mesh.has_limit(face))
      known.insert(mesh.table().match(mesh.neighbourhood({face, 0}, mesh.rules().radius())).configuration);
  Figures figures{known.size(), 0, milliseconds_since(start), 0, 0};
  std::vector<const Configuration<S>*> open(known.begin(), known.end());
  start = std::chrono::steady_clock::now();
  while (!open.empty()) {
    const Configuration<S>* next = open.back();
    open.pop_back();
    for (const auto& child : next->split().children)
      if (known.insert(child.configuration).second) open.push_back(child.configuration);
  }
  figures.split_ms = milliseconds_since(start);
  figures.all = known.size();
  figures.bytes = static_cast<double>(mallinfo2().uordblks - before);
  return figures;
}

void print(const std::string& file) {
  const ControlMesh mesh = read_obj(file);
  const std::string scheme = default_scheme(mesh);
  std::vector<Figures> runs;
  for (int run = 0; run < 5; ++run)
    runs.push_back(with_scheme(scheme, [&](const auto& s) { return measure(mesh, s); }));
  std::sort(runs.begin(), runs.end(),
            [](const Figures& a, const Figures& b) { return a.match_ms + a.split_ms < b.match_ms + b.split_ms; });
  const Figures& median = runs[runs.size() / 2];
  const double total = median.match_ms + median.split_ms;
  std::printf("%-36s %-8s %7d %7zu %7zu %9.2f %9.2f %9.1f %9.0f\n", file.substr(file.rfind('/') + 1).c_str(),
              scheme.c_str(), mesh.face_count(), median.of_faces, median.all, median.match_ms, total,
              1000 * total / static_cast<double>(median.all), median.bytes / static_cast<double>(median.all));
}

}  // namespace
}  // namespace shaolin

int main(int argc, char** argv) {
  CLI::App app("Configurations of meshes: number, time (median of five runs) and heap", "shaolin_bench_configurations");
  std::vector<std::string> files;
  app.add_option("MODEL", files, "Control meshes")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf("%-36s %-8s %7s %7s %7s %9s %9s %9s %9s\n", "model", "scheme", "faces", "of them", "in all", "match ms",
                "total ms", "us each", "bytes each");
    for (const std::string& file : files) shaolin::print(file);
  } catch (const std::exception& error) {
    std::cerr << "shaolin_bench_configurations: error: " << error.what() << '\n';
    return 3;
  }
  return 0;
}
