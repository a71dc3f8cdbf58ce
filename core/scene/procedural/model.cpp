#include "core/scene/procedural/model.h"

#include "core/base/error.h"

#include <fmt/format.h>

namespace hybray::procedural {
namespace {

constexpr double kCoarsest = 1e-3;
constexpr uint32_t kMostTriangles = uint32_t{1} << 27;

size_t count(void (*layout)(Model&), double level, double fill, uint64_t seed) {
  Model model(level, fill, seed, true);
  layout(model);
  return model.primitive_count();
}

// Largest value in [low, high) whose count is at most `wanted`, by bisection of its logarithm; count(low)
// must be.
template <class Count>
double largest(double low, double high, size_t wanted, const Count& count_at) {
  for (int i = 0; i < 36 && high / low > 1.0 + 1e-7; ++i) {
    const double middle = std::sqrt(low * high);
    (count_at(middle) <= wanted ? low : high) = middle;
  }
  return low;
}

}  // namespace

Model::Model(double level, double fill, uint64_t seed, bool counting)
    : level_(level), fill_(fill), seed_(seed), counting_(counting) {}

Lod Model::lod(uint64_t object) const {
  return {level_, fill_, random_unit(mix_bits(object), 1000, 0, seed_)};
}

uint32_t Model::material(const Material& material) {
  scene_.materials.push_back(material);
  return static_cast<uint32_t>(scene_.materials.size() - 1);
}

void Model::add(MeshBuilder&& part, uint32_t material, const std::string& name, const dmat4& transform) {
  count_ += part.triangle_count();
  if (!counting_ && part.triangle_count() > 0)
    append_mesh(scene_, part.take(), mat4(transform), material, name);
}

void Model::curve(const RoundCurve& curve) {
  ++count_;
  append_curve(scene_, curve);
}

void Model::surface(const AnalyticSurface& surface) {
  if (!counting_) append_analytic(scene_, surface);
}

void Model::camera(const std::string& name, const vec3& eye, const vec3& target, float vertical_fov) {
  scene_.cameras.push_back({name, eye, target, vec3(0.0f, 1.0f, 0.0f), vertical_fov});
}

Scene build(const std::string& name, const Parameters& parameters, uint32_t default_triangles,
            void (*layout)(Model&)) {
  const size_t wanted = parameters.triangles ? parameters.triangles : default_triangles;
  const auto at_level = [&](double level) { return count(layout, level, 1.0, parameters.seed); };
  const size_t coarsest = at_level(kCoarsest);
  if (wanted < coarsest || wanted > kMostTriangles)
    throw InputError("generator " + name, fmt::format("cannot make {} triangles; it makes {} to {}", wanted,
                                                      coarsest, kMostTriangles));
  double high = 1.0;
  while (at_level(high) <= wanted) high *= 2.0;
  const double level = largest(kCoarsest, high, wanted, at_level);

  const auto at_fill = [&](double fill) { return count(layout, level, fill, parameters.seed); };
  const double fill = largest(1.0, 1e4, wanted, at_fill);

  Model model(level, fill, parameters.seed, false);
  layout(model);
  Scene scene = model.take();
  scene.name = name;
  update_content_hash(scene);
  return scene;
}

}  // namespace hybray::procedural
