// A picture of a scene for people to look at (`hybray scene render`). No measurement uses it.
#pragma once

#include "core/scene/camera.h"
#include "core/tracer/tracer.h"

#include <filesystem>

namespace hybray {

// Renders width x height pixels seen by `camera` and writes them as PNG: shading normals, base colour, all
// lights with shadow rays, light from the sky and from the first surface around by 16 rays a pixel, mirror
// reflection and straight-through transmission at smooth surfaces (Schlick's Fresnel term), exposure from the
// picture's mean brightness. Throws RuntimeError when the file cannot be written.
void render_preview(const Tracer& tracer, const Camera& camera, int width, int height,
                    const std::filesystem::path& png);

}  // namespace hybray
