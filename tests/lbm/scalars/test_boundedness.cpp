#include "tests/lbm/scalars/boundedness.hpp"

namespace puffin::lbm {
namespace {

TEST(Boundedness, holds_over_ten_thousand_updates) { stay_bounded(sanitized ? 500 : 10000); }

}  // namespace
}  // namespace puffin::lbm
