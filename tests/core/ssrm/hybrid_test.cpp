#include "core/ssrm/hybrid.h"

#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

TEST(Hybrid, CompactionListsEveryRayThatIsNoHitInOrder) {
  MarchResults results;
  results.resize(100003);
  std::vector<uint32_t> expected, list{1, 2, 3};
  for (size_t i = 0; i < results.size(); ++i) {
    results.verdict[i] = static_cast<Verdict>(random_bits(i, 0) % kVerdicts);
    if (results.verdict[i] != Verdict::hit) expected.push_back(static_cast<uint32_t>(i));
  }
  compact_unresolved(results, list);
  EXPECT_EQ(list, expected);
}

TEST(Hybrid, AnswersEveryUnresolvedRayAsTheTracerAloneDoes) {
  const Scene scene = test::triangle_soup(300, 1.0f, 2.0f, 12);
  const Tracer tracer(scene, {});
  const View view(Camera{"c", vec3(0, 0, 4), vec3(0)}, {.width = 200, .height = 120}, scene.bounds);
  const test::MainView v(tracer, view);
  HitStream all;
  all.resize(v.rays.size());
  tracer.trace(v.rays, all, TraceMode::single);
  HybridBuffers buffers(v.rays.size());
  trace_hybrid(tracer, TraceMode::single, v.depth(), v.rays, v.screen_rays, {}, buffers);
  EXPECT_EQ(buffers.results.verdict, v.march().verdict);
  size_t traced = 0;
  for (size_t i = 0; i < v.rays.size(); ++i) {
    if (buffers.results.verdict[i] == Verdict::hit) continue;
    EXPECT_EQ(buffers.hits.primitive[i], all.primitive[i]);
    EXPECT_EQ(buffers.hits.t[i], all.t[i]);
    ++traced;
  }
  EXPECT_EQ(traced, buffers.unresolved.size());
  EXPECT_GT(traced, 0u);
  EXPECT_LT(traced, v.rays.size());
}

// scene,width,value rows of one of the paper's tables.
std::map<std::pair<std::string, int>, std::string> paper_table(const std::string& name,
                                                               const std::string& column) {
  std::ifstream file(std::string(HYBRAY_PROJECT_DIR) + "/results/paper/" + name);
  EXPECT_TRUE(file) << name;
  std::string line, cell;
  std::getline(file, line);
  std::vector<std::string> header;
  for (std::stringstream s(line); std::getline(s, cell, ',');) header.push_back(cell);
  std::map<std::pair<std::string, int>, std::string> table;
  while (std::getline(file, line)) {
    std::map<std::string, std::string> row;
    size_t i = 0;
    for (std::stringstream s(line); std::getline(s, cell, ',');) row[header.at(i++)] = cell;
    table[{row.count("scene") ? row["scene"] : "", std::stoi(row.at("width"))}] = row.at(column);
  }
  return table;
}

TEST(Hybrid, TheSequentialEstimateGivesThePapersTable3FromItsTables1And2) {
  const auto ss = paper_table("ssrm_table1.csv", "t_ss_ms"),
             implied = paper_table("ssrm_table1.csv", "t_ss_implied_ms");
  const auto hw = paper_table("ssrm_table2.csv", "t_hw_ms"),
             speedup = paper_table("ssrm_table3.csv", "speedup_sequential");
  ASSERT_EQ(speedup.size(), 12u);
  for (const auto& [key, printed] : speedup) {
    const auto& [scene, width] = key;
    // At 1440p and 4K the scanned Table 1 does not lead to Table 3; the value that all three scenes imply
    // does.
    const double t_ss = std::stod(width <= 1920 ? ss.at({"", width}) : implied.at({"", width})),
                 t_hw = std::stod(hw.at(key));
    const double ours = t_hw / estimate_hybrid(0.31, t_ss, t_hw).sequential;
    const double digits = std::pow(10.0, static_cast<double>(printed.size() - printed.find('.') - 1));
    EXPECT_EQ(std::round(ours * digits), std::round(std::stod(printed) * digits))
        << scene << " " << width << ": " << ours;
  }
}

TEST(Hybrid, TheEstimatesBoundEachOtherAsTheyMust) {
  const HybridEstimate e = estimate_hybrid(0.25, 4.0, 10.0);
  EXPECT_DOUBLE_EQ(e.sequential, 11.5);  // 4 + 0.75 * 10
  EXPECT_DOUBLE_EQ(e.partitioned, 8.5);  // 0.25 * 4 + 0.75 * 10
}

}  // namespace
}  // namespace hybray::ssrm
