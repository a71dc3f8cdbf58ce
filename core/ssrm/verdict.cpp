#include "core/ssrm/verdict.h"

namespace hybray::ssrm {

const char* label(Verdict verdict) {
  switch (verdict) {
    case Verdict::hit:
      return "hit";
    case Verdict::miss:
      return "miss";
    case Verdict::offscreen:
      return "offscreen";
    case Verdict::viewer:
      return "viewer";
    case Verdict::behind:
      return "behind";
    case Verdict::correction:
      return "correction";
    case Verdict::budget:
      return "budget";
    case Verdict::rejected:
      return "rejected";
  }
  return "invalid";
}

}  // namespace hybray::ssrm
