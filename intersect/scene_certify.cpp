#include "../schemes/errors.h"
#include "placement.h"
#include "scene.h"

namespace shaolin {

Certificate Scene::certify(const Ray& ray, const Hit& hit) const {
  if (hit.certificate.is_certified()) return hit.certificate;
  if (!(ray.origin.allFinite() && ray.direction.allFinite()) || ray.direction.isZero(0))
    throw InputError("a ray with a direction of zero or numbers that are not finite has no hits to certify");
  surface(hit.instance);  // throws if there is none
  const Instance& instance = instances()[static_cast<std::size_t>(hit.instance)];
  const Placement placement(instance.transform);
  const std::optional<Ray> local = placement.to_object(ray);
  if (!local) return hit.certificate;
  Hit own = hit;
  own.sample.position = placement.to_object(hit.sample.position);
  own.certificate = instance.object->certify(*local, own);
  // Of the way to the object and back the position is rounded twice, of which the way back counts one.
  placement.to_world(own, TraversalRay(ray));
  own.certificate.error += (own.sample.position - hit.sample.position).norm();
  own.certificate.residual = hit.certificate.residual;
  return own.certificate;
}

}  // namespace shaolin
