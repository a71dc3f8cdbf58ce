#include "core/scene/gltf_check.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using nlohmann::json;

enum class Kind { text, boolean, size, number, numbers, index, indices, object };

struct Field {
  const char* key;
  Kind kind;
  const char* into = "";  // index, indices: the top-level array pointed into
  size_t length = 0;      // numbers: how many
  bool required = false;
};

constexpr bool kRequired = true;
constexpr double kMaxInteger = 2147483647.0;  // tinygltf keeps indices as int

constexpr std::array kScene = {Field{"name", Kind::text}, Field{"nodes", Kind::indices, "nodes"}};
constexpr std::array kNode = {
    Field{"name", Kind::text},
    Field{"children", Kind::indices, "nodes"},
    Field{"mesh", Kind::index, "meshes"},
    Field{"camera", Kind::index, "cameras"},
    Field{"matrix", Kind::numbers, "", 16},
    Field{"translation", Kind::numbers, "", 3},
    Field{"rotation", Kind::numbers, "", 4},
    Field{"scale", Kind::numbers, "", 3},
};
constexpr std::array kMesh = {Field{"name", Kind::text}};
constexpr std::array kPrimitive = {
    Field{"attributes", Kind::object, "", 0, kRequired},
    Field{"indices", Kind::index, "accessors"},
    Field{"material", Kind::index, "materials"},
    Field{"mode", Kind::size},
};
constexpr std::array kAccessor = {
    Field{"bufferView", Kind::index, "bufferViews"},      Field{"byteOffset", Kind::size},
    Field{"componentType", Kind::size, "", 0, kRequired}, Field{"count", Kind::size, "", 0, kRequired},
    Field{"type", Kind::text, "", 0, kRequired},          Field{"normalized", Kind::boolean},
};
constexpr std::array kBufferView = {
    Field{"buffer", Kind::index, "buffers", 0, kRequired},
    Field{"byteOffset", Kind::size},
    Field{"byteLength", Kind::size, "", 0, kRequired},
    Field{"byteStride", Kind::size},
};
constexpr std::array kBuffer = {Field{"byteLength", Kind::size, "", 0, kRequired}, Field{"uri", Kind::text}};
constexpr std::array kMaterial = {
    Field{"name", Kind::text},
    Field{"pbrMetallicRoughness", Kind::object},
    Field{"emissiveFactor", Kind::numbers, "", 3},
};
constexpr std::array kPbr = {Field{"baseColorFactor", Kind::numbers, "", 4},
                             Field{"metallicFactor", Kind::number}, Field{"roughnessFactor", Kind::number}};
constexpr std::array kIor = {Field{"ior", Kind::number}};
constexpr std::array kTransmission = {Field{"transmissionFactor", Kind::number}};
constexpr std::array kVolume = {Field{"thicknessFactor", Kind::number},
                                Field{"attenuationDistance", Kind::number},
                                Field{"attenuationColor", Kind::numbers, "", 3}};
// What glTF has no words for; see gltf_properties.h.
constexpr std::array kOurExtras = {
    Field{"outer_ior", Kind::number},
    Field{"absorption", Kind::numbers, "", 3},
    Field{"outer_absorption", Kind::numbers, "", 3},
    Field{"thin_walled", Kind::boolean},
    Field{"conductor_eta", Kind::numbers, "", 3},
    Field{"conductor_k", Kind::numbers, "", 3},
    Field{"cut_out", Kind::text},
};
constexpr std::array kEmissiveStrength = {Field{"emissiveStrength", Kind::number}};
constexpr std::array kCamera = {Field{"type", Kind::text, "", 0, kRequired}, Field{"name", Kind::text},
                                Field{"perspective", Kind::object}, Field{"orthographic", Kind::object}};
constexpr std::array kPerspective = {Field{"yfov", Kind::number, "", 0, kRequired},
                                     Field{"znear", Kind::number, "", 0, kRequired}};
constexpr std::array kLight = {
    Field{"type", Kind::text, "", 0, kRequired},
    Field{"name", Kind::text},
    Field{"color", Kind::numbers, "", 3},
    Field{"intensity", Kind::number},
    Field{"range", Kind::number},
    Field{"spot", Kind::object},
};
constexpr std::array kSpot = {Field{"innerConeAngle", Kind::number}, Field{"outerConeAngle", Kind::number}};
constexpr std::array kNodeLight = {Field{"light", Kind::index, "lights", 0, kRequired}};

