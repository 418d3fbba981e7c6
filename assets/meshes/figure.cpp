#include "figure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace weft {

using Vec3 = Eigen::Vector3d;

namespace {

/// One corner of an `f` line, "7", "7/1" or "-2//3", as an index from 0.
int corner_index(const std::string& word, std::size_t vertices) {
    const int number = std::stoi(word);
    const int index = number > 0 ? number - 1 : static_cast<int>(vertices) + number;
    if (index < 0 || index >= static_cast<int>(vertices)) {
        throw std::runtime_error("a face names vertex " + word + ", which is not there");
    }
    return index;
}

/// Where the plane at height y cuts the mesh: the ends of one segment a triangle.
std::vector<std::array<Vec3, 2>> cut_at(const Figure& figure, double y) {
    std::vector<std::array<Vec3, 2>> segments;
    for (const auto& t : figure.triangles) {
        std::vector<Vec3> ends;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& a = figure.vertices[static_cast<std::size_t>(t[k])];
            const Vec3& b = figure.vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
            if ((a.y() < y) != (b.y() < y)) {
                ends.push_back(a + (y - a.y()) / (b.y() - a.y()) * (b - a));
            }
        }
        if (ends.size() == 2) {
            segments.push_back({ends[0], ends[1]});
        }
    }
    return segments;
}

/// Box of the cut at height y between two places in x.
Eigen::AlignedBox3d slice(const Figure& figure, double y, double x_least, double x_most) {
    Eigen::AlignedBox3d box;
    for (const auto& segment : cut_at(figure, y)) {
        for (const Vec3& p : segment) {
            if (p.x() >= x_least && p.x() <= x_most) {
                box.extend(p);
            }
        }
    }
    if (box.isEmpty()) {
        throw std::runtime_error("the figure has no slice at y = " + std::to_string(y));
    }
    return box;
}

/// Where the legs meet: the lowest vertex of the middle above the knees.
double crotch_height(const Figure& figure, double bottom, double height) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec3& p : figure.vertices) {
        if (std::abs(p.x()) < 0.01 * height && p.y() > bottom + 0.35 * height) {
            lowest = std::min(lowest, p.y());
        }
    }
    if (!(lowest < bottom + 0.6 * height)) {
        throw std::runtime_error(
            "no crotch: the legs must meet between 0.35 and 0.6 of the height");
    }
    return lowest;
}

/// The highest place where there is a gap between chest and arm; x of its inner side.
Vec3 find_armpit(const Figure& figure, double bottom, double height) {
    for (double share = 0.86; share > 0.6; share -= 0.004) {
        const double y = bottom + share * height;
        std::vector<std::pair<double, double>> spans;
        for (const auto& [p, q] : cut_at(figure, y)) {
            spans.emplace_back(std::min(p.x(), q.x()), std::max(p.x(), q.x()));
        }
        std::sort(spans.begin(), spans.end());
        double covered = 0.0; // from the middle outwards
        for (const auto& [from, to] : spans) {
            if (from > covered + 0.005 * height && covered > 0.05 * height) {
                return {covered, y, 0.0};
            }
            covered = from <= covered + 0.005 * height ? std::max(covered, to) : covered;
        }
    }
    throw std::runtime_error("no armpit: the arms must stand away from the chest");
}

/// Mean of the vertices beside the chest whose distance from the shoulder is in a range.
Vec3 arm_centre(const Figure& figure, const Vec3& shoulder, double near, double far) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (const Vec3& p : figure.vertices) {
        const double distance = (p - shoulder).norm();
        if (p.x() > shoulder.x() && distance >= near && distance <= far && p.y() < shoulder.y()) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
    }
    return 0.5 * (low + high);
}

Vec3 mirrored(const Vec3& p) {
    return {-p.x(), p.y(), p.z()};
}

} // namespace

