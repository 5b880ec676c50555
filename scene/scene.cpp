#include "scene/scene.h"

namespace veduta {
namespace {

Box bounds_of(const Scene& scene, uint64_t begin, uint64_t end) {
  Box box;
  for (uint64_t i = begin; i < end; ++i)
    for (int corner = 0; corner < 3; ++corner) box.extend(scene.vertices[scene.triangles[i][corner]]);
  return box;
}

}  // namespace

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::building:
      return "building";
    case Kind::terrain:
      return "terrain";
    case Kind::road:
      return "road";
    case Kind::water:
      return "water";
    case Kind::vegetation:
      return "vegetation";
    case Kind::bridge:
      return "bridge";
    case Kind::other:
      break;
  }
  return "other";
}

Box Scene::bounds() const {
  return bounds_of(*this, 0, triangles.size());
}

Box Scene::bounds(const Object& object) const {
  return bounds_of(*this, object.triangle_begin, object.triangle_end);
}

}  // namespace veduta