// Extensions whose data is read, or that concern only textures, which are not.
constexpr std::array kKnownExtensions = {
    "KHR_lights_punctual",   "KHR_materials_emissive_strength",
    "KHR_materials_ior",     "KHR_materials_transmission",
    "KHR_materials_volume",  "KHR_mesh_quantization",
    "KHR_texture_transform", "KHR_texture_basisu",
    "EXT_texture_webp",      "EXT_texture_avif",
};

class Checker {
 public:
  Checker(const json& document, const std::string& file) : document_(document), file_(file) {}

  void check() const {
    if (!document_.is_object()) fail("", "the document is not a JSON object");
    check_asset();
    check_extensions();
    for (const char* name : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers", "materials",
                             "cameras", "lights"})
      check_is_array(name);
    check_fields(document_, "", std::array{Field{"scene", Kind::index, "scenes"}});
    check_array("scenes", kScene);
    check_array("nodes", kNode, [this](const json& node, const std::string& at) {
      check_extension(node, at, "KHR_lights_punctual", kNodeLight);
    });
    check_array("meshes", kMesh,
                [this](const json& mesh, const std::string& at) { check_primitives(mesh, at); });
    check_array("accessors", kAccessor);
    check_array("bufferViews", kBufferView);
    check_array("buffers", kBuffer);
    check_array("materials", kMaterial, [this](const json& material, const std::string& at) {
      check_part(material, at, "pbrMetallicRoughness", kPbr);
      check_extension(material, at, "KHR_materials_ior", kIor);
      check_extension(material, at, "KHR_materials_transmission", kTransmission);
      check_extension(material, at, "KHR_materials_volume", kVolume);
      check_extension(material, at, "KHR_materials_emissive_strength", kEmissiveStrength);
      check_our_extras(material, at);
    });
    check_array("cameras", kCamera, [this](const json& camera, const std::string& at) {
      check_part(camera, at, "perspective", kPerspective);
    });
    check_array("lights", kLight,
                [this](const json& light, const std::string& at) { check_part(light, at, "spot", kSpot); });
  }

 private:
  [[noreturn]] void fail(const std::string& pointer, const std::string& message) const {
    throw InputError(pointer.empty() ? file_ : file_ + ": " + pointer, message);
  }

  // Where a top-level array lives; the lights are inside their extension.
  static std::string pointer_of(const std::string& name) {
    return name == "lights" ? "/extensions/KHR_lights_punctual/lights" : "/" + name;
  }

  size_t length(const std::string& name) const {
    const json::json_pointer pointer(pointer_of(name));
    return document_.contains(pointer) ? document_.at(pointer).size() : 0;
  }

  void check_asset() const {
    const auto asset = document_.find("asset");
    if (asset == document_.end() || !asset->is_object()) fail("/asset", "missing: this is not a glTF file");
    const auto version = asset->find("version");
    if (version == asset->end() || !version->is_string()) fail("/asset/version", "missing or not a string");
    if (const auto& text = version->get_ref<const std::string&>(); text.rfind("2.", 0) != 0)
      fail("/asset/version", fmt::format("glTF version '{}' is not supported, only 2.x", text));
  }

  void check_extensions() const {
    const auto required = document_.find("extensionsRequired");
    if (required == document_.end()) return;
    if (!required->is_array()) fail("/extensionsRequired", "not an array");
    for (size_t i = 0; i < required->size(); ++i) {
      const json& name = (*required)[i];
      const std::string at = fmt::format("/extensionsRequired/{}", i);
      if (!name.is_string()) fail(at, "not a string");
      if (std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name.get_ref<const std::string&>()) ==
          kKnownExtensions.end())
        fail(at, fmt::format("the file requires the extension {}, which is not supported: save it without "
                             "compression and without that extension",
                             name.get_ref<const std::string&>()));
    }
  }

  void check_is_array(const std::string& name) const {
    const json::json_pointer pointer(pointer_of(name));
    if (document_.contains(pointer) && !document_.at(pointer).is_array())
      fail(pointer_of(name), "not an array");
  }

  template <class Extra>
  void check_array(const std::string& name, std::span<const Field> fields, const Extra& extra) const {
    const std::string at = pointer_of(name);
    const json::json_pointer pointer(at);
    if (!document_.contains(pointer)) return;
    const json& array = document_.at(pointer);
    for (size_t i = 0; i < array.size(); ++i) {
      const std::string element = fmt::format("{}/{}", at, i);
      if (!array[i].is_object()) fail(element, "not an object");
      check_fields(array[i], element, fields);
      extra(array[i], element);
    }
  }

  void check_array(const std::string& name, std::span<const Field> fields) const {
    check_array(name, fields, [](const json&, const std::string&) {});
  }

  void check_primitives(const json& mesh, const std::string& at) const {
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array() || primitives->empty())
      fail(at + "/primitives", "missing, not an array, or empty");
    for (size_t i = 0; i < primitives->size(); ++i) {
      const json& primitive = (*primitives)[i];
      const std::string element = fmt::format("{}/primitives/{}", at, i);
      if (!primitive.is_object()) fail(element, "not an object");
      check_fields(primitive, element, kPrimitive);
      for (const auto& [name, index] : primitive["attributes"].items())
        check_index(index, element + "/attributes/" + name, "accessors");
    }
  }

  void check_part(const json& owner, const std::string& at, const char* key,
                  std::span<const Field> fields) const {
    const auto part = owner.find(key);
    if (part == owner.end()) return;
    if (!part->is_object()) fail(at + "/" + key, "not an object");
    check_fields(*part, at + "/" + key, fields);
  }

  void check_extension(const json& owner, const std::string& at, const char* name,
                       std::span<const Field> fields) const {
    const auto extensions = owner.find("extensions");
    if (extensions == owner.end()) return;
    if (!extensions->is_object()) fail(at + "/extensions", "not an object");
    check_part(*extensions, at + "/extensions", name, fields);
  }

  // Other programs' extras may hold anything; ours hold what we know, so that a misspelt key is not lost.
  void check_our_extras(const json& material, const std::string& at) const {
    const auto extras = material.find("extras");
    if (extras == material.end() || !extras->is_object() || !extras->contains("hybray")) return;
    check_part(*extras, at + "/extras", "hybray", kOurExtras);
    for (const auto& [key, value] : (*extras)["hybray"].items())
      if (std::none_of(kOurExtras.begin(), kOurExtras.end(), [&](const Field& f) { return f.key == key; }))
        fail(at + "/extras/hybray/" + key, "unknown key");
  }

  void check_fields(const json& object, const std::string& at, std::span<const Field> fields) const {
    for (const Field& field : fields) {
      const auto value = object.find(field.key);
      const std::string place = at + "/" + field.key;
      if (value == object.end()) {
        if (field.required) fail(place, "missing");
        continue;
      }
      check_value(*value, place, field);
    }
  }

  void check_value(const json& value, const std::string& at, const Field& field) const {
    switch (field.kind) {
      case Kind::text:
        if (!value.is_string()) fail(at, "not a string");
        break;
      case Kind::boolean:
        if (!value.is_boolean()) fail(at, "not true or false");
        break;
      case Kind::size:
        if (!value.is_number_unsigned()) fail(at, "not a whole number of at least 0");
        break;
      case Kind::number:
        if (!value.is_number()) fail(at, "not a number");
        break;
      case Kind::numbers:
        if (!value.is_array() || value.size() != field.length ||
            !std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); }))
          fail(at, fmt::format("not an array of {} numbers", field.length));
        break;
      case Kind::index:
        check_index(value, at, field.into);
        break;
      case Kind::indices:
        if (!value.is_array()) fail(at, "not an array");
        for (size_t i = 0; i < value.size(); ++i)
          check_index(value[i], fmt::format("{}/{}", at, i), field.into);
        break;
      case Kind::object:
        if (!value.is_object()) fail(at, "not an object");
        break;
    }
  }

  void check_index(const json& value, const std::string& at, const std::string& into) const {
    if (!value.is_number_unsigned()) fail(at, "not an index");
    const auto index = value.get<uint64_t>();
    const size_t size = length(into);
    if (index >= size || static_cast<double>(index) > kMaxInteger)
      fail(at, fmt::format("index {} is out of range: there are {} {}", index, size, into));
  }

  const json& document_;
  const std::string& file_;
};

}  // namespace

void check_gltf_json(const json& document, const std::string& file) {
  Checker(document, file).check();
}

}  // namespace hybray
