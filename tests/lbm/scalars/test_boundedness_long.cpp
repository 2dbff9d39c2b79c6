#include "tests/lbm/scalars/boundedness.hpp"

namespace puffin::lbm {
namespace {

TEST(Boundedness, holds_over_a_hundred_thousand_updates) { stay_bounded(100000); }

}  // namespace
}  // namespace puffin::lbm
