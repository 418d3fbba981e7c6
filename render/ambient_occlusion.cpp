#include "render/ambient_occlusion.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft {

namespace {

constexpr int k_directions = 36; // pairs; more: smoother light, time in proportion
constexpr int k_pixels = 160;    // a side of a depth map; fewer: thin gaps close
constexpr float k_lift = 2.0F;   // pixels that a vertex is lifted off its own surface
constexpr float k_soft = 2.0F;   // pixels of height over which something begins to shade

/// The scene seen along one direction: nearest and farthest depth of each pixel.
class DepthMap {
public:
    DepthMap(const Vec3f& direction, const Vec3f& centre, float radius)
        : w_(direction), centre_(centre), scale_(0.5F * k_pixels / radius) {
        const Vec3f helper = std::abs(w_.y()) < 0.9F ? Vec3f::UnitY() : Vec3f::UnitX();
        u_ = helper.cross(w_).normalized();
        v_ = w_.cross(u_);
        nearest_.assign(k_pixels * k_pixels, -std::numeric_limits<float>::infinity());
        farthest_.assign(k_pixels * k_pixels, std::numeric_limits<float>::infinity());
    }

    /// Pixel coordinates and, as z, the height towards `direction`, also in pixels.
    Vec3f place(const Vec3f& x) const {
        const Vec3f d = (x - centre_) * scale_;
        return {u_.dot(d) + 0.5F * k_pixels, v_.dot(d) + 0.5F * k_pixels, w_.dot(d)};
    }

    void draw(const Surface& surface) {
        std::vector<Vec3f> placed(surface.positions.size());
        std::transform(surface.positions.begin(), surface.positions.end(), placed.begin(),
                       [&](const Vec3f& x) { return place(x); });
        for (const Triangle& t : surface.triangles) {
            draw(placed[static_cast<std::size_t>(t[0])], placed[static_cast<std::size_t>(t[1])],
                 placed[static_cast<std::size_t>(t[2])]);
        }
    }

    /// How open the way up (sign +1) or down (sign -1) is from this place, 0..1: weighted over the
    /// four nearest pixels, each closing over k_soft pixels of height, so that light is smooth.
    float openness(const Vec3f& p, float sign) const {
        const float fx = p.x() - 0.5F;
        const float fy = p.y() - 0.5F;
        const int x = static_cast<int>(std::floor(fx));
        const int y = static_cast<int>(std::floor(fy));
        if (x < 0 || y < 0 || x + 1 >= k_pixels || y + 1 >= k_pixels) {
            return 1.0F;
        }
        const float wx = fx - static_cast<float>(x);
        const float wy = fy - static_cast<float>(y);
        const auto at = [&](int dx, int dy) {
            const auto i = static_cast<std::size_t>((y + dy) * k_pixels + x + dx);
            const float above = sign > 0.0F ? nearest_[i] - p.z() : p.z() - farthest_[i];
            return 1.0F - std::clamp(above / k_soft, 0.0F, 1.0F);
        };
        return (1.0F - wy) * ((1.0F - wx) * at(0, 0) + wx * at(1, 0)) +
               wy * ((1.0F - wx) * at(0, 1) + wx * at(1, 1));
    }

private:
    void draw(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
        const float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
        if (std::abs(area) < 1e-9F) {
            return;
        }
        const auto low = [](float p, float q, float r) {
            return std::max(0, static_cast<int>(std::ceil(std::clamp(std::min({p, q, r}) - 0.5F,
                                                                     -1.0F, k_pixels + 1.0F))));
        };
        const auto high = [](float p, float q, float r) {
            return std::min(k_pixels - 1,
                            static_cast<int>(std::floor(
                                std::clamp(std::max({p, q, r}) - 0.5F, -1.0F, k_pixels + 1.0F))));
        };
        const int x_end = high(a.x(), b.x(), c.x());
        const int y_end = high(a.y(), b.y(), c.y());
        for (int y = low(a.y(), b.y(), c.y()); y <= y_end; ++y) {
            for (int x = low(a.x(), b.x(), c.x()); x <= x_end; ++x) {
                const float px = static_cast<float>(x) + 0.5F;
                const float py = static_cast<float>(y) + 0.5F;
                const float wb =
                    ((px - a.x()) * (c.y() - a.y()) - (py - a.y()) * (c.x() - a.x())) / area;
                const float wc =
                    ((b.x() - a.x()) * (py - a.y()) - (b.y() - a.y()) * (px - a.x())) / area;
                if (wb < 0.0F || wc < 0.0F || wb + wc > 1.0F) {
                    continue;
                }
                const float z = a.z() + wb * (b.z() - a.z()) + wc * (c.z() - a.z());
                const auto i = static_cast<std::size_t>(y * k_pixels + x);
                nearest_[i] = std::max(nearest_[i], z);
                farthest_[i] = std::min(farthest_[i], z);
            }
        }
    }

