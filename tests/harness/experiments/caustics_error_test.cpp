// Errors that `caustics` measures against its references: how they fall, and what they are free of.
#include "core/base/develop.h"
#include "core/metrics/ssim.h"
#include "tests/harness/experiments/caustics_fixture.h"

#include <cmath>

namespace hybray {
namespace {

class CausticsError : public test::CausticsFixture {
 protected:
  // Nothing but variance: paths everywhere, every surface traced, no limit that matters.
  static Changes unbiased(const char* scene, Changes more) {
    more.merge(Changes{{"scene", text(scene)},
                       {"emission", text("uniform")},
                       {"first_surface", text("traced")},
                       {"visibility", text("shadow")},
                       {"mixed", text("none")},
                       {"mirror_depth", int64_t{64}},
                       {"resolution", text("32x18")},
                       {"frames", int64_t{8}}});
    return more;
  }
  // Standard errors that `value` lies from `truth`, by its 95 % interval.
  static double z_of(const Row& row, const std::string& name, double truth) {
    const double error = (number(row, name + "_high") - number(row, name + "_low")) / (2.0 * 1.96);
    return (number(row, name) - truth) / error;
  }
};

// Independent paths have an error of 1/N; stratified ones, as here, one of N^-1.5 at best where the integrand
// has edges, which pixels are (Mitchell 1996). Sixteen times the paths: 16 to 64 times less error, held
// against the 95 % intervals of both.
TEST_F(CausticsError, RelmseFallsWithTheNumberOfPathsAtTheRateOfTheory) {
  for (const char* scene : {"closed_flat_water", "closed_plane_mirror", "glass_ball"}) {
    Workspace workspace(settings());
    const auto at = [&](double rays) {
      return run_in(workspace, unbiased(scene, {{"rays_per_texel", rays}, {"reference_paths", 2e5}}));
    };
    const Row few = at(1.0), more = at(4.0), many = at(16.0);
    EXPECT_LT(number(more, "relmse"), 0.5 * number(few, "relmse")) << scene;
    EXPECT_LT(number(many, "relmse"), 0.5 * number(more, "relmse")) << scene;
    EXPECT_GE(number(few, "relmse_high") / number(many, "relmse_low"), 16.0) << scene;
    EXPECT_LE(number(few, "relmse_low") / number(many, "relmse_high"), 64.0) << scene;
    EXPECT_LT(number(many, "rmse"), 0.5 * number(few, "rmse")) << scene;
    for (const Row* row : {&few, &more, &many}) {
      EXPECT_LT(number(*row, "relmse_low"), number(*row, "relmse"));
      EXPECT_GT(number(*row, "relmse_high"), number(*row, "relmse"));
      EXPECT_DOUBLE_EQ(number(*row, "relmse_debiased"),
                       number(*row, "relmse") - number(*row, "reference_relmse"));
    }
  }
}

TEST_F(CausticsError, WhatADisplayShowsImprovesWithTheNumberOfPathsAtExposuresThatTheReferenceFixes) {
  Workspace workspace(settings());
  const auto at = [&](double rays) {
    return run_in(workspace, unbiased("glass_ball", {{"rays_per_texel", rays}, {"reference_paths", 1e5}}));
  };
  const Row few = at(0.25), many = at(16.0);
  for (const char* name : {"flip_exposure_start", "flip_exposure_stop"})
    EXPECT_EQ(number(few, name), number(many, name)) << name;
  // Most of the image is black. Its brightest pixel is at most the number of pixels times the mean, its
  // median at least 1 % of that.
  const double stops = number(few, "flip_exposure_stop") - number(few, "flip_exposure_start");
  EXPECT_GT(stops, 0.0);
  EXPECT_LE(stops, std::log2(100.0 * 32 * 18));
  EXPECT_LT(number(many, "flip"), number(few, "flip"));
  EXPECT_LT(number(many, "smape"), number(few, "smape"));
  EXPECT_GT(number(many, "psnr"), number(few, "psnr"));
  EXPECT_GT(number(many, "ssim"), number(few, "ssim"));
}

// The same from the frames, by the library alone.
TEST_F(CausticsError, OnADisplayIsThatOfTheFirstFrameForFlipAndTheMeanOverFramesForTheOthers) {
  Workspace workspace(settings());
  const Changes changes =
      unbiased("metal_ring", {{"frames", int64_t{3}}, {"rays_per_texel", 2.0}, {"reference_paths", 2e4}});
  const Row row = run_in(workspace, changes);
  const Point point = point_of(workspace, changes);
  const caustics_parts::Setup setup = caustics_parts::make_setup(point, workspace);
  const Image2D<vec3>& truth = caustics_parts::reference(point, workspace, setup).image.mean;
  const metrics::FlipExposures exposures = metrics::flip_exposures(truth);
  EXPECT_EQ(number(row, "flip_exposure_start"), exposures.start);
  EXPECT_EQ(number(row, "flip_exposure_stop"), exposures.stop);
  const float middle = metrics::exposure_factor(0.5 * (exposures.start + exposures.stop));
  const caustics::MapSet maps = caustics::make_maps(setup.caustic_scene, setup.pass);
  double psnr = 0.0, ssim = 0.0, smape = 0.0;
  for (uint32_t f = 0; f < 3; ++f) {
    const Image2D<vec3> image = caustics_parts::make_frame(setup, maps, f).image;
    if (f == 0) {
      EXPECT_EQ(number(row, "flip"), metrics::mean_error(metrics::hdr_flip(image, truth, exposures)));
    }
    psnr += metrics::psnr(display_image(image, middle), display_image(truth, middle)) / 3.0;
    ssim += metrics::ssim(display_image(image, middle), display_image(truth, middle)) / 3.0;
    smape += metrics::image_error(image, {truth, {}}).smape / 3.0;
  }
  EXPECT_DOUBLE_EQ(number(row, "psnr"), psnr);
  EXPECT_DOUBLE_EQ(number(row, "ssim"), ssim);
  EXPECT_DOUBLE_EQ(number(row, "smape"), smape);
}

TEST_F(CausticsError, ImagesTooSmallForAWindowHaveNoSsim) {
  const Row row = run({{"resolution", text("12x10")}, {"reference_paths", 1e4}, {"rays_per_texel", 4.0}});
  EXPECT_TRUE(is_empty(row, "ssim"));
  EXPECT_FALSE(is_empty(row, "flip"));
}

TEST_F(CausticsError, TheReferencesOwnErrorFallsWithItsPaths) {
  Workspace workspace(settings());
  const auto own = [&](double paths, int64_t batches) {
    return number(run_in(workspace, unbiased("closed_flat_water",
                                             {{"reference_paths", paths}, {"reference_batches", batches}})),
                  "reference_relmse");
  };
  const double few = own(5e3, 8), many = own(8e4, 8), more_batches = own(5e3, 32);
  // At least as 1/N; an estimate over 32 x 18 pixels from 7 degrees of freedom each is good to
  // sqrt(2 / (7 x 576)) = 2 %, but the dark pixels, where few paths arrive, make it twice that or three
  // times.
  EXPECT_LT(many, few / 16.0 * 1.2);
  EXPECT_NEAR(more_batches, few / 4.0, 0.2 * few / 4.0);
}

TEST_F(CausticsError, EnergyIsRightWhereNothingIsLeftOut) {
  for (const char* scene : {"closed_flat_water", "closed_plane_mirror", "glass_ball", "metal_ring"}) {
    const Row row = run(unbiased(scene, {{"rays_per_texel", 8.0},
                                         {"frames", int64_t{16}},
                                         {"reference_paths", 5e4},
                                         {"reference_batches", int64_t{16}}}));
    // 16 frames, 16 batches, 4 scenes: Student's t with 15 degrees of freedom exceeds 4.1 in one of 1000.
    EXPECT_LE(std::abs(z_of(row, "energy_ratio", 1.0)), 4.1) << scene;
    EXPECT_NEAR(number(row, "energy_ratio"), 1.0, 0.03) << scene;
  }
}

// The map of the method is that of the reference, of 512 texels: what it misses is known, and a ray through
// an active texel loses nothing.
TEST_F(CausticsError, ThroughTheMapsNoMoreEnergyIsLostThanTheyMiss) {
  for (const char* scene : {"closed_flat_water", "glass_ball"}) {
    const Row row = run({{"scene", text(scene)},
                         {"map_resolution", int64_t{512}},
                         {"rays_per_texel", 1.0},
                         {"first_surface", text("traced")},
                         {"visibility", text("shadow")},
                         {"mixed", text("none")},
                         {"mirror_depth", int64_t{64}},
                         {"resolution", text("32x18")},
                         {"reference_paths", 2e5},
                         {"reference_batches", int64_t{8}}});
    const double missed = number(row, "reference_missed_by_map_fraction");
    EXPECT_GE(missed, 0.0);
    EXPECT_LT(missed, 0.02) << scene;
    const double error = (number(row, "energy_ratio_high") - number(row, "energy_ratio_low")) / (2.0 * 1.96);
    // Flux that is missed falls on few pixels: its share of the energy may be a few times its share of flux.
    EXPECT_GE(number(row, "energy_ratio"), 1.0 - 3.0 * missed - 4.1 * error) << scene;
    EXPECT_LE(number(row, "energy_ratio"), 1.0 + 4.1 * error) << scene;
    EXPECT_TRUE(is_empty(row, "missed_by_map_fraction"));
  }
}

TEST_F(CausticsError, UniformEmissionSaysWhatTheMapsMissAndFineMapsMissLess) {
  for (const char* scene : {"glass_ball", "metal_ring"}) {
    Workspace workspace(settings());
    const auto missed = [&](int64_t resolution, double paths) {
      const Row row = run_in(
          workspace, unbiased(scene, {{"map_resolution", resolution},
                                      {"rays_per_texel",
                                       paths / (6.0 * static_cast<double>(resolution * resolution))}}));
      EXPECT_TRUE(is_empty(row, "covered_flux"));
      return number(row, "missed_by_map_fraction");
    };
    const double coarse = missed(8, 1e5), middle = missed(32, 1e5), fine = missed(128, 1e5);
    EXPECT_GT(coarse, 0.05) << scene;
    EXPECT_LT(middle, coarse) << scene;
    EXPECT_LT(fine, 0.5 * middle) << scene;
    EXPECT_GE(fine, 0.0);
    EXPECT_TRUE(is_empty(run_in(workspace, {{"scene", text(scene)}}), "missed_by_map_fraction"));
  }
}

// Under still water, through glass and beside a mirror the caustic is smooth: half a ray for each texel
// leaves more than half of the pixels dark, and the filter fills them in.
TEST_F(CausticsError, TheFilterSmoothsWhatHalfARayPerTexelLeavesAndKeepsTheEnergy) {
  for (const char* scene : {"closed_flat_water", "closed_glass_slab", "closed_plane_mirror"}) {
    Workspace workspace(settings());
    const auto with = [&](const char* filter) {
      return run_in(workspace, {{"scene", text(scene)},
                                {"filter", text(filter)},
                                {"rays_per_texel", 0.5},
                                {"mixed", text("none")},
                                {"resolution", text("96x54")},
                                {"reference_paths", 4e5}});
    };
    const Row noisy = with("none"), smooth = with("wavelet");
    EXPECT_LT(number(smooth, "median_relative_error"), 0.3 * number(noisy, "median_relative_error")) << scene;
    EXPECT_LT(number(smooth, "rmse"), number(noisy, "rmse")) << scene;
    EXPECT_NEAR(number(smooth, "energy_ratio") / number(noisy, "energy_ratio"), 1.0, 1e-4) << scene;
    EXPECT_EQ(noisy.at("photons"), smooth.at("photons"));
  }
}

}  // namespace
}  // namespace hybray
