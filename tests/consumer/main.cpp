#include <shaolin/intersect/scene.h>
#include <shaolin/schemes/obj.h>

#include <cmath>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const shaolin::Scene scene(shaolin::read_obj(argv[1]), "catmark");

  // A vertex on top of data/torus.obj; its limit point follows from the cubic B-spline's weights (1 4 1) / 6.
  const double x = (4 + std::sqrt(3)) / 6;
  const double y = 0.4 * (4 + std::sqrt(2)) / 6;
  shaolin::Ray ray;
  ray.origin = {x, 5, 0};
  ray.direction = {0, -1, 0};

  const auto hit = scene.intersect(ray);
  if (!hit) return 1;
  std::cout << "face " << hit->at.face << " at t = " << hit->t << ", normal " << hit->sample.normal.transpose() << '\n';
  return std::abs(hit->t - (5 - y)) < 1e-6 ? 0 : 1;  // the file has six decimals
}
