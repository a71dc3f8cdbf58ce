// Interactions in lanes against the scalar code, path by path and bit by bit, on every instruction set.
#include "core/caustics/path_walk_lanes.h"

#include "core/base/lanes.h"
#include "core/caustics/path_walk.h"
#include "core/optics/specular_step.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;

// Triangles of every kind of material, half of them with normals that lean, and an analytic ball.
Scene soup_of_materials() {
  Scene scene = test::triangle_soup(3000, 1.5f, 8.0f, 5);
  Material gold = test::mirror(vec3(1.0f, 0.8f, 0.4f));
  gold.conductor_eta = vec3(0.14f, 0.37f, 1.44f), gold.conductor_k = vec3(3.97f, 2.37f, 1.6f);
  Material pane = test::glass(1.5f);
  pane.thin_walled = true, pane.base_color = vec3(0.9f, 0.95f, 1.0f);
  Material paint = test::matte(vec3(0.7f, 0.1f, 0.1f));
  paint.roughness = 0.0f;
  Material half = test::glass(1.4f);
  half.metallic = 0.3f, half.transmission = 0.5f, half.base_color = vec3(0.6f, 0.9f, 0.4f);
  Material water = test::glass(1.33f);
  water.outer_ior = 1.6f;
  std::vector<uint32_t> materials;
  for (const Material& m :
       {test::matte(vec3(0.8f, 0.5f, 0.2f)), test::matte(vec3(0.0f)), test::mirror(vec3(0.9f, 0.7f, 0.3f)),
        gold, test::glass(1.5f, vec3(0.2f)), pane, paint, half, water})
    materials.push_back(test::add_material(scene, m));
  for (uint32_t t = 0; t < scene.triangles.size(); ++t)
    scene.triangle_material[t] = materials[random_bits(t, 7) % materials.size()];
  for (const uint32_t material : materials) {  // optics look at the materials of objects
    SceneObject none = scene.objects.front();
    none.material = material;
    scene.objects.push_back(none);
  }
  for (uint32_t v = 0; v < scene.normals.size(); ++v) {
    const auto lean = [&](uint32_t d) { return static_cast<float>(random_unit(v, d) - 0.5); };
    if (random_bits(v / 3, 3) % 2)
      scene.normals[v] = glm::normalize(scene.normals[v] + vec3(lean(0), lean(1), lean(2)));
  }
  append_analytic(scene, analytic_sphere("ball", materials[4], dvec3(0.5, 0.25, -1.0), 1.0));
  update_content_hash(scene);
  return scene;
}

// Everything that one interaction of a front leaves behind, in order.
struct Outcome {
  std::vector<std::vector<unsigned char>> arrivals, next;  // the bytes of one path each
  WalkCounts counts;
  size_t left = 0, ended = 0;
};

template <class... Fields>
std::vector<unsigned char> bytes_of(const Fields&... fields) {
  std::vector<unsigned char> bytes;
  const auto append = [&](const auto& field) {
    const auto* data = reinterpret_cast<const unsigned char*>(&field);
    bytes.insert(bytes.end(), data, data + sizeof(field));
  };
  (append(fields), ...);
  return bytes;
}

void note_next(const PathFront& front, Outcome& out) {
  for (size_t i = 0; i < front.count; ++i)
    out.next.push_back(bytes_of(front.rays.origin(i), front.rays.direction(i), front.red[i], front.green[i],
                                front.blue[i], front.initial[i], front.length[i], front.number[i],
                                front.tag[i]));
}

void note_arrivals(const Arrivals& arrivals, Outcome& out) {
  for (size_t i = 0; i < arrivals.count; ++i)
    out.arrivals.push_back(bytes_of(arrivals.photons[i], arrivals.length[i], arrivals.tag[i]));
}

class PathWalkLanes : public testing::Test {
 protected:
  PathWalkLanes() {
    options_.max_events = 3;
    options_.roulette_threshold = 0.5;
    options_.seed = 77;
  }

  // A front of random paths, with their hits.
  void fill(uint64_t seed) {
    front_->count = 0;
    const auto media = static_cast<uint64_t>(optics_.media.size());
    for (uint64_t i = 0; i < PathFront::kSize - 3; ++i) {  // not a whole number of vectors
      const auto r = [&](uint32_t d) { return random_unit(i, d, 0, seed); };
      Path path;
      path.weight = dvec3(r(0), r(1), r(2));
      path.initial = r(3) < 0.5 ? optics::mean(path.weight) : 4.0 * r(4);
      path.length = r(5);
      path.number = i * 12345;
      path.pixel = static_cast<uint32_t>(random_bits(i, 6, 0, seed));
      path.medium = static_cast<uint16_t>(random_bits(i, 7, 0, seed) % media);
      path.events = static_cast<uint16_t>(random_bits(i, 8, 0, seed) % 5);
      path.in_map = r(9) < 0.5;
      const dvec3 from(16.0 * r(10) - 8.0, 16.0 * r(11) - 8.0, 16.0 * r(12) - 8.0);
      front_->push(from, glm::normalize(dvec3(r(13), r(14), r(15)) - 0.5), path);
    }
    tracer_.intersect_batch(front_->rays.lanes(), front_->count, front_->hits.lanes(), TraceMode::single);
  }

