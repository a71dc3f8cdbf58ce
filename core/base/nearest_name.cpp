#include "core/base/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace hybray {
namespace {

constexpr size_t kEdit = 64;  // cost of one edit; a letter of the other case costs 1

size_t substitution(char a, char b) {
  if (a == b) return 0;
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)) ? 1
                                                                                                    : kEdit;
}

// Damerau-Levenshtein distance in the restricted form (no substring is edited twice), by rows.
size_t distance(const std::string& a, const std::string& b) {
  std::vector<size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j * kEdit;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i * kEdit;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({last[j] + kEdit, row[j - 1] + kEdit, last[j - 1] + substitution(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + kEdit);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_name(const std::string& word, std::span<const std::string> known) {
  size_t best = kEdit * std::max<size_t>(1, word.size() / 3) + kEdit;
  const std::string* nearest = nullptr;
  for (const std::string& name : known) {
    const size_t lengths = std::max(name.size(), word.size()) - std::min(name.size(), word.size());
    if (lengths * kEdit >= best) continue;
    const size_t d = distance(word, name);
    if (d < best) best = d, nearest = &name;
  }
  return nearest ? *nearest : std::string();
}

}  // namespace hybray
