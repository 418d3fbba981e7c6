#include "patch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace weft {
namespace {

/// Cuts triangles along a field. A vertex is made once per cut edge, so the mesh stays manifold.
class Cutter {
public:
    Cutter(const Patch& patch, const Field& cut, unsigned curve) : source_(patch), curve_(curve) {
        result_.vertices = patch.vertices;
        result_.curves = patch.curves;
        for (const Vec3& position : patch.vertices) {
            // A vertex on the cut itself would give triangles without area.
            const double value = cut(position);
            values_.push_back(std::abs(value) < 1e-7 ? std::copysign(1e-7, value) : value);
        }
    }

    /// Appends the pieces of every triangle: the negative side with its panel, the positive side
    /// with its panel plus `added`, or not at all if that is negative.
    Patch run(int added) {
        for (size_t t = 0; t < source_.triangles.size(); ++t) {
            const Triangle& triangle = source_.triangles[t];
            append_side(triangle, -1.0, source_.panels[t]);
            if (added >= 0)
                append_side(triangle, 1.0, source_.panels[t] + added);
        }
        return std::move(result_);
    }

private:
    void append_side(const Triangle& triangle, double side, int panel) {
        std::vector<VertexIndex> polygon;
        for (size_t k = 0; k < 3; ++k) {
            const VertexIndex a = triangle[k];
            const VertexIndex b = triangle[(k + 1) % 3];
            const bool a_kept = value(a) * side > 0.0;
            if (a_kept)
                polygon.push_back(a);
            if (a_kept != (value(b) * side > 0.0))
                polygon.push_back(cut_vertex(a, b));
        }
        for (size_t k = 2; k < polygon.size(); ++k) {
            result_.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
            result_.panels.push_back(panel);
        }
    }

    double value(VertexIndex v) const { return values_[static_cast<size_t>(v)]; }

    VertexIndex cut_vertex(VertexIndex a, VertexIndex b) {
        if (a > b)
            std::swap(a, b);
        const auto [place, is_new] = cuts_.try_emplace({a, b}, result_.vertices.size());
        if (is_new) {
            const double t = value(a) / (value(a) - value(b));
            const auto ia = static_cast<size_t>(a);
            const auto ib = static_cast<size_t>(b);
            result_.vertices.push_back((1.0 - t) * source_.vertices[ia] + t * source_.vertices[ib]);
            result_.curves.push_back((source_.curves[ia] & source_.curves[ib]) | curve_);
        }
        return static_cast<VertexIndex>(place->second);
    }

    const Patch& source_;
    unsigned curve_;
    std::vector<double> values_;
    Patch result_;
    std::map<std::pair<VertexIndex, VertexIndex>, size_t> cuts_;
};

Patch drop_unused_vertices(const Patch& patch) {
    std::vector<VertexIndex> renumbered(patch.vertices.size(), -1);
    Patch result;
    result.panels = patch.panels;
    for (Triangle triangle : patch.triangles) {
        for (VertexIndex& v : triangle) {
            VertexIndex& target = renumbered[static_cast<size_t>(v)];
            if (target < 0) {
                target = static_cast<VertexIndex>(result.vertices.size());
                result.vertices.push_back(patch.vertices[static_cast<size_t>(v)]);
                result.curves.push_back(patch.curves[static_cast<size_t>(v)]);
            }
            v = target;
        }
        result.triangles.push_back(triangle);
    }
    return result;
}

} // namespace

Vec3 gradient(const Field& field, const Vec3& position) {
    constexpr double k_step = 1e-5; // m; smaller loses digits, larger blurs the blends
    Vec3 result;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = k_step * Vec3::Unit(axis);
        result[axis] = (field(position + step) - field(position - step)) / (2.0 * k_step);
    }
    return result;
}

Patch clip(const Patch& patch, const Field& cut, unsigned curve) {
    return drop_unused_vertices(Cutter(patch, cut, curve).run(-1));
}

Patch divide(const Patch& patch, const Field& cut, unsigned curve, int added) {
    return drop_unused_vertices(Cutter(patch, cut, curve).run(added));
}