  Outcome in_lanes(std::vector<bool>* left_out = nullptr) const {
    const auto next = std::make_unique<PathFront>();
    const auto arrivals = std::make_unique<Arrivals>();
    const auto left = std::make_unique<LeftPaths>();
    next->count = 0, arrivals->count = 0;
    Outcome out;
    meet_triangles(optics_, options_, *front_, *next, *arrivals, *left, out.counts);
    note_arrivals(*arrivals, out);
    note_next(*next, out);
    out.left = left->count;
    if (left_out) {
      left_out->assign(front_->count, false);
      for (size_t j = 0; j < left->count; ++j) (*left_out)[left->index[j]] = true;
    }
    return out;
  }

  // Of all paths but those that lanes left.
  Outcome one_by_one(const std::vector<bool>& left_out) const {
    const auto next = std::make_unique<PathFront>();
    const auto arrivals = std::make_unique<Arrivals>();
    Outcome out;
    PathWalk walk(tracer_, optics_, options_, out.counts);
    for (size_t i = 0; i < front_->count; ++i) {
      const Hit hit = front_->hits[i];
      Path path = front_->path(i);
      if (left_out[i]) continue;
      if (!hit.valid()) {
        out.counts.ledger.escaped += optics::mean(path.weight);
        continue;
      }
      dvec3 direction(front_->rays.direction(i));
      dvec3 origin = dvec3(front_->rays.origin(i)) + static_cast<double>(hit.t) * direction;
      walk.travel(static_cast<double>(hit.t), path);
      const SurfacePoint point =
          optics_.surfaces.point(hit.primitive, hit.u, hit.v, origin, options_.leaving);
      const bool goes_on = walk.meet(point, origin, direction, path, *arrivals);
      if (goes_on) next->push(origin, direction, path);
      out.ended += !goes_on;
    }
    note_arrivals(*arrivals, out);
    note_next(*next, out);
    return out;
  }

  // Not a CausticScene: that refuses glass that is not closed.
  const Scene scene_ = soup_of_materials();
  const Tracer tracer_{scene_, {.robust = true, .high_quality = false}};
  const optics::OpticsTable optics_ = optics::make_optics(scene_);
  const std::unique_ptr<PathFront> front_ = std::make_unique<PathFront>();
  WalkOptions options_;
};

constexpr uint64_t kFronts = 24;

TEST_F(PathWalkLanes, DoWhatTheScalarCodeDoesBitByBit) {
  size_t arrivals = 0, next = 0, ended = 0, left = 0, paths = 0;
  WalkCounts all;
  for (uint64_t seed = 0; seed < kFronts; ++seed) {
    fill(seed);
    options_.leaving = seed % 2 ? LeavingOffset::along_normal : LeavingOffset::largest;
    std::vector<bool> left_out;
    const Outcome lanes = in_lanes(&left_out), scalar = one_by_one(left_out);
    EXPECT_EQ(lanes.arrivals, scalar.arrivals);
    EXPECT_EQ(lanes.next, scalar.next);
    EXPECT_EQ(lanes.counts.medium_mismatches, scalar.counts.medium_mismatches);
    // Sums of the same terms in another order: as many as paths, each at most one.
    const FluxLedger &a = lanes.counts.ledger, &b = scalar.counts.ledger;
    const auto n = static_cast<double>(front_->count);
    for (const auto& [x, y] : {std::pair(a.deposited, b.deposited),
                               {a.direct, b.direct},
                               {a.absorbed, b.absorbed},
                               {a.escaped, b.escaped},
                               {a.truncated, b.truncated},
                               {a.balance, b.balance}})
      EXPECT_NEAR(x, y, n * 0x1p-52 * n);
    arrivals += lanes.arrivals.size(), next += lanes.next.size(), ended += scalar.ended;
    left += lanes.left, paths += front_->count;
    all.add(lanes.counts);
  }
  // Every kind of outcome is among them.
  EXPECT_GT(arrivals, paths / 20);
  EXPECT_GT(next, paths / 10);
  EXPECT_GT(ended, paths / 10);
  EXPECT_GT(left, 0u);
  EXPECT_LT(left, paths / 5);
  EXPECT_GT(all.medium_mismatches, paths / 100);
  const FluxLedger& l = all.ledger;
  for (const double term : {l.deposited, l.direct, l.absorbed, l.escaped, l.truncated})
    EXPECT_GT(term, 0.01 * static_cast<double>(paths));
  EXPECT_NE(l.balance, 0.0);
}

TEST_F(PathWalkLanes, GiveTheSameBitsOnEveryInstructionSet) {
  for (uint64_t seed = 0; seed < kFronts; ++seed) {
    fill(seed);
    const Outcome widest = in_lanes();
    for (const std::string& target : lanes_targets()) {
      use_lanes_target(target);
      EXPECT_EQ(lanes_target(), target);
      const Outcome here = in_lanes();
      EXPECT_EQ(here.arrivals, widest.arrivals) << target;
      EXPECT_EQ(here.next, widest.next) << target;
      EXPECT_EQ(here.left, widest.left) << target;
      EXPECT_EQ(std::memcmp(&here.counts, &widest.counts, sizeof(WalkCounts)), 0) << target;
    }
    use_lanes_target("");
  }
}

}  // namespace
}  // namespace hybray
