#include "lbm/isa.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace puffin::lbm {
namespace {

TEST(InstructionSet, IsTheHardwaresBestUnlessALesserOneIsNamed) {
  EXPECT_EQ(isa_for(nullptr), hardware_isa());
  EXPECT_EQ(isa_for("baseline"), Isa::baseline);
  EXPECT_EQ(isa_for("avx512"), hardware_isa());  // at most what there is
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512})
    EXPECT_EQ(isa_for(name(isa)), std::min(isa, hardware_isa()));
}

TEST(InstructionSet, AWrongNameIsAProblemThatTellsTheRightOnes) {
  EXPECT_EQ(isa_problem(nullptr), "");
  EXPECT_EQ(isa_problem("baseline"), "");
  EXPECT_NE(isa_problem("sse5").find("baseline, avx2 and avx512"), std::string_view::npos);
  EXPECT_NE(isa_problem("").find("baseline, avx2 and avx512"), std::string_view::npos);
}

}  // namespace
}  // namespace puffin::lbm
