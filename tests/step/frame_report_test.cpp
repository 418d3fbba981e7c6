#include "step/frame_report.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

ContactProblem pair_of(Index a, Index b, ProblemKind kind = ProblemKind::Crossing) {
    return {{0, 0}, {a, b}, Vec3::Zero(), kind};
}

} // namespace

TEST(TimedProblem, OfOnePairTheLastIsKept) {
    std::vector<TimedProblem> problems;
    const std::vector<ContactProblem> first{pair_of(5, 9), pair_of(1, 2)};
    const std::vector<ContactProblem> second{pair_of(5, 9), pair_of(5, 9, ProblemKind::Pinched)};
    add_problems(problems, 0.1, first);
    add_problems(problems, 0.2, second);

    keep_last_of_each(problems);

    ASSERT_EQ(problems.size(), 3U);
    EXPECT_EQ(problems[0].pair.triangles, (std::array<Index, 2>{1, 2}));
    EXPECT_EQ(problems[0].time, 0.1);
    EXPECT_EQ(problems[1].pair.triangles, (std::array<Index, 2>{5, 9}));
    EXPECT_EQ(problems[1].pair.kind, ProblemKind::Crossing);
    EXPECT_EQ(problems[1].time, 0.2);
    EXPECT_EQ(problems[2].pair.kind, ProblemKind::Pinched);
}

} // namespace weft
