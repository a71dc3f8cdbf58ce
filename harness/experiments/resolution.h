// "1920x1080" and back.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace hybray {

struct Resolution {
  int width = 0, height = 0;  // pixels
};

// The sides of a "WIDTHxHEIGHT" text: decimal digits without sign or leading zero, at most 99999; nothing for
// any other text.
inline std::optional<Resolution> parse_resolution(std::string_view text) {
  const size_t cross = text.find('x');
  if (cross == std::string_view::npos) return std::nullopt;
  const auto side = [](std::string_view digits) {
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    return whole && digits.size() <= 5 && digits[0] >= '1' ? value : 0;
  };
  const Resolution resolution{side(text.substr(0, cross)), side(text.substr(cross + 1))};
  if (resolution.width == 0 || resolution.height == 0) return std::nullopt;
  return resolution;
}

}  // namespace hybray
