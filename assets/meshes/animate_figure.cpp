// Makes a standing figure walk: `animate_figure IN.obj OUT.glb [KEY=VALUE...]` with the keys
// duration (s), stride, turn, raise (degrees), steps (1/s). Skeleton and weights are found from the
// mesh alone.

#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "glb.h"
#include "heat_weights.h"

namespace weft {
namespace {

void set(WalkParams& params, const std::string& word) {
    const std::size_t equals = word.find('=');
    const std::string key = word.substr(0, equals);
    double* const value = key == "duration" ? &params.duration
                          : key == "stride" ? &params.stride_deg
                          : key == "steps"  ? &params.steps
                          : key == "turn"   ? &params.turn_deg
                          : key == "raise"  ? &params.raise_deg
                                            : nullptr;
    if (value == nullptr || equals == std::string::npos) {
        throw std::runtime_error(word + ": must be duration=, stride=, steps=, turn= or raise=");
    }
    *value = std::stod(word.substr(equals + 1));
}

void animate(const std::filesystem::path& in,
             const std::filesystem::path& out,
             const WalkParams& params) {
    const Figure figure = read_figure(in);
    const Skeleton skeleton = fit_skeleton(figure);
    for (const Joint& joint : skeleton.joints) {
        std::printf("%-14s %7.3f %7.3f %7.3f m\n", joint.name.c_str(), joint.place.x(),
                    joint.place.y(), joint.place.z());
    }
    PoseSequence sequence;
    const int last = static_cast<int>(std::lround(params.duration * sequence.rate));
    for (int k = 0; k <= last; ++k) {
        sequence.poses.push_back(walk_pose(params, skeleton, k / sequence.rate));
    }
    write_glb(out, "walk", figure, skeleton, heat_weights(figure, skeleton), sequence);
}

} // namespace
} // namespace weft

int main(int argc, char** argv) {
    try {
        if (argc < 3) {
            std::fputs("usage: animate_figure IN.obj OUT.glb [KEY=VALUE...]\n", stderr);
            return 2;
        }
        weft::WalkParams params;
        for (int i = 3; i < argc; ++i) {
            weft::set(params, argv[i]);
        }
        weft::animate(argv[1], argv[2], params);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "animate_figure: %s\n", error.what());
        return 1;
    }
}