    Vec3f u_, v_, w_, centre_;
    float scale_;
    std::vector<float> nearest_, farthest_;
};

/// Directions spread evenly over the upper half sphere (a Fibonacci spiral).
std::vector<Vec3f> upper_directions() {
    std::vector<Vec3f> directions;
    for (int i = 0; i < k_directions; ++i) {
        const double y = (i + 0.5) / k_directions;
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(1.0 - y * y);
        directions.push_back(Vec3(r * std::cos(angle), y, r * std::sin(angle)).cast<float>());
    }
    return directions;
}

/// Light on one side of a vertex.
struct OpenSky {
    float sky, floor;
};

/// The scene seen along all directions.
class DepthMaps {
public:
    DepthMaps(std::span<const Surface* const> casters, const Vec3f& centre, float radius)
        : directions_(upper_directions()), lift_(k_lift * 2.0F * radius / k_pixels) {
        for (const Vec3f& direction : directions_) {
            maps_.emplace_back(direction, centre, radius);
        }
        parallel_for(
            maps_.size(),
            [&](std::size_t d) {
                for (const Surface* caster : casters) {
                    maps_[d].draw(*caster);
                }
            },
            1);
    }

    /// Sums the open directions weighted by their cosine to the normal, normalised so that a side
    /// that faces straight up and sees everything has sky = 1 and one that faces down floor = 1.
    OpenSky open_at(const Vec3f& position, const Vec3f& normal) const {
        const Vec3f place = position + lift_ * normal;
        float sky = 0.0F;
        float floor = 0.0F;
        for (std::size_t d = 0; d < directions_.size(); ++d) {
            const float cosine = normal.dot(directions_[d]);
            const float sign = cosine > 0.0F ? 1.0F : -1.0F;
            (sign > 0.0F ? sky : floor) +=
                std::abs(cosine) * maps_[d].openness(maps_[d].place(place), sign);
        }
        const float scale = 2.0F / static_cast<float>(directions_.size());
        return {sky * scale, floor * scale};
    }

private:
    std::vector<Vec3f> directions_;
    float lift_; ///< distance that a vertex is lifted off its own surface, m
    std::vector<DepthMap> maps_;
};

} // namespace

void add_ambient_occlusion(std::span<Surface* const> receivers,
                           std::span<const Surface* const> casters,
                           const Box3& bounds) {
    if (bounds.isEmpty() || !(bounds.diagonal().norm() > 0.0)) {
        return;
    }
    const Vec3f centre = bounds.center().cast<float>();
    const auto radius = static_cast<float>(0.5 * bounds.diagonal().norm());
    const DepthMaps maps(casters, centre, radius);
    for (Surface* receiver : receivers) {
        parallel_for(receiver->positions.size(), [&](std::size_t v) {
            Ambient& light = receiver->ambient[v];
            const Vec3f& x = receiver->positions[v];
            const Vec3f& n = receiver->normals[v];
            const OpenSky front = maps.open_at(x, n);
            const OpenSky back = maps.open_at(x, Vec3f(-n));
            light = {front.sky, front.floor, back.sky, back.floor};
        });
    }
}

} // namespace weft
