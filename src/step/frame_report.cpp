#include "step/frame_report.h"

#include <algorithm>
#include <tuple>

namespace weft {

void add_problems(std::vector<TimedProblem>& all,
                  double time,
                  std::span<const ContactProblem> found) {
    for (const ContactProblem& pair : found) {
        all.push_back({time, pair});
    }
}

void keep_last_of_each(std::vector<TimedProblem>& problems) {
    const auto key = [](const TimedProblem& p) {
        return std::tie(p.pair.objects, p.pair.triangles, p.pair.kind);
    };
    std::reverse(problems.begin(), problems.end());
    std::stable_sort(problems.begin(), problems.end(),
                     [&](const TimedProblem& p, const TimedProblem& q) { return key(p) < key(q); });
    const auto same = [&](const TimedProblem& p, const TimedProblem& q) {
        return key(p) == key(q);
    };
    problems.erase(std::unique(problems.begin(), problems.end(), same), problems.end());
}

} // namespace weft
