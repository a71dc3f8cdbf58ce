#include "core/scene/cut_out.h"

namespace hybray {

const char* label(CutOut shape) {
  switch (shape) {
    case CutOut::none:
      return "none";
    case CutOut::leaf:
      return "leaf";
    case CutOut::fern:
      return "fern";
  }
  return "unknown";
}

std::optional<CutOut> cut_out_named(const std::string& name) {
  for (const CutOut shape : {CutOut::none, CutOut::leaf, CutOut::fern})
    if (name == label(shape)) return shape;
  return std::nullopt;
}

}  // namespace hybray
