// Masks of cut-out leaves: how much of a triangle is there, against integrals, and where.
#include "core/scene/cut_out.h"

#include "core/base/hash.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace cut_out;

// Share of a triangle that is there: means over n x n midpoints of the unit square, folded onto the triangle.
double counted_share(CutOut shape, int n) {
  int64_t there = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      double u = (i + 0.5) / n, v = (j + 0.25) / n;
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      there += is_there(shape, u, v);
    }
  return static_cast<double>(there) / (static_cast<double>(n) * n);
}

// Integral of f over [a, b] by Gauss and Legendre's rule of five points: exact up to degree nine.
template <class F>
double integral(double a, double b, const F& f) {
  constexpr std::array<double, 5> kAt{0.0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640,
                                      0.9061798459386640};
  constexpr std::array<double, 5> kWeight{0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                          0.2369268850561891, 0.2369268850561891};
  double sum = 0.0;
  for (size_t i = 0; i < 5; ++i) sum += kWeight[i] * f(0.5 * (a + b) + 0.5 * (b - a) * kAt[i]);
  return 0.5 * (b - a) * sum;
}

double outline(double s) {
  return kReach * (1.0 - s * s) * (1.0 - s * s);
}

// A rim of length L crosses about L n of n x n cells, each of which is counted wrongly by at most one half at
// random: standard error sqrt(L n) / (2 n^2). Eight of them, for the regularity of the midpoints.
double counting_error(double rim, int n) {
  return 4.0 * std::sqrt(rim * n) / (static_cast<double>(n) * n);
}

TEST(CutOut, AWholeTriangleIsThereWithoutOne) {
  EXPECT_EQ(counted_share(CutOut::none, 100), 1.0);
}

// In (h, s) the triangle's area is the integral of 1 - |s|, which is 1, so that areas are shares.
TEST(CutOut, TheShareOfALeafIsTheIntegralOfItsRim) {
  double exact = 0.0;
  for (int tooth = -8; tooth < 8; ++tooth)
    exact += integral(tooth / kTeeth, (tooth + 1) / kTeeth,
                      [&](double s) { return outline(s) * (1.0 - kToothDepth * (kTeeth * s - tooth)); });
  EXPECT_GT(exact, 0.7);
  EXPECT_LT(exact, 0.9);
  EXPECT_NEAR(counted_share(CutOut::leaf, 4000), exact, counting_error(6.0, 4000));
}

// At height h, along s, the leaflets and gaps repeat, but their width follows the outline there; a fine
// quadrature over both, of the share of each period, is the mean of the mask only in the limit of many
// leaflets. So the fern is integrated leaflet by leaflet along lines of constant phase.
TEST(CutOut, TheShareOfAFernIsTheIntegralOfItsLeaflets) {
  // s = (phase / kLeaflets) + kLeafletSlant h: at every (phase, h) the mask is on or off; its measure along
  // the phase at a given h is found from the roots of a monotone function by bisection.
  constexpr int kHeights = 4000;
  double area = 0.0;
  for (int k = 0; k < kHeights; ++k) {
    const double h = (k + 0.5) / kHeights * kReach;
    // Half of the outline's width at this height.
    const double half = std::sqrt(1.0 - std::sqrt(h / kReach));
    double there = 0.0;
    if (h <= kMidrib) {
      there = 2.0 * half;
    } else {
      // Of each leaflet, [start, start + 1) in phase, the part below its own width. The phase of a point
      // grows with s by kLeaflets, the width changes more slowly, so that there is one end; 60 halvings find
      // it.
      const double low = kLeaflets * (-half - kLeafletSlant * h),
                   high = kLeaflets * (half - kLeafletSlant * h);
      const auto excess = [&](double phase, double start) {
        const double s = phase / kLeaflets + kLeafletSlant * h;
        const double o = std::max(outline(s), h);
        return phase - start - kLeafletWidth * (1.0 - kLeafletTaper * h / o);
      };
      for (double start = std::floor(low); start < high; start += 1.0) {
        double a = std::max(low, start), b = std::min(high, start + 1.0);
        const double from = a;
        if (excess(a, start) > 0.0) continue;
        if (excess(b, start) <= 0.0) {
          there += (b - from) / kLeaflets;
          continue;
        }
        for (int i = 0; i < 60; ++i) (excess(0.5 * (a + b), start) > 0.0 ? b : a) = 0.5 * (a + b);
        there += (a - from) / kLeaflets;
      }
    }
    area += there * kReach / kHeights;
  }
  EXPECT_GT(area, 0.3);
  EXPECT_LT(area, 0.7);
  // The quadrature over heights adds up to one step of h times the width at the midrib's rim.
  EXPECT_NEAR(counted_share(CutOut::fern, 4000), area, counting_error(30.0, 4000) + 2.0 * kReach / kHeights);
}

TEST(CutOut, ShapesLieInsideTheTriangleSoThatHalvesMeetAlongTheMidribAlone) {
  for (int i = -1000; i <= 1000; ++i) EXPECT_LE(outline(i / 1000.0), 1.0 - std::abs(i / 1000.0) + 1e-15) << i;
  for (const CutOut shape : {CutOut::leaf, CutOut::fern})
    for (int i = 1; i < 100; ++i) {
      const float at = static_cast<float>(i) / 100.0f;
      EXPECT_FALSE(is_there(shape, at, 0.0f)) << label(shape) << i;  // the two other edges
      EXPECT_FALSE(is_there(shape, 0.0f, at)) << label(shape) << i;
      if (i > 5 && i < 95) {
        EXPECT_TRUE(is_there(shape, at, 1.0f - at)) << label(shape) << i;
      }
    }
}

TEST(CutOut, FloatAndDoubleDifferOnlyNextToARim) {
  constexpr uint64_t kSeed = 4711;
  for (const CutOut shape : {CutOut::leaf, CutOut::fern}) {
    int differ = 0;
    for (uint64_t i = 0; i < 1000000; ++i) {
      const auto u = static_cast<float>(random_unit(i, 0, 0, kSeed)),
                 v = static_cast<float>(random_unit(i, 1, 0, kSeed));
      if (u + v > 1.0f) continue;
      differ += is_there(shape, u, v) != is_there(shape, static_cast<double>(u), static_cast<double>(v));
    }
    // Within 1e-6 (a few float roundings, times the slope of the phase, 9) of rims about 30 long: 3e-5.
    EXPECT_LE(differ, 30) << label(shape) << ", seed " << kSeed;
  }
}

TEST(CutOut, NamesAreFoundAgain) {
  for (const CutOut shape : {CutOut::none, CutOut::leaf, CutOut::fern})
    EXPECT_EQ(cut_out_named(label(shape)), shape);
  EXPECT_FALSE(cut_out_named("maple"));
}

}  // namespace
}  // namespace hybray