Patch mirror_x(const Patch& patch, unsigned curve) {
    Patch result = patch;
    std::vector<VertexIndex> image(patch.vertices.size());
    for (size_t v = 0; v < patch.vertices.size(); ++v) {
        if ((patch.curves[v] & curve) != 0) {
            image[v] = static_cast<VertexIndex>(v);
            result.vertices[v].x() = 0.0;
        } else {
            image[v] = static_cast<VertexIndex>(result.vertices.size());
            const Vec3& position = patch.vertices[v];
            result.vertices.emplace_back(-position.x(), position.y(), position.z());
            result.curves.push_back(patch.curves[v]);
        }
    }
    for (size_t t = 0; t < patch.triangles.size(); ++t) {
        const auto [a, b, c] = patch.triangles[t];
        result.triangles.push_back({image[static_cast<size_t>(a)], image[static_cast<size_t>(c)],
                                    image[static_cast<size_t>(b)]});
        result.panels.push_back(patch.panels[t]);
    }
    return result;
}

Patch largest_part(const Patch& patch) {
    std::vector<VertexIndex> root(patch.vertices.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find_root = [&root](VertexIndex v) {
        while (root[static_cast<size_t>(v)] != v) {
            root[static_cast<size_t>(v)] = root[static_cast<size_t>(root[static_cast<size_t>(v)])];
            v = root[static_cast<size_t>(v)];
        }
        return v;
    };
    for (const Triangle& triangle : patch.triangles)
        for (size_t k = 1; k < 3; ++k)
            root[static_cast<size_t>(find_root(triangle[k]))] = find_root(triangle[0]);

    std::map<VertexIndex, size_t> sizes;
    for (const Triangle& triangle : patch.triangles)
        ++sizes[find_root(triangle[0])];
    const auto largest = std::max_element(sizes.begin(), sizes.end(),
                                          [](auto& a, auto& b) { return a.second < b.second; });

    Patch kept = patch;
    kept.triangles.clear();
    kept.panels.clear();
    for (size_t t = 0; t < patch.triangles.size(); ++t) {
        if (find_root(patch.triangles[t][0]) != largest->first)
            continue;
        kept.triangles.push_back(patch.triangles[t]);
        kept.panels.push_back(patch.panels[t]);
    }
    return drop_unused_vertices(kept);
}

void write_obj(const std::filesystem::path& path, const ObjMesh& mesh) {
    std::ofstream file(path);
    char line[128];
    const auto put = [&file, &line](int length) { file.write(line, length); };
    // Adding zero turns -0.000000 into 0.000000.
    const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6 + 0.0; };
    file << "# Made by make_meshes of the weft project. CC0 1.0. Metres, y up.\n";
    for (const Vec3& p : mesh.vertices) {
        const Vec3 q = p.unaryExpr(rounded);
        put(std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", q.x(), q.y(), q.z()));
    }
    for (const Vec2& u : mesh.material_positions) {
        const Vec2 q = u.unaryExpr(rounded);
        put(std::snprintf(line, sizeof line, "vt %.6f %.6f\n", q.x(), q.y()));
    }
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        file << 'f';
        for (size_t k = 0; k < 3; ++k) {
            file << ' ' << mesh.triangles[t][k] + 1;
            if (!mesh.material_triangles.empty())
                file << '/' << mesh.material_triangles[t][k] + 1;
        }
        file << '\n';
    }
    file.flush();
    if (!file)
        throw std::runtime_error(path.string() + ": cannot write");
}

ObjMesh read_obj(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error(path.string() + ": cannot read");
    ObjMesh mesh;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        if (keyword == "v") {
            Vec3 p;
            words >> p.x() >> p.y() >> p.z();
            mesh.vertices.push_back(p);
        } else if (keyword == "vt") {
            Vec2 u;
            words >> u.x() >> u.y();
            mesh.material_positions.push_back(u);
        } else if (keyword == "f") {
            Triangle triangle{};
            Triangle material{};
            bool has_material = false;
            for (size_t k = 0; k < 3; ++k) {
                words >> triangle[k];
                if (words.peek() == '/') {
                    words.get();
                    words >> material[k];
                    has_material = true;
                }
                --triangle[k];
                --material[k];
            }
            mesh.triangles.push_back(triangle);
            if (has_material)
                mesh.material_triangles.push_back(material);
        }
    }
    return mesh;
}

} // namespace weft