Figure read_figure(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) {
        throw std::runtime_error(path.string() + ": cannot be opened");
    }
    Figure figure;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            Vec3 p;
            words >> p.x() >> p.y() >> p.z();
            figure.vertices.push_back(p);
        } else if (word == "f") {
            std::vector<int> face;
            while (words >> word) {
                face.push_back(corner_index(word, figure.vertices.size()));
            }
            for (std::size_t k = 2; k < face.size(); ++k) {
                figure.triangles.push_back({face[0], face[k - 1], face[k]});
            }
        }
    }
    if (figure.triangles.empty()) {
        throw std::runtime_error(path.string() + ": has no faces");
    }
    return figure;
}

Skeleton fit_skeleton(const Figure& figure) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : figure.vertices) {
        box.extend(p);
    }
    const double bottom = box.min().y();
    const double h = box.sizes().y();
    const double crotch = crotch_height(figure, bottom, h);
    const Vec3 armpit = find_armpit(figure, bottom, h);

    const auto leg_centre = [&](double share) {
        return Vec3(slice(figure, bottom + share * h, 0.0, 0.2 * h).center());
    };
    const Vec3 knee = leg_centre(0.285);
    const Vec3 ankle = leg_centre(0.06);
    const Eigen::AlignedBox3d hips = slice(figure, crotch + 0.05 * h, 0.0, 1.1 * armpit.x());
    const Vec3 hip(0.5 * hips.max().x(), crotch + 0.05 * h, hips.center().z());
    Vec3 shoulder = armpit + Vec3(0.008 * h, 0.045 * h, 0.0);
    shoulder.z() = slice(figure, shoulder.y(), armpit.x(), h).center().z();
    double reach = 0.0;
    for (const Vec3& p : figure.vertices) {
        if (p.x() > armpit.x() + 0.06 * h && p.y() > crotch - 0.1 * h && p.y() < shoulder.y()) {
            reach = std::max(reach, (p - shoulder).norm());
        }
    }
    const Vec3 elbow = arm_centre(figure, shoulder, 0.43 * reach, 0.47 * reach);
    const Vec3 hand = arm_centre(figure, shoulder, 0.85 * reach, reach);

    const double middle = hips.center().z();
    const Vec3 pelvis(0.0, hip.y(), middle);
    const Vec3 waist(0.0, crotch + 0.15 * h, middle);
    const Vec3 neck(0.0, shoulder.y() + 0.02 * h, shoulder.z());
    const Vec3 top(0.0, box.max().y(), shoulder.z());
    Skeleton s;
    s.joints = {{"pelvis", -1, pelvis},
                {"chest", Pelvis, waist},
                {"left_arm", Chest, shoulder},
                {"left_forearm", LeftArm, elbow},
                {"right_arm", Chest, mirrored(shoulder)},
                {"right_forearm", RightArm, mirrored(elbow)},
                {"left_thigh", Pelvis, hip},
                {"left_shin", LeftThigh, knee},
                {"right_thigh", Pelvis, mirrored(hip)},
                {"right_shin", RightThigh, mirrored(knee)}};
    const double body = 0.75 * armpit.x();
    const Vec3 collar(0.6 * shoulder.x(), shoulder.y(), shoulder.z());
    s.pieces = {{Pelvis, pelvis, waist, body},
                {Chest, waist, Vec3(0.0, armpit.y(), shoulder.z()), body},
                {Chest, Vec3(0.0, armpit.y(), shoulder.z()), top, 0.05 * h},
                {Chest, neck, collar, 0.03 * h},
                {Chest, neck, mirrored(collar), 0.03 * h}};
    for (const bool left : {true, false}) {
        const auto side = [left](const Vec3& p) { return left ? p : mirrored(p); };
        const Vec3 toe = side(ankle) + Vec3(0.0, 0.0, 0.1 * h);
        s.pieces.push_back({left ? LeftArm : RightArm, side(shoulder), side(elbow), 0.025 * h});
        s.pieces.push_back({left ? LeftForearm : RightForearm, side(elbow), side(hand), 0.02 * h});
        s.pieces.push_back({left ? LeftThigh : RightThigh, side(hip), side(knee), 0.045 * h});
        s.pieces.push_back({left ? LeftShin : RightShin, side(knee), side(ankle), 0.03 * h});
        s.pieces.push_back({left ? LeftShin : RightShin, side(ankle), toe, 0.03 * h});
    }
    return s;
}

} // namespace weft
