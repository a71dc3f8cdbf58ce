// The bodies of `stability_caustics`, at their place.
#include "core/base/error.h"
#include "core/scene/procedural/closed_form_scenes.h"
#include "harness/experiments/stability_caustics.h"

#include <numbers>

namespace hybray::stability_caustics_parts {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const dvec3 kTurnAxis(0.3, 0.5, -0.8);  // along no axis

template <class Case>
Body body_of(const Case& c, int max_events) {
  Body body;
  body.scene = procedural::closed_form_scene(c);
  body.form = truth::closed_form(c, max_events);
  return body;
}

Body unplaced(const Point& point) {
  const std::string& name = point.text("body");
  const double ior = point.number("ior"), incidence = point.number("incidence") * kDegree;
  const int events = static_cast<int>(point.integer("mirror_depth"));
  if (name == "ball_lens") return body_of(procedural::BallLens{.ior = ior}, events);
  if (name == "glass_slab")
    return body_of(procedural::GlassSlab{.thickness = point.number("thickness"), .ior = ior}, events);
  if (name == "furnace") {
    Body body = body_of(procedural::Furnace{.ior = ior}, events);
    body.closed = true;
    return body;
  }
  if (name == "grazed_receiver") return body_of(procedural::GrazedReceiver{.incidence = incidence}, events);
  if (name == "sealed_box") {
    Body body;
    body.scene = procedural::closed_form_scene(procedural::SealedBox{});
    body.closed = body.dark = true;
    return body;
  }
  if (name == "flat_water") {
    Body body = body_of(procedural::FlatWater{.ior = ior}, events);
    body.receiver_ior = 0.0f;
    return body;
  }
  Body body = body_of(procedural::SunlitPool{.incidence = incidence, .ior = ior}, events);
  body.receiver_ior = static_cast<float>(ior);
  return body;
}

}  // namespace

Body make_body(const Point& point) {
  Body body = unplaced(point);
  const double scale = point.number("scale");
  body.pose = {scale, rotation(kTurnAxis, point.number("turn") * kDegree), dvec3(point.number("offset"))};
  if (point.number("turn") == 0.0) body.pose.turn = dmat3(1.0);
  // In two steps: what floats lose at the offset is lost, whatever is taken away again.
  body.scene = posed(body.scene, body.pose);
  body.collapsed = leave_out_collapsed(body.scene);
  if (point.text("origin") == "rebased") {
    const dvec3 middle = rebasing_offset(body.scene);
    body.scene = posed(body.scene, {.offset = -middle});
    body.pose.offset -= middle;
  }
  if (body.scene.lights.at(0).kind == LightKind::directional) body.flux_scale = scale * scale;
  return body;
}

}  // namespace hybray::stability_caustics_parts
