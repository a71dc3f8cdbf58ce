// Cameras placed by a seeded generator, for experiments that need many views of a scene that nobody chose.
//
// Camera "seeded/N" of a scene is a function of the scene, N and a seed. Its eye is where a person who set
// out from one of the scene's own cameras stands after a walk of 16 steps: each goes along a level line of
// sight to any point of its free stretch (hit-and-run sampling, Smith 1984, on a surface), and then to a
// height of 1.5 to 1.8 m above the floor there, a surface that faces up. So no camera is in a sealed hollow,
// a wall or outside of a scene that has an inside. (In a scene without cameras the walk sets out from any
// point of the bounds.) It looks in any direction between 12 degrees down and 6 degrees up. A draw is kept
// where rays tell that one sees something: nothing within 0.4 m of the eye; half of the level directions free
// for 1.5 m; at most a tenth of what is seen all around, and of the view, turned with its back to the eye
// (the inside of a solid shows backs only); four fifths of the view covered by surfaces, at most a tenth of
// it nearer than 1 m, its median at least 2.5 m away. In a scene whose bounds have a diagonal below 10 m all
// lengths shrink with it. After every 500 draws in vain the share of the view to be covered is halved, and
// after 1000 a walk may float where there is no floor.
#pragma once

#include "core/scene/camera.h"
#include "core/tracer/tracer.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hybray {

inline constexpr uint32_t kLargestSeededCamera = 999'999;
inline constexpr uint32_t kMostSeededCameras = 4096;  // that one pattern stands for

// "seeded/N" <-> N. Empty for any other name, and for an N with leading zeros or above kLargestSeededCamera.
std::string seeded_camera_name(uint32_t number);
std::optional<uint32_t> seeded_camera_number(std::string_view name);

// "seeded*COUNT" stands for seeded/0 to seeded/COUNT-1: COUNT from 1 to kMostSeededCameras. Empty for any
// other text.
std::optional<uint32_t> seeded_camera_count(std::string_view pattern);

// Whether a text begins as the two above do, so that no scene's own camera can have that name.
bool begins_like_seeded_camera(std::string_view text);

// Deterministic. Throws InputError where the scene has no such place.
Camera seeded_camera(const Tracer& tracer, uint32_t number, uint64_t seed = 0);

// The camera of that name: a seeded one, or one of the tracer's scene. Throws as seeded_camera and
// find_camera do.
Camera camera_of(const Tracer& tracer, const std::string& name);

}  // namespace hybray
