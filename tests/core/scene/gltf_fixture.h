// Loads documents that a test has put together.
#pragma once

#include "core/scene/gltf.h"
#include "tests/core/scene/gltf_sample.h"
#include "tests/temporary_folder.h"

#include <string>

#include <gtest/gtest.h>

namespace hybray {

class Gltf : public ::testing::Test {
 protected:
  Scene load(const nlohmann::json& document, const std::string& buffer = sample_buffer()) {
    folder_.write("data.bin", buffer);
    return load_gltf(folder_.write("x.gltf", document.dump()));
  }

  test::TemporaryFolder folder_;
};

inline void expect_near(const vec3& found, const vec3& expected, float tolerance = 1e-6f) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << "component " << c;
}

}  // namespace hybray
