// Scenes whose caustic has a closed form or a plain quadrature: their numbers, which core/truth/closed_forms
// computes with, and their generators. Each has one light, one specular object, a diffuse receiver of two
// triangles (the furnace: a box), and cameras that see the receiver past the object. Metres, y up; the
// receiver is the floor y = 0 where nothing else is said. Their form is exact: they have no level of detail.
//
// The generators make those with the numbers that stand here. Where a formula holds for others as well, they
// are members, and closed_form_scene makes the scene of any.
#pragma once

#include "core/scene/procedural/generators.h"

#include <span>

namespace hybray::procedural {

constexpr double kClosedFormIntensity = 100.0;   // of every point light, W/sr
constexpr double kClosedFormIrradiance = 100.0;  // of every directional light, W/m^2 on a facing surface
constexpr double kMirrorReflectance = 0.9;       // of every mirror, at every angle
constexpr double kGlassIor = 1.5;                // of every glass body

// A glass ball under a lamp on its axis.
struct BallLens {
  double radius = 1.0, center_height = 1.5, light_height = 6.0, floor = 10.0;
  double ior = kGlassIor;
};

// A mirror stands on the floor in the plane x = 2 and faces the lamp at (0, 2, 0).
struct PlaneMirror {
  static constexpr double x = 2.0, height = 3.0, half_width = 2.0, light_height = 2.0, floor = 8.0;
};

// A plate of grey glass, wide enough for its edges not to count, over the floor.
struct GlassSlab {
  double bottom = 1.0, thickness = 0.5, half_width = 10.0, light_height = 4.0, floor = 12.0;
  double absorption = 0.3;  // 1/m
  double ior = kGlassIor;
};

// The floor under still water.
struct FlatWater {
  double depth = 1.0, below = 0.25, half_width = 6.0, light_height = 3.0, floor = 8.0;
  double ior = 1.333;
};

// A parabolic mirror that opens down, with the lamp at its focus.
struct ParaboloidMirror {
  static constexpr double vertex_height = 3.0, focal_length = 0.5, rim_radius = 1.0, floor = 8.0;
};

// Parallel light falls aslant into an upright mirrored cylinder that stands on the floor: a nephroid.
struct CylinderMirror {
  static constexpr double radius = 1.0, height = 0.8, below = 0.05, floor = 6.0;
  static constexpr double slope = 0.5;  // the light falls by this much a metre toward +x
};

// The lamp hangs straight above the wall of such a cylinder: a cardioid.
struct CardioidMirror {
  static constexpr double radius = 1.0, height = 0.4, below = 0.05, light_height = 1.0, floor = 6.0;
};

// An equilateral prism, its edges along z, its apex toward -x; light that travels at 255 degrees from +x in
// the xy plane enters the upper face at 45 degrees and leaves through the lower one.
struct Prism {
  static constexpr double side = 1.0, center_height = 1.5, half_length = 1.5, floor = 12.0;
  static constexpr double light_angle = 255.0;  // degrees
};

// A right-angled prism, its legs up and toward +x: light from straight above enters the upper leg, is totally
// reflected at the hypotenuse and leaves through the other leg toward the receiver, the wall x = 3.
struct TirPrism {
  static constexpr double leg = 1.0, right_angle_x = 0.5, right_angle_y = 2.0, half_length = 1.0;
  static constexpr double wall_x = 3.0, wall_half_width = 4.0;
};

// A glass ball in a closed white room: whatever leaves the ball arrives.
struct Furnace {
  double radius = 1.0, half_room = 3.0;
  double light = 2.0;  // the lamp is at (light, light, light), the ball at the origin
  double ior = kGlassIor;
};

// Parallel light falls aslant on still water, behind a black wall that is as high as the water and keeps
// light from its side. The floor lies in the water.
struct SunlitPool {
  double depth = 1.0, below = 0.25, half_width = 6.0, gap = 1e-4;  // between the wall and the water
  double incidence = 0.0;                                          // radians from the vertical, toward +x
  double ior = 1.333;
};

// A mirror at the origin turns vertical light into a horizontal beam, one metre high, toward +x. It falls on
// a receiver whose normal it meets at `incidence` and lights a square of it, of half_length to each side of
// center(); the mirror is as long as that.
struct GrazedReceiver {
  double incidence = 0.0;  // radians, below a right angle

  double half_length() const;
  dvec3 center() const { return {6.0 * half_length(), 0.0, 0.0}; }
  dvec3 normal() const;  // on the side of the light
  dvec3 along() const;   // unit, in the receiver, up; the other direction in it is z
};

// A lamp in a closed box of mirrors, inside a closed room: nothing arrives there.
struct SealedBox {
  double half_box = 1.0, half_room = 3.0;
  dvec3 light{0.3, 0.2, -0.4};
};

// The scenes, with a content hash. Those of the first four with the numbers above are the generators'.
Scene closed_form_scene(const BallLens& c);
Scene closed_form_scene(const GlassSlab& c);
Scene closed_form_scene(const FlatWater& c);
Scene closed_form_scene(const Furnace& c);
Scene closed_form_scene(const SunlitPool& c);
Scene closed_form_scene(const GrazedReceiver& c);
Scene closed_form_scene(const SealedBox& c);

// The generators closed_ball_lens, closed_cardioid and so on, by name.
std::span<const Generator> closed_form_generators();

}  // namespace hybray::procedural
