#include "geometry/lattice_fill.h"

#include <cmath>

namespace weft {

namespace {

/// Makes a box; particle (x, y, z) is number x + (n0 + 1) (y + (n1 + 1) z).
class BoxFiller {
public:
    BoxFiller(const std::array<int, 3>& cells, double spacing)
        : n_(cells), low_(-0.5 * spacing * Vec3(cells[0], cells[1], cells[2])) {
        fill_.spacing = spacing;
    }

    LatticeFill fill() {
        add_particles();
        add_cells();
        on_surface_.assign(fill_.particles.size(), k_no_index);
        for (int axis = 0; axis < 3; ++axis) {
            add_face(axis, 0);
            add_face(axis, n_[at(axis)]);
        }
        return std::move(fill_);
    }

private:
    Index particle(const std::array<int, 3>& p) const {
        return p[0] + (n_[0] + 1) * (p[1] + (n_[1] + 1) * p[2]);
    }

    void add_particles() {
        for (int z = 0; z <= n_[2]; ++z) {
            for (int y = 0; y <= n_[1]; ++y) {
                for (int x = 0; x <= n_[0]; ++x) {
                    fill_.particles.emplace_back(low_ + fill_.spacing * Vec3(x, y, z));
                }
            }
        }
        fill_.volumes.assign(fill_.particles.size(), 0.0);
    }

    void add_cells() {
        for (int z = 0; z < n_[2]; ++z) {
            for (int y = 0; y < n_[1]; ++y) {
                for (int x = 0; x < n_[0]; ++x) {
                    CellCorners& cell = fill_.cells.emplace_back();
                    for (int c = 0; c < 8; ++c) {
                        cell[at(c)] = particle({x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)});
                        fill_.volumes[at(cell[at(c)])] += 0.125 * std::pow(fill_.spacing, 3);
                    }
                }
            }
        }
    }

    Index vertex(const std::array<int, 3>& p) {
        Index& v = on_surface_[at(particle(p))];
        if (v == k_no_index) {
            v = static_cast<Index>(fill_.surface.positions.size());
            fill_.surface.positions.push_back(fill_.particles[at(particle(p))]);
            fill_.places.push_back(
                {.particles = {particle(p), -1, -1, -1}, .weights = {1.0, 0.0, 0.0, 0.0}});
        }
        return v;
    }

    /// The face whose coordinate along an axis is `level`.
    void add_face(int axis, int level) {
        const std::size_t u = at((axis + 1) % 3);
        const std::size_t v = at((axis + 2) % 3); // u, v, axis are right-handed
        for (int j = 0; j < n_[v]; ++j) {
            for (int i = 0; i < n_[u]; ++i) {
                const auto corner = [&](int du, int dv) {
                    std::array<int, 3> p{};
                    p[at(axis)] = level;
                    p[u] = i + du;
                    p[v] = j + dv;
                    return vertex(p);
                };
                add_quad({corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, level > 0,
                         (i + j) % 2 == 0);
            }
        }
    }

    /// @param quad  counter-clockwise seen from the high side
    void add_quad(std::array<Index, 4> quad, bool faces_up, bool from_first) {
        if (!faces_up) {
            std::swap(quad[1], quad[3]);
        }
        const std::size_t s = from_first ? 0 : 1;
        fill_.surface.triangles.push_back({quad[s], quad[s + 1], quad[s + 2]});
        fill_.surface.triangles.push_back({quad[s], quad[s + 2], quad[(s + 3) % 4]});
    }

    std::array<int, 3> n_;
    Vec3 low_;
    std::vector<Index> on_surface_; ///< vertex of each particle
    LatticeFill fill_;
};

} // namespace

LatticeFill fill_box(const std::array<int, 3>& cells, double spacing) {
    return BoxFiller(cells, spacing).fill();
}

} // namespace weft
