#include "harness/sweep/shard.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

Parameter scene_parameter() {
  return {"scene", ParameterType::scene, "", {}, {}, {}, {}, ""};
}

// An experiment whose points have a scene, a reference and a cost.
Experiment costly() {
  Experiment e;
  e.parameters = {scene_parameter()};
  e.cost_seconds = [](const Point& p, const SceneFacts&) { return p.number("cost"); };
  e.shared_costs = [](const Point& p, const SceneFacts&) {
    return std::vector<SharedCost>{{p.text("scene"), 0.1}, {p.text("scene") + p.text("reference"), 2.0}};
  };
  return e;
}

FrozenSweep sweep_of(const std::vector<Point>& points) {
  FrozenSweep sweep;
  sweep.points = points;
  return sweep;
}

Point point(const std::string& id, const std::string& scene, const std::string& reference, double cost) {
  return {id, {{"scene", scene}, {"reference", reference}, {"cost", cost}}};
}

// The ids of each part, in one text.
std::vector<std::string> parts(const Experiment& experiment, const std::vector<Point>& points, int count) {
  std::vector<std::string> texts;
  for (int i = 1; i <= count; ++i) {
    texts.emplace_back();
    for (const Point& p : points_of_shard(experiment, sweep_of(points), {i, count})) texts.back() += p.id;
  }
  return texts;
}

using Texts = std::vector<std::string>;

TEST(Shard, IsReadAsItIsWritten) {
  EXPECT_EQ(parse_shard("2/3").index, 2);
  EXPECT_EQ(parse_shard("2/3").count, 3);
  for (const char* wrong :
       {"", "2", "2/", "/3", "0/3", "4/3", "-1/3", "1/0", "1/3x", "1/ 3", "a/b", "1/99999999999"})
    EXPECT_EQ(test::message_of<InputError>([&] { parse_shard(wrong); }),
              std::string("--shard ") + wrong + ": expected I/N, such as 2/3, with I from 1 to N");
}

TEST(Shard, HasEveryPointInExactlyOnePartInFrozenOrder) {
  const unsigned seed = std::random_device()();
  std::mt19937 random(seed);
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Point> points;
    const size_t n = random() % 40;
    for (size_t i = 0; i < n; ++i)
      points.push_back(point(std::to_string(i), std::string(1, static_cast<char>('a' + random() % 3)),
                             std::to_string(random() % 4), std::ldexp(1.0, static_cast<int>(random() % 8))));
    const int count = 1 + static_cast<int>(random() % 9);
    std::set<std::string> seen;
    size_t total = 0;
    for (int i = 1; i <= count; ++i) {
      const std::vector<Point> part = points_of_shard(costly(), sweep_of(points), {i, count});
      total += part.size();
      for (size_t k = 0; k < part.size(); ++k) {
        seen.insert(part[k].id);
        if (k > 0) {
          EXPECT_LT(std::stoi(part[k - 1].id), std::stoi(part[k].id));
        }
      }
      EXPECT_TRUE(!part.empty() || points.size() < static_cast<size_t>(count));
    }
    EXPECT_EQ(total, points.size());
    EXPECT_EQ(seen.size(), points.size());
  }
}

TEST(Shard, BalancesTheEstimatedCost) {
  const std::vector<Point> points = {point("a", "s", "r", 8), point("b", "s", "r", 1),
                                     point("c", "s", "r", 1), point("d", "s", "r", 2),
                                     point("e", "s", "r", 4)};
  EXPECT_EQ(parts(costly(), points, 2), (Texts{"a", "bcde"}));
  Experiment without_cost = costly();
  without_cost.cost_seconds = nullptr, without_cost.shared_costs = nullptr;
  const std::vector<Point> six = {point("a", "s", "r", 9), point("b", "s", "r", 1), point("c", "s", "r", 1),
                                  point("d", "s", "r", 1), point("e", "s", "r", 1), point("f", "s", "r", 1)};
  EXPECT_EQ(parts(without_cost, six, 3), (Texts{"ab", "cd", "ef"}));
}

TEST(Shard, KeepsScenesAndReferencesTogetherWhereThatCostsLittleBalance) {
  // A line of 10 s; the best cut would be in the middle, one off it is the border of two scenes.
  std::vector<Point> points;
  for (const char* id : {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"})
    points.push_back(point(id, *id < 'g' ? "s" : "t", "r", 1));
  EXPECT_EQ(parts(costly(), points, 2), (Texts{"abcdef", "ghij"}));
  // References that alternate in frozen order come together all the same.
  std::vector<Point> alternating;
  for (const char* id : {"a", "b", "c", "d", "e", "f"})
    alternating.push_back(point(id, "s", (*id - 'a') % 2 == 0 ? "even" : "odd", 1));
  EXPECT_EQ(parts(costly(), alternating, 2), (Texts{"ace", "bdf"}));
}

TEST(Shard, SplitsASceneWhereKeepingItTogetherWouldCostBalance) {
  std::vector<Point> points;
  for (const char* id : {"a", "b", "c", "d", "e", "f", "g", "h"})
    points.push_back(point(id, *id == 'a' ? "s" : "t", "r", 1));
  EXPECT_EQ(parts(costly(), points, 2), (Texts{"abc", "defgh"}));
}

TEST(Shard, LeavesPartsEmptyOnlyWhereThereAreTooFewPoints) {
  EXPECT_EQ(parts(costly(), {point("a", "s", "r", 100), point("b", "s", "r", 1), point("c", "t", "r", 1)}, 5),
            (Texts{"a", "b", "c", "", ""}));
  EXPECT_EQ(parts(costly(), {}, 2), (Texts{"", ""}));
}

}  // namespace
}  // namespace hybray
